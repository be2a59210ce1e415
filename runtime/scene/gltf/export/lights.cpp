// runtime/scene/gltf/export/lights.cpp: lights as KHR_lights_punctual.
#include "runtime/scene/gltf/export/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "runtime/scene/gltf/export/params.h"

namespace kinora {

namespace {

// What glTF's light says of one of ours.
struct PunctualLight {
    Json json;
    bool more = true;  // the shader does more: the extras bring it
    const char* beyond = "its RSL shader";
};

PunctualLight punctual(const char* type, double intensity, const dvec3& color, double most) {
    PunctualLight light;
    light.json["type"] = type;
    light.json["intensity"] = std::isfinite(intensity) ? std::max(intensity, 0.0) : 0.0;
    if (most > 0)
        light.json["color"] = {std::max(color.x, 0.0) / most, std::max(color.y, 0.0) / most,
                               std::max(color.z, 0.0) / most};
    return light;
}

// What the light is divided by at that distance (COLLADA 1.4.1). Attenuations are per unit of the
// file, of `meter` metres.
double attenuation(const UsedParams& p, double meters, double meter) {
    double d = meters / meter;
    return p.number("constant_attenuation", 1) + d * p.number("linear_attenuation", 0) +
           d * d * p.number("quadratic_attenuation", 0);
}

Json collada_cone(const UsedParams& p) {
    double half = std::clamp(radians(0.5 * p.number("falloff_angle", 180)), 1e-3, kPi / 2);
    bool hard = p.number("falloff_exponent", 0) <= 0;
    return {{"innerConeAngle", hard ? half * (1 - 1e-6) : 0.0}, {"outerConeAngle", half}};
}

// A light that is shown as Blender does (runtime/scene/build/light_watts.h), which glTF's can say:
// P watts are P / (4 pi) candela of 1 / d^2, and a sun's number is lux.
PunctualLight blender_light(const UsedParams& p, double meter) {
    dvec3 color = p.color("lightcolor", 1);
    double most = std::max({color.x, color.y, color.z, 0.0});
    bool spot = is_library_shader(p.use, "collada_spot");
    bool sun = is_library_shader(p.use, "collada_directional");
    PunctualLight light = punctual(sun    ? "directional"
                                   : spot ? "spot"
                                          : "point",
                                   sun ? most : most / (4 * kPi) * meter * meter, color, most);
    if (spot) light.json["spot"] = collada_cone(p);
    light.more = false;
    return light;
}

// A light of this shader that stands `meters` from where it is to be right.
PunctualLight punctual_light(const UsedParams& p, double meters, double meter) {
    auto is = [&](const char* shader) { return is_library_shader(p.use, shader); };
    dvec3 color = p.color("lightcolor", 1);
    double most = std::max({color.x, color.y, color.z, 0.0});
    bool spot = is("collada_spot");
    PunctualLight light;
    if (is("collada_directional")) {
        light = punctual("directional", kPi * most, color, most);
        light.more = false;
    } else if (is("collada_point") || spot) {
        double a = attenuation(p, meters, meter), square = p.number("quadratic_attenuation", 0);
        // Over d^2 alone it is glTF's light at all distances.
        bool exact = square > 0 && p.number("constant_attenuation", 1) == 0 &&
                     p.number("linear_attenuation", 0) == 0;
        double intensity = exact ? meter * meter / square : a > 0 ? meters * meters / a : 0.0;
        light = punctual(spot ? "spot" : "point", kPi * most * intensity, color, most);
        if (spot) light.json["spot"] = collada_cone(p);
        light.more = spot || !exact;
        light.beyond = "its attenuation (1 / d^2 comes near it)";
    } else if (is("gltf_directional")) {
        light = punctual("directional", p.number("intensity", 1) * most, color, most);
        light.more = false;
    } else if (is("gltf_point") || is("gltf_spot")) {
        spot = is("gltf_spot");
        double unit = p.number("unit", 1) * meter;  // metres that its distances are in
        light = punctual(spot ? "spot" : "point", p.number("intensity", 1) * most * unit * unit,
                         color, most);
        if (double range = p.number("range", 0); range > 0) light.json["range"] = range * unit;
        if (spot)
            light.json["spot"] = {{"innerConeAngle", p.number("inner_angle", 0)},
                                  {"outerConeAngle", p.number("outer_angle", kPi / 4)}};
        light.more = false;
    } else {
        light = punctual("point", 0, dvec3(1.0), 1);  // nothing of glTF's comes near
        if (is("collada_ambient")) light.beyond = "ambient light";
    }
    return light;
}

}  // namespace

uint32_t LightWriter::write(uint32_t light, const dmat4& world) {
    auto [found, is_new] = lights_.try_emplace(light, 0);
    if (is_new) found->second = write_new(description_.lights[light], world);
    return found->second;
}

// KHR_lights_punctual: lux and candela that give a Lambert surface what COLLADA's light gives it; a
// light whose fall-off is not 1 / d^2 does so at the centre of the scene's bounds.
uint32_t LightWriter::write_new(const LightDefinition& l, const dmat4& world) {
    document_.use_extension("KHR_lights_punctual");
    const ShaderUse& use = l.shader;
    std::string name = fmt::format("light '{}'", l.id);
    double meters = glm::length(dvec3((axes_ * world)[3]) - bounds_.center);
    bool blender = l.blender_watts && !is_library_shader(use, "collada_ambient");
    bool more = false;  // at any time
    const char* beyond = "";
    ObjectAt light_of = [&](const std::vector<double>& values) {
        UsedParams params{use, values};
        PunctualLight light = blender ? blender_light(params, description_.meter)
                                      : punctual_light(params, meters, description_.meter);
        more |= light.more;
        beyond = light.beyond;
        return light.json;
    };
    const std::vector<ValueSlot> slots = slots_of(use);
    MovingObject moving = motion_.object(slots, light_of);
    Json result = moving.rest();
    if (!l.id.empty()) result["name"] = l.id;
    if (l.blender) result["extras"]["kinora_blender"] = true;  // it has a grey world
    bool has_extras = (more || l.shadows) && use.shader;
    if (has_extras) {
        Json extras = rsl_.shader(use);  // in the file's own unit: kinora_axes tells it
        result["extras"]["kinora_rsl"]["light"] = extras;
        if (l.ambient) result["extras"]["kinora_rsl"]["ambient"] = true;
        if (l.shadows) result["extras"]["kinora_rsl"]["shadows"] = *l.shadows;
        losses_.in_extras(name, beyond, l.where);
    }
    for (const std::string& member : moving.lost())
        if (!has_extras)
            losses_.lost(name, fmt::format("how its '{}' comes and goes", member), l.where);
    uint32_t index = document_.add_light(std::move(result));
    std::string pointer = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
    motion_.move_object(pointer, slots, light_of, moving);
    if (has_extras) rsl_.move_shader(pointer + "/extras/kinora_rsl/light", use);
    return index;
}

}  // namespace kinora
