// collada/document/kml.cpp: the models of a .kml, and where on the earth they stand.
#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "collada/document/kml_p.h"
#include "collada/text/encoding_p.h"
#include "collada/text/entities_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace {

constexpr uintmax_t kMostKmlBytes = 4 << 20;
constexpr size_t kMostModels = 1000;

// A number of a <Model>: what stands around it, its name, the values it may have.
struct NumberRow {
    std::string_view around, name;
    void (*set)(KmlModel&, double);
    double least, most;
};
constexpr double kAny = 1e12;  // beyond which a number is taken for a mistake
constexpr NumberRow kNumbers[] = {
    {"Location", "longitude", [](KmlModel& m, double v) { m.longitude = v; }, -360, 360},
    {"Location", "latitude", [](KmlModel& m, double v) { m.latitude = v; }, -90, 90},
    {"Location", "altitude", [](KmlModel& m, double v) { m.altitude = v; }, -kAny, kAny},
    {"Orientation", "heading", [](KmlModel& m, double v) { m.orientation.x = v; }, -kAny, kAny},
    {"Orientation", "tilt", [](KmlModel& m, double v) { m.orientation.y = v; }, -kAny, kAny},
    {"Orientation", "roll", [](KmlModel& m, double v) { m.orientation.z = v; }, -kAny, kAny},
    {"Scale", "x", [](KmlModel& m, double v) { m.scale.x = v; }, -kAny, kAny},
    {"Scale", "y", [](KmlModel& m, double v) { m.scale.y = v; }, -kAny, kAny},
    {"Scale", "z", [](KmlModel& m, double v) { m.scale.z = v; }, -kAny, kAny},
};

bool names_dae(std::string_view href) {
    std::string file(href.substr(0, href.find('#')));
    for (char& c : file) c = char(std::tolower(uint8_t(c)));
    return file.ends_with(".dae");
}

// Expat's events. Namespace prefixes do not matter.
struct KmlReading {
    std::vector<std::string> open;  // local names
    std::string text, placemark;    // the name of the <Placemark>
    std::optional<KmlModel> model;
    bool on_the_ground = true;  // <altitudeMode>, whose default is clampToGround
    std::vector<KmlModel> models;

    static void XMLCALL on_start(void* self, const XML_Char* name, const XML_Char** attributes) {
        static_cast<KmlReading*>(self)->start(name, attributes);
    }
    static void XMLCALL on_text(void* self, const XML_Char* text, int length) {
        static_cast<KmlReading*>(self)->text.append(text, size_t(length));
    }
    static void XMLCALL on_end(void* self, const XML_Char*) {
        static_cast<KmlReading*>(self)->end();
    }

    void start(std::string_view name, const XML_Char** attributes) {
        open.emplace_back(name.substr(name.find(':') == name.npos ? 0 : name.find(':') + 1));
        text.clear();
        if (open.back() == "Placemark") placemark.clear();
        if (open.back() != "Model") return;
        model.emplace();
        on_the_ground = true;
        for (; attributes[0]; attributes += 2)
            if (std::string_view(attributes[0]) == "id") model->name = attributes[1];
    }

    void end() {
        std::string name = std::move(open.back());
        open.pop_back();
        std::string_view around = open.empty() ? std::string_view() : open.back();
        std::string_view value = trim(text);
        if (name == "name" && around == "Placemark") placemark = value;
        if (model) read_part(around, name, value);
        if (name == "Model" && model) end_model();
        text.clear();
    }

    void read_part(std::string_view around, std::string_view name, std::string_view value) {
        if (name == "href" && around == "Link") model->href = value;
        if (name == "altitudeMode" && around == "Model") on_the_ground = value.starts_with("clamp");
        for (const NumberRow& row : kNumbers) {
            if (row.around != around || row.name != name) continue;
            double number = 0;
            bool sound = parse_double(value, number) && number >= row.least && number <= row.most &&
                         (around != "Scale" || number != 0);
            if (sound)
                row.set(*model, number);
            else
                model->faults.push_back(fmt::format("<{}> is '{}'", name, value));
        }
    }

    void end_model() {
        if (model->name.empty()) model->name = placemark;
        if (on_the_ground) model->altitude = 0;
        if (names_dae(model->href) && models.size() < kMostModels)
            models.push_back(std::move(*model));
        model.reset();
    }
};

// A place relative to the earth's centre, and the directions east, north and up there. KML's
// coordinates are on the ellipsoid WGS 84 (NIMA TR8350.2).
struct EarthFrame {
    dvec3 place, east, north, up;
};
EarthFrame earth_frame(const KmlModel& model) {
    constexpr double kRadius = 6378137.0, kFlattening = 1 / 298.257223563;
    constexpr double kSquaredEccentricity = kFlattening * (2 - kFlattening);
    double longitude = radians(*model.longitude), latitude = radians(*model.latitude);
    double sine = std::sin(latitude), cosine = std::cos(latitude);
    dvec3 up(cosine * std::cos(longitude), cosine * std::sin(longitude), sine);
    double normal = kRadius / std::sqrt(1 - kSquaredEccentricity * sine * sine);
    dvec3 place = (normal + model.altitude) * up;
    place.z -= kSquaredEccentricity * normal * sine;
    dvec3 east(-std::sin(longitude), std::cos(longitude), 0);
    return {place, east, glm::cross(up, east), up};
}

dvec3 seen_from(const EarthFrame& origin, dvec3 direction) {
    return {glm::dot(direction, origin.east), glm::dot(direction, origin.north),
            glm::dot(direction, origin.up)};
}

// Clockwise, seen against the axis: 0 x, 1 y, 2 z.
dmat4 turn(int axis, double degrees) {
    double s = std::sin(radians(degrees)), c = std::cos(radians(degrees));
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    dmat4 m(1.0);
    m[a][a] = m[b][b] = c;
    m[a][b] = -s;
    m[b][a] = s;
    return m;
}

}  // namespace

std::vector<KmlModel> read_kml(const std::string& path) {
    std::optional<std::string> bytes = read_regular_file(path, kMostKmlBytes);
    if (!bytes) return {};
    DecodedText decoded = decode_text(std::move(*bytes));
    std::string text = escape_ampersands(decoded.text, bare_ampersands(decoded.text));
    std::string_view xml = text;
    if (std::optional<ByteRange> use = find_entity_use(xml)) xml = xml.substr(0, use->begin);
    KmlReading reading;
    XML_Parser parser = XML_ParserCreate("UTF-8");
    if (!parser) return {};
    XML_SetUserData(parser, &reading);
    XML_SetElementHandler(parser, KmlReading::on_start, KmlReading::on_end);
    XML_SetCharacterDataHandler(parser, KmlReading::on_text);
    XML_Parse(parser, xml.data(), int(xml.size()), XML_TRUE);
    XML_ParserFree(parser);
    return std::move(reading.models);
}

// Roll, then tilt, then heading (KML reference, <Orientation>).
dmat4 kml_place(const KmlModel& model, const KmlModel& origin) {
    dmat4 m =
        turn(2, model.orientation.x) * turn(0, model.orientation.y) * turn(1, model.orientation.z);
    for (int c = 0; c < 3; ++c) m[c] *= model.scale[c];
    if (&model == &origin || !model.has_place() || !origin.has_place()) return m;
    EarthFrame here = earth_frame(model), there = earth_frame(origin);
    dmat4 earth(dvec4(seen_from(there, here.east), 0), dvec4(seen_from(there, here.north), 0),
                dvec4(seen_from(there, here.up), 0),
                dvec4(seen_from(there, here.place - there.place), 1));
    return earth * m;
}

}  // namespace kinora::collada
