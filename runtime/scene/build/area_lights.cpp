// runtime/scene/build/area_lights.cpp: surfaces that shine.
#include "runtime/scene/build/area_lights.h"

#include "runtime/scene/build/instances/material_instance.h"

namespace kinora {

bool add_area_lights(SceneDescription& description, SceneShapes& shapes, SceneLights& scene,
                     std::span<const SurfaceUse> uses) {
    size_t before = scene.lights.size();
    for (uint32_t s = 0; s < shapes.surfaces.size(); ++s) {
        const MaterialUse* use = uses[s].material;
        if (!use || use->material == kNone) continue;
        const MaterialDefinition& material = description.materials[use->material];
        std::vector<ShaderUse> lights = material.lights;
        std::string key;  // each surface is a light of its own
        apply_binds(description, use, lights, key);
        if (!lights.empty()) shapes.surfaces[s].seen_by |= raytrace::kSeenAsLamp;
        for (ShaderUse& light : lights) {
            LightDefinition definition;
            definition.id = material.id;
            definition.name = material.name;
            definition.shader = std::move(light);
            definition.shadows = material.light_shadows;
            definition.samples = material.light_samples;
            description.lights.push_back(std::move(definition));
            scene.lights.push_back({uint32_t(description.lights.size() - 1),
                                    shapes.shapes[shapes.surfaces[s].shape].node, kNone, s,
                                    material.light});
        }
    }
    return scene.lights.size() > before;
}

}  // namespace kinora
