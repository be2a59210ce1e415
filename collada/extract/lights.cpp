// collada/extract/lights.cpp: the four kinds of light, and the RSL shader an <extra> may give one.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

struct KindRow {
    std::string_view name;
    LightKind kind;
};
constexpr KindRow kKinds[] = {{"ambient", LightKind::Ambient},
                              {"directional", LightKind::Directional},
                              {"point", LightKind::Point},
                              {"spot", LightKind::Spot}};

struct SlotRow {
    std::string_view name;
    LightSlot slot;
    uint8_t count;
    std::array<double, 3> initial;  // COLLADA 1.4.1, chapter 5, light: the defaults
};
constexpr SlotRow kSlots[] = {{"color", LightSlot::Color, 3, {1, 1, 1}},
                              {"constant_attenuation", LightSlot::ConstantAttenuation, 1, {1}},
                              {"linear_attenuation", LightSlot::LinearAttenuation, 1, {0}},
                              {"quadratic_attenuation", LightSlot::QuadraticAttenuation, 1, {0}},
                              {"falloff_angle", LightSlot::FalloffAngle, 1, {180}},
                              {"falloff_exponent", LightSlot::FalloffExponent, 1, {0}}};

void set_default(Slot& slot, const SlotRow& row) {
    std::copy_n(row.initial.begin(), row.count, slot.values.begin());
    slot.count = row.count;
}

// Negative light (a dark light) is an old trick and passes; negative attenuation has poles.
void check_light(Extraction& x, Light& light) {
    for (const SlotRow& row : kSlots) {
        Slot& slot = light.slots[size_t(row.slot)];
        if (row.slot == LightSlot::Color) continue;
        bool wide = row.slot == LightSlot::FalloffAngle && slot.values[0] > 360;
        if (slot.values[0] >= 0 && !wide) continue;
        x.diag.report(Code::LIGHT_RANGE, slot.where, light.id, row.name, slot.values[0]);
        set_default(slot, row);
    }
    bool dims = light.kind == LightKind::Point || light.kind == LightKind::Spot;
    double sum = 0;  // what the light is divided by, at distance 1
    for (LightSlot slot : {LightSlot::ConstantAttenuation, LightSlot::LinearAttenuation,
                           LightSlot::QuadraticAttenuation})
        sum += light[slot].values[0];
    if (!dims || sum != 0) return;
    Slot& constant = light.slots[size_t(LightSlot::ConstantAttenuation)];
    x.diag.report(Code::LIGHT_RANGE, constant.where, light.id, "the whole attenuation", 0);
    constant.values[0] = 1;
}

// Blender's lights are in watts since 2.80; before they were about 1. Where the version is lost, in
// what another program made of its file, hundreds tell.
bool in_watts(const Extraction& x, Link link, const Light& light) {
    const auto version = blender_version(authoring_tool(x.document(link.doc)));
    if (!version && !extra_technique(*link.element, "blender")) return false;
    if (version && *version >= kBlenderWatts) return true;
    constexpr double kHundreds = 100;
    const auto& color = light[LightSlot::Color].values;
    return std::max({color[0], color[1], color[2]}) >= kHundreds;
}

// In what kinora-convert made of Blender's file.
bool was_blenders(const Element& light) {
    const Element* technique = extra_technique(light, "KINORA");
    const Element* world = technique ? technique->child("grey_world") : nullptr;
    return world && parse_bool(world->text).value_or(false);
}

}  // namespace

std::optional<bool> read_shadows(const Element& owner) {
    const Element* technique = extra_technique(owner, "RSL");
    const Element* shadows = technique ? technique->child("shadows") : nullptr;
    if (!shadows) return std::nullopt;
    return parse_bool(shadows->text).value_or(true);
}

uint32_t light_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    const Element& e = *link.element;
    if (!x.budget.reserve(sizeof(Light), x.where(link))) return kNone;
    Light light;
    light.id = e.value("id");
    light.name = e.value("name");
    light.where = x.where(link);
    const Element* common = e.child("technique_common");
    const Element* values = nullptr;
    for (const KindRow& row : kKinds)
        if (const Element* found = common && !values ? common->child(row.name) : nullptr) {
            values = found;
            light.kind = row.kind;
        }
    bool has_rsl = extra_technique(e, "RSL") != nullptr;
    if (!values && !has_rsl) {
        x.diag.report(Code::LIGHT_KIND, light.where, light.id);
        return kNone;
    }
    if (!values) light.kind = LightKind::Point;
    uint32_t number = uint32_t(x.scene.lights.size());
    at->second = number;
    for (const SlotRow& row : kSlots) {
        Slot& slot = light.slots[size_t(row.slot)];
        const Element* value = values ? values->child(row.name) : nullptr;
        if (value)
            slot = read_slot(x, {link.doc, value}, row.count,
                             {Owner::Light, number, uint32_t(row.slot)});
        if (!slot.present()) set_default(slot, row);
        if (!value) slot.where = light.where;
    }
    check_light(x, light);
    light.shadows = read_shadows(e);
    light.blender = authoring_tool(x.document(link.doc)).starts_with("Blender") || was_blenders(e);
    light.blender_watts = in_watts(x, link, light);
    x.scene.lights.push_back(std::move(light));
    std::vector<uint32_t> materials = rsl_extra_materials(x, link);
    if (!materials.empty()) x.scene.lights[number].rsl_material = materials[0];
    return number;
}

}  // namespace kinora::collada
