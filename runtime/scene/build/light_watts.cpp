// runtime/scene/build/light_watts.cpp: COLLADA's lights that are in watts.
#include "runtime/scene/build/light_watts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string_view>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

constexpr double kBurnt = 4;  // a white surface that is this bright is in another unit

// Numbers of a light of collada_*.sl as the scene stands.
struct LightNumbers {
    const Scene& scene;
    const ShaderUse& use;

    double largest(const char* name, double otherwise) const {
        for (const ParamSource& p : use.params)
            if (p.name == name && p.value.present()) {
                const double* values = scene.start.values.data() + p.value.offset;
                return *std::max_element(values, values + p.value.count);
            }
        return otherwise;
    }
};

// The light at a point: the direction it comes from and how bright it makes what faces it, by its
// largest component, which is linear above 1 whether colors are decoded or not.
struct Arriving {
    dvec3 from{0.0};
    double strength = 0;
};

Arriving light_at(const Scene& scene, const LightSource& light, dvec3 point) {
    const ShaderUse& use = scene.description->lights[light.definition].shader;
    const std::string& shader = use.shader->name;
    LightNumbers numbers{scene, use};
    double strength = std::max(numbers.largest("lightcolor", 1), 0.0);
    const dmat4& world = scene.start.nodes[light.node].world;
    dvec3 back = glm::normalize(dvec3(world[2]));  // lights look along -z of their nodes
    if (shader == "collada_ambient") return {dvec3(0.0), strength};
    if (shader == "collada_directional") return {back, strength};
    dvec3 way = dvec3(world[3]) - point;
    dvec3 from = way / std::max(glm::length(way), 1e-300);
    // A lamp in the very middle does not stand for what it is to light.
    double distance = std::max(glm::length(way), scene.size / 8);
    double d = distance / unit_of(path_conversion(scene, light.node));
    double attenuation = numbers.largest("constant_attenuation", 1) +
                         d * (numbers.largest("linear_attenuation", 0) +
                              d * numbers.largest("quadratic_attenuation", 0));
    if (shader == "collada_spot") {
        double cosine = glm::dot(from, back);
        bool beside = cosine < std::cos(radians(0.5 * numbers.largest("falloff_angle", 180)));
        double focus = std::pow(std::max(cosine, 0.0), numbers.largest("falloff_exponent", 0));
        strength = beside ? 0 : strength * focus;
    }
    return {from, attenuation > 0 ? strength / attenuation : 0};
}

// Of more lights, so many of the strongest are faced: each is summed over all.
constexpr size_t kMostFaced = 1000;

// How bright a white surface at the middle of the scene is that faces one of the lights.
double brightest_white(const Scene& scene, const std::vector<const LightSource*>& lights) {
    dvec3 middle = 0.5 * (scene.low + scene.high);
    std::vector<Arriving> arriving;
    for (const LightSource* light : lights) arriving.push_back(light_at(scene, *light, middle));
    if (arriving.size() > kMostFaced)
        std::nth_element(
            arriving.begin(), arriving.begin() + kMostFaced, arriving.end(),
            [](const Arriving& a, const Arriving& b) { return a.strength > b.strength; });
    double most = 0;
    for (size_t f = 0; f < std::min(arriving.size(), kMostFaced); ++f) {
        const Arriving& faced = arriving[f];
        double sum = 0;
        for (const Arriving& other : arriving) {
            bool ambient = other.from == dvec3(0.0);
            double cosine = ambient ? 1 : std::max(glm::dot(faced.from, other.from), 0.0);
            sum += other.strength * cosine;
        }
        most = std::max(most, sum);
    }
    return most;
}

void set_number(Scene& scene, ShaderUse& use, const char* name, double number) {
    std::vector<double>& values = scene.description->values;
    ParamSource source;
    source.name = name;
    source.value = {uint32_t(values.size()), 1};
    values.push_back(number);
    take_added_values(*scene.description, scene.start);
    std::erase_if(use.params, [&](const ParamSource& p) { return p.name == name; });
    use.params.push_back(std::move(source));
}

// The radiance of a white Lambert surface in Blender's picture: a point of P watts gives the
// irradiance P / (4 pi d^2), a sun of P its own number; over pi both. Spots are points in a cone.
void take_as_blender(Scene& scene, ShaderUse& use) {
    bool sun = use.shader->name == "collada_directional";
    set_number(scene, use, "intensity", sun ? 1 / kPi : 1 / (4 * kPi * kPi));
    if (sun) return;
    set_number(scene, use, "constant_attenuation", 0);
    set_number(scene, use, "linear_attenuation", 0);
    set_number(scene, use, "quadratic_attenuation", 1);
}

std::set<uint32_t> definitions_of(const std::vector<const LightSource*>& lights) {
    std::set<uint32_t> definitions;
    for (const LightSource* light : lights) definitions.insert(light->definition);
    return definitions;
}

}  // namespace

void scale_watts(Scene& scene, Diagnostics& diagnostics) {
    if (!scene.options.decode_textures) return;  // --color legacy: as the file says
    SceneDescription& description = *scene.description;
    std::vector<const LightSource*> blender, others;
    for (const LightSource& light : scene.lights) {
        const LightDefinition& definition = description.lights[light.definition];
        const rsl::Shader* shader = definition.shader.shader.get();
        if (light.surface != kNone || !shader || !shader->name.starts_with("collada_")) continue;
        bool watts = definition.blender_watts && shader->name != "collada_ambient";
        (watts ? blender : others).push_back(&light);
    }
    if (!blender.empty()) {
        for (uint32_t d : definitions_of(blender))
            take_as_blender(scene, description.lights[d].shader);
        diagnostics.report(Code::LIGHT_WATTS, description.lights[blender[0]->definition].where,
                           "they are Blender's, and as bright as there");
    }
    double white = brightest_white(scene, others);
    if (white > kBurnt && std::isfinite(white)) {
        for (uint32_t d : definitions_of(others))
            set_number(scene, description.lights[d].shader, "intensity", 1 / white);
        diagnostics.report(Code::LIGHT_WATTS, description.lights[others[0]->definition].where,
                           fmt::format("a white surface in the middle of the scene would be {:.3g} "
                                       "bright; the lights are divided by that",
                                       white));
    }
}

}  // namespace kinora
