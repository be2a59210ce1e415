// runtime/scene/build/instances/surface_instances.cpp: shader instances of surfaces.
#include "runtime/scene/build/instances/surface_instances.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "runtime/scene/build/instances/vertex_inputs.h"
#include "runtime/scene/description/displacements.h"
#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/description/shader_library.h"

namespace kinora {

SurfaceInstances::SurfaceInstances(const SceneResources& resources, const SceneShapes& shapes,
                                   SceneShaders& scene, VertexInstances& vertices,
                                   VolumeInstances& volumes, Diagnostics& diagnostics)
    : resources_(resources),
      shapes_(shapes),
      scene_(scene),
      vertices_(vertices),
      volumes_(volumes),
      diagnostics_(diagnostics) {}

void SurfaceInstances::add(Surface& surface, const SurfaceUse& surface_use) {
    const SceneDescription& description = *resources_.description;
    const MaterialUse* use = surface_use.material;
    surface.material = use ? use->material : kNone;
    const MaterialDefinition& material =
        surface.material != kNone ? description.materials[surface.material] : default_material();
    vertices_.add(ShaderInstanceKind::Transformation, surface, use, material);
    if (resources_.options.quality.displacement != DisplacementMode::Bump)
        vertices_.add(ShaderInstanceKind::Displacement, surface, use, material);
    const Shape& shape = shapes_.shapes[surface.shape];
    bool moved = surface.displacement.instance != kNone;
    std::vector<ShaderUse> displacements = displacements_of(material);
    // A class's displacement() that did not run on the vertices runs in its surface.
    if (!moved && surface_displaces(material)) displacements.clear();
    KeyedInstance made = begin_instance(description, ShaderInstanceKind::Surface, material,
                                        with_surfaces(displacements, material), use, shape.node);
    volumes_.add(surface, material, use);
    ShaderInstance& instance = *made.instance;
    instance.lights = surface_use.mesh->lights;
    if (instance.lights) made.key += fmt::format("|lights {}", fmt::join(*instance.lights, ","));
    if (moved) instance.done_layers = uint32_t(displacements.size());
    const PrimitiveGroup& group = *shapes_.meshes[shape.mesh].groups[surface.group].definition;
    VertexInputs inputs = find_vertex_inputs(group, use, instance.layers);
    add_displaced_inputs(instance.layers, instance.done_layers, inputs);
    surface.st = inputs.st;
    surface.uv = find_attribute(group, kSurfaceParameters);
    surface.varying = std::move(inputs.attributes);
    instance.varying = std::move(inputs.varying);
    made.key += varying_key(instance);
    surface.look = find_or_add(std::move(made));
}

uint32_t SurfaceInstances::find_or_add(KeyedInstance made) {
    auto [entry, is_new] = by_key_.try_emplace(made.key, uint32_t(scene_.shader_instances.size()));
    if (is_new) scene_.shader_instances.push_back(std::move(made.instance));
    return entry->second;
}

const MaterialDefinition& SurfaceInstances::default_material() {
    if (!default_material_.surfaces.empty()) return default_material_;
    const auto& own = resources_.description->default_surface;
    default_material_.name = "default";
    ShaderUse use;
    use.shader = own ? own : library_shader("default_surface");
    use.linear_inputs = !own;
    use.untinted = !own && !resources_.description->tints;
    default_material_.surfaces.push_back(std::move(use));
    return default_material_;
}

// A light without a surface shader: Lamps shows what it sends, or its colour where it is left out.
std::vector<ShaderUse> SurfaceInstances::emitter(const MaterialDefinition& material) {
    ShaderUse use;
    use.shader = library_shader("area_emitter");
    for (const ParamSource& source : material.lights.back().params)
        if (source.name == "lightcolor") use.params.push_back(source);
    return {use};
}

// Displacements, then what is seen: the default surface of a material that only displaces.
std::vector<ShaderUse> SurfaceInstances::with_surfaces(std::vector<ShaderUse> layers,
                                                       const MaterialDefinition& material) {
    std::vector<ShaderUse> seen = material.surfaces;
    if (seen.empty())
        seen = material.lights.empty() ? default_material().surfaces : emitter(material);
    layers.insert(layers.end(), seen.begin(), seen.end());
    return layers;
}

}  // namespace kinora
