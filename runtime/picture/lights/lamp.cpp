// runtime/picture/lights/lamp.cpp: lamps of the library's shaders.
#include "runtime/picture/lights/lamp.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/spaces.h"

namespace kinora {

namespace {

// A light in a pose, read by the names of its parameters.
struct LampSource {
    const Pose& pose;
    const ShaderInstance& look;
    dmat4 current_from_shader;

    // No number where the parameter is not bound and its default is not known.
    double number(std::string_view name) const {
        const ParamSource* source = look.layers[0].find(name);
        if (source && source->value.present()) return pose.values[source->value.offset];
        for (const rsl::ShaderParameter& p : look.shader().parameters)
            if (p.name == name && p.constant && !p.constant->numbers.empty())
                return p.constant->numbers[0];
        return NAN;
    }
    // Three numbers of a parameter; `otherwise` where it is not bound.
    dvec3 triple(std::string_view name, dvec3 otherwise) const {
        const ParamSource* source = look.layers[0].find(name);
        if (!source || !source->value.present()) return otherwise;
        const double* value = &pose.values[source->value.offset];
        return source->value.count < 3 ? dvec3(value[0]) : dvec3(value[0], value[1], value[2]);
    }
    dvec3 point(std::string_view name, dvec3 otherwise) const {
        return dvec3(current_from_shader * dvec4(triple(name, otherwise), 1));
    }
};

void set_strength(const LampSource& source, double share, Lamp& lamp) {
    const dvec3 color = source.triple("lightcolor", dvec3(1));
    const double most = std::max({std::abs(color.x), std::abs(color.y), std::abs(color.z)});
    lamp.strength = float(share * std::abs(source.number("intensity")) * most);
}

// Kernels compute in floats: where the edge is sharp, a little more counts as within.
constexpr double kWider = 1e-4;

void set_cone(dvec3 axis, double outer, double inner, double exponent, Lamp& lamp) {
    lamp.axis = vec3(glm::normalize(axis));
    lamp.edge = float(std::cos(std::min(outer + kWider, kPi)));
    lamp.inner = float(std::cos(std::clamp(inner, 0.0, outer)));
    lamp.exponent = float(exponent);
}

void of_collada(const LampSource& source, Lamp& lamp) {
    set_strength(source, 1, lamp);
    const double unit = source.number("unit");
    lamp.fall[0] = float(source.number("constant_attenuation"));
    lamp.fall[1] = float(source.number("linear_attenuation") / unit);
    lamp.fall[2] = float(source.number("quadratic_attenuation") / (unit * unit));
}

void of_collada_spot(const LampSource& source, Lamp& lamp) {
    of_collada(source, lamp);
    const double half = kPi / 360 * std::abs(source.number("falloff_angle"));
    set_cone(dvec3(source.current_from_shader[2]), half, half, source.number("falloff_exponent"),
             lamp);
}

void of_gltf(const LampSource& source, Lamp& lamp) {
    const double unit = source.number("unit");
    set_strength(source, unit * unit / kPi, lamp);
    lamp.fall[0] = 0;
    lamp.fall[2] = 1;
    if (const double range = source.number("range"); range > 0)
        lamp.range = float(range * unit * (1 + kWider));
}

void of_gltf_spot(const LampSource& source, Lamp& lamp) {
    of_gltf(source, lamp);
    set_cone(dvec3(source.current_from_shader[2]), source.number("outer_angle"),
             source.number("inner_angle"), 0, lamp);
}

void of_point(const LampSource& source, Lamp& lamp) {
    set_strength(source, 1, lamp);
    lamp.position = vec3(source.point("from", dvec3(0)));
    lamp.fall[0] = 0;
    lamp.fall[2] = 1;
}

void of_spot(const LampSource& source, Lamp& lamp) {
    of_point(source, lamp);
    const double cone = source.number("coneangle");
    set_cone(source.point("to", dvec3(0, 0, 1)) - source.point("from", dvec3(0)), cone,
             cone - source.number("conedeltaangle"), source.number("beamdistribution"), lamp);
}

// Shaders of the library that send their light from one place.
struct LampShader {
    std::string_view name;
    void (*read)(const LampSource&, Lamp&);
};
constexpr LampShader kLampShaders[] = {
    {"collada_point", of_collada}, {"collada_spot", of_collada_spot}, {"gltf_point", of_gltf},
    {"gltf_spot", of_gltf_spot},   {"pointlight", of_point},          {"spotlight", of_spot},
};

const LampShader* find_lamp_shader(const ShaderInstance& look) {
    // Its light does not come from its node, or its "shader" space is another's.
    if (look.area_light || !look.layers[0].space.empty()) return nullptr;
    const std::string& name = look.shader().name;
    auto row = std::ranges::find(kLampShaders, name, &LampShader::name);
    if (row == std::end(kLampShaders) || &look.shader() != library_shader(name).get())
        return nullptr;
    return row;
}

// Light that falls as it goes, from a place that floats can say.
bool makes_sense(const Lamp& lamp) {
    double sum = double(lamp.strength) + lamp.edge + lamp.inner + lamp.exponent;
    for (int k = 0; k < 3; ++k) {
        if (!(lamp.fall[k] >= 0)) return false;
        sum += double(lamp.fall[k]) + lamp.position[k] + lamp.axis[k];
    }
    const bool falls = lamp.fall[0] + lamp.fall[1] + lamp.fall[2] > 0;
    return std::isfinite(sum) && falls && lamp.exponent >= 0;
}

}  // namespace

std::optional<Lamp> lamp_of(const SceneNodes& nodes, const Pose& pose, const ShaderInstance& look) {
    const LampShader* row = find_lamp_shader(look);
    if (!row) return std::nullopt;
    const LampSource source{pose, look,
                            current_from_space(nodes, pose, "shader", look.space_owner())};
    Lamp lamp;
    lamp.position = vec3(source.current_from_shader[3]);
    row->read(source, lamp);
    if (!makes_sense(lamp)) return std::nullopt;
    return lamp;
}

}  // namespace kinora
