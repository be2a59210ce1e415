// runtime/scene/build/emission.cpp: which surfaces emit, and which of these are lights.
#include "runtime/scene/build/emission.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/build/instances/material_instance.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

constexpr size_t kMostLights = 4;  // more surfaces share one, which is sampled as often as each
// Of the square of the scene's size. A room's ceiling has a third, the sphere about it a whole.
constexpr double kMostArea = 0.4;

// What emits of a shader of the library: a color, or the map of that name with _map.
struct EmissionRow {
    const char* shader;
    const char* color;
};
constexpr EmissionRow kRows[] = {{"collada_blinn", "emission"},
                                 {"collada_constant", "emission"},
                                 {"collada_lambert", "emission"},
                                 {"collada_phong", "emission"},
                                 {"gltf_pbr", "emissive"}};

// Whether a number of the slot is not 0, or is animated.
bool may_shine(const SceneDescription& description, const ValueSlot& slot) {
    for (size_t i = slot.offset; slot.present() && i < size_t(slot.offset) + slot.count; ++i)
        if (description.values[i] != 0 ||
            (i < description.animated.size() && description.animated[i]))
            return true;
    return false;
}

bool emits(const SceneDescription& description, const ShaderUse& surface) {
    for (const EmissionRow& row : kRows) {
        if (surface.shader != library_shader(row.shader)) continue;
        const ParamSource* color = surface.find(row.color);
        const ParamSource* map = surface.find(std::string(row.color) + "_map");
        const bool mapped = map && !map->strings.empty() && !map->strings[0].empty();
        const bool by_color = color && may_shine(description, color->value);
        // The map of glTF is a factor of the color, that of COLLADA stands in its place.
        return mapped && surface.shader->name != "gltf_pbr" ? true : by_color;
    }
    return false;
}

bool emits(const SceneDescription& description, const MaterialUse* use) {
    if (!use || use->material == kNone) return false;
    const MaterialDefinition& material = description.materials[use->material];
    if (!material.lights.empty()) return false;  // which say what it sends
    std::vector<ShaderUse> layers = material.surfaces;
    std::string key;
    apply_binds(description, use, layers, key);
    return layers.size() == 1 && emits(description, layers[0]);
}

double area_of(const Scene& scene, const Surface& surface) {
    const Shape& shape = scene.shapes[surface.shape];
    const Mesh& mesh = scene.meshes[shape.mesh];
    const dmat3 linear(scene.start.shapes[surface.shape].world);
    const auto& triangles = mesh.groups[surface.group].triangles;
    double sum = 0;
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        auto corner = [&](size_t k) { return linear * dvec3(mesh.positions[triangles[t + k]]); };
        const double area =
            0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        if (std::isfinite(area)) sum += area;
    }
    return sum;
}

// Those that emit and do not surround the scene: the small ones first.
std::vector<uint32_t> emitting_surfaces(const Scene& scene, std::span<const SurfaceUse> uses) {
    std::vector<std::pair<double, uint32_t>> by_area;
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
        if (emits(*scene.description, uses[s].material))
            by_area.push_back({area_of(scene, scene.surfaces[s]), s});
    std::ranges::sort(by_area);
    std::vector<uint32_t> surfaces;
    double left = kMostArea * scene.size * scene.size;
    for (const auto& [area, surface] : by_area) {
        left -= area;
        if (left < 0) break;
        surfaces.push_back(surface);
    }
    std::ranges::sort(surfaces);
    return surfaces;
}

void add_light(Scene& scene, std::span<const uint32_t> surfaces) {
    LightDefinition light;
    light.id = light.name = "emission";
    light.shader.shader = library_shader("emission");
    light.indirect = true;
    scene.description->lights.push_back(std::move(light));
    const uint32_t node = scene.shapes[scene.surfaces[surfaces[0]].shape].node;
    LightSource source{uint32_t(scene.description->lights.size() - 1), node, kNone, surfaces[0],
                       kNone};
    source.emitting.assign(surfaces.begin(), surfaces.end());
    scene.lights.push_back(std::move(source));
}

}  // namespace

void add_emission_lights(Scene& scene, std::span<const SurfaceUse> uses) {
    const std::vector<uint32_t> surfaces = emitting_surfaces(scene, uses);
    for (uint32_t s : surfaces) scene.surfaces[s].seen_by |= raytrace::kSeenAsLamp;
    if (surfaces.size() > kMostLights) return add_light(scene, surfaces);
    for (const uint32_t& s : surfaces) add_light(scene, {&s, 1});
}

}  // namespace kinora
