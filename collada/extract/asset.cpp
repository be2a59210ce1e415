// collada/extract/asset.cpp: units and axes, of documents and of elements with an <asset>; the
// played range.
#include <cctype>
#include <cmath>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

struct UnitName {
    std::string_view name;
    double meter;
};
constexpr UnitName kUnits[] = {{"meter", 1},         {"metre", 1},          {"centimeter", 0.01},
                               {"centimetre", 0.01}, {"millimeter", 0.001}, {"kilometer", 1000},
                               {"inch", 0.0254},     {"foot", 0.3048},      {"feet", 0.3048},
                               {"yard", 0.9144},     {"decimeter", 0.1}};

void read_unit(const Document& document, const Element& unit, Asset& asset, Diagnostics& diag) {
    asset.unit_name = unit.value("name");
    if (const Attribute* meter = unit.attribute("meter")) {
        double value = 0;
        bool comma = comma_decimal(trim(meter->value), value);
        if (comma)
            diag.report(Code::SRC_COMMA_DECIMAL, document.location(unit, "meter"), meter->value);
        if ((comma || parse_double(meter->value, value)) && value > 0)
            asset.meter = value;
        else
            diag.report(Code::UNIT_RANGE, document.location(unit, "meter"), meter->value);
    }
    for (const UnitName& row : kUnits)
        if (row.name == asset.unit_name && std::abs(row.meter / asset.meter - 1) > 0.02)
            diag.report(Code::UNIT_CONFLICT, document.location(unit), row.name, asset.meter);
}

struct UpAxisName {
    std::string_view name;
    UpAxis axis;
};
constexpr UpAxisName kUpAxes[] = {{"X_UP", UpAxis::X}, {"Y_UP", UpAxis::Y}, {"Z_UP", UpAxis::Z}};

// "z_up", "Z-UP", "Zup" and "Z" are Z_UP's.
bool spells(std::string_view text, std::string_view name) {
    std::string letters;
    for (char c : text)
        if (std::isalnum(uint8_t(c))) letters += char(std::toupper(uint8_t(c)));
    return letters == name.substr(0, 1) || letters == std::string(name.substr(0, 1)) + "UP";
}

UpAxis read_up_axis(const Document& document, const Element& up, Diagnostics& diag) {
    std::string_view text = trim(up.text);
    for (const UpAxisName& row : kUpAxes)
        if (text == row.name) return row.axis;
    for (const UpAxisName& row : kUpAxes) {
        if (!spells(text, row.name)) continue;
        diag.report(Code::UPAXIS_SPELLING, document.text_location(up), text, row.name);
        return row.axis;
    }
    diag.report(Code::UPAXIS_VALUE, document.text_location(up), text);
    return UpAxis::Y;
}

// Of an <asset>: what it leaves out has the format's default.
Asset read_values(const Document& document, const Element& element, Diagnostics& diag) {
    Asset asset;
    if (const Element* unit = element.child("unit")) read_unit(document, *unit, asset, diag);
    if (const Element* up = element.child("up_axis"))
        asset.up_axis = read_up_axis(document, *up, diag);
    return asset;
}

}  // namespace

Asset read_asset(const Document& document, Diagnostics& diag) {
    const Element* element = document.root().child("asset");
    Asset asset = element ? read_values(document, *element, diag) : Asset();
    asset.version = document.version();
    return asset;
}

namespace {

dmat4 y_up_from(UpAxis axis) {
    switch (axis) {
        case UpAxis::X:  // right -y, up x, towards us z
            return dmat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
        case UpAxis::Y:
            return dmat4(1.0);
        case UpAxis::Z:  // right x, up z, towards us -y
            return dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
    }
    return dmat4(1.0);
}

dmat4 transposed(const dmat4& m) {
    dmat4 t;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) t[c][r] = m[r][c];
    return t;
}

}  // namespace

const AssetFrames::OwnFrames& AssetFrames::own_frames(uint32_t doc) {
    auto [at, fresh] = own_.try_emplace(doc);
    if (!fresh) return at->second;
    const Document& document = documents_[doc];
    const Element* root = &document.root();
    for (const Element* e = root; e;) {  // document order
        if (e->name == "asset" && e->parent && e->parent != root &&
            (e->child("unit") || e->child("up_axis"))) {
            Asset values = read_values(document, *e, diag_);
            Own own;
            if (e->child("unit")) own.meter = values.meter;
            if (e->child("up_axis")) own.up_axis = values.up_axis;
            at->second.try_emplace(e->parent, own);
        }
        if (e->first_child) {
            e = e->first_child;
            continue;
        }
        while (e && !e->next) e = e->parent;
        if (e) e = e->next;
    }
    return at->second;
}

uint32_t AssetFrames::number(double meter, UpAxis up_axis) {
    auto [at, fresh] = number_of_.try_emplace({meter, up_axis}, uint32_t(frames_.size()));
    if (fresh) frames_.emplace_back(meter, up_axis);
    return at->second;
}

uint32_t AssetFrames::of_world() {
    return number(scene_.documents[0].asset.meter, scene_.documents[0].asset.up_axis);
}

uint32_t AssetFrames::of_earth() {
    return number(1.0, UpAxis::Z);
}

uint32_t AssetFrames::of(Link link) {
    const Asset& whole = scene_.documents[link.doc].asset;
    const OwnFrames& own = own_frames(link.doc);
    if (own.empty()) return number(whole.meter, whole.up_axis);
    Own inner;
    for (const Element* e = link.element; e; e = e->parent) {
        auto found = own.find(e);
        if (found == own.end()) continue;
        if (!inner.meter) inner.meter = found->second.meter;
        if (!inner.up_axis) inner.up_axis = found->second.up_axis;
    }
    return number(inner.meter.value_or(whole.meter), inner.up_axis.value_or(whole.up_axis));
}

uint32_t AssetFrames::conversion(uint32_t from, uint32_t to) {
    if (from == to) return kNone;
    auto [at, fresh] = conversion_of_.emplace(std::pair(from, to), kNone);
    if (!fresh) return at->second;
    auto [user_meter, user_up] = frames_[from];
    auto [used_meter, used_up] = frames_[to];
    dmat4 m = transposed(y_up_from(user_up)) * y_up_from(used_up);
    double scale = used_meter / user_meter;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] *= scale;
    return at->second = append(scene_.conversions, m);
}

std::string_view authoring_tool(const Document& document) {
    const Element* e = &document.root();
    for (const char* name : {"asset", "contributor", "authoring_tool"})
        if (e) e = e->child(name);
    return e ? trim(e->text) : std::string_view{};
}

namespace {

// The first of these child names with a number, anywhere in the extras of `owner`.
std::optional<double> extra_number(const Element& owner, Kinds names) {
    for (const Element& extra : owner.children()) {
        if (extra.name != "extra") continue;
        for (const Element& technique : extra.children())
            for (std::string_view name : names) {
                const Element* e = technique.child(name);
                double value = 0;
                if (e && parse_double(e->text, value)) return value;
            }
    }
    return std::nullopt;
}

}  // namespace

// FCollada writes start_time/end_time/frame_rate (seconds) into the visual scene or the document;
// Blender writes start/end frames of its scene unmarked, which nothing tells apart from seconds.
void read_time_range(Extraction& x, Link visual_scene) {
    const Element& root = x.document(visual_scene.doc).root();
    const Element* scene = root.child("scene");
    const Element* owners[] = {visual_scene.element, &root, scene};
    for (const Element* owner : owners) {
        if (!owner) continue;
        if (!x.scene.start_time) x.scene.start_time = extra_number(*owner, {"start_time"});
        if (!x.scene.end_time) x.scene.end_time = extra_number(*owner, {"end_time"});
        if (!x.scene.frame_rate)
            x.scene.frame_rate =
                extra_number(*owner, {"frame_rate", "framerate", "frame_per_second"});
    }
    if (x.scene.frame_rate && !(*x.scene.frame_rate > 0)) x.scene.frame_rate.reset();
    bool backwards =
        x.scene.start_time && x.scene.end_time && *x.scene.end_time < *x.scene.start_time;
    if (backwards) x.scene.start_time = x.scene.end_time = std::nullopt;
}

}  // namespace kinora::collada
