// collada/extract/asset.cpp: units, axes and the played range.
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
        if (parse_double(meter->value, value) && value > 0)
            asset.meter = value;
        else
            diag.report(Code::UNIT_RANGE, document.location(unit, "meter"), meter->value);
    }
    for (const UnitName& row : kUnits)
        if (row.name == asset.unit_name && std::abs(row.meter / asset.meter - 1) > 0.02)
            diag.report(Code::UNIT_CONFLICT, document.location(unit), row.name, asset.meter);
}

}  // namespace

Asset read_asset(const Document& document, Diagnostics& diag) {
    Asset asset;
    asset.version = document.version();
    const Element* element = document.root().child("asset");
    if (!element) return asset;
    if (const Element* unit = element->child("unit")) read_unit(document, *unit, asset, diag);
    if (const Element* up = element->child("up_axis")) {
        std::string_view axis = trim(up->text);
        if (axis == "X_UP")
            asset.up_axis = UpAxis::X;
        else if (axis == "Z_UP")
            asset.up_axis = UpAxis::Z;
        else if (axis != "Y_UP")
            diag.report(Code::UPAXIS_VALUE, document.text_location(*up), axis);
    }
    return asset;
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
