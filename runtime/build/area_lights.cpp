// runtime/build/area_lights.cpp: surfaces whose material has a LIGHT shader become area lights.
#include "runtime/build/scene_p.h"
#include "runtime/description/shader_library.h"

namespace kinora {

// The material that the instance gives a surface, null if none.
const MaterialUse* SceneBuilder::material_use(size_t surface) const {
    const Surface& s = scene_->surfaces[surface];
    const std::string& symbol = scene_->meshes[scene_->shapes[s.shape].mesh].groups[s.group].symbol;
    const MaterialUse* found = nullptr;
    for (const MaterialUse& use : uses_[surface]->materials)
        if (use.symbol == symbol) found = &use;
    return found;
}

// A light a surface and LIGHT shader. Whether there is any.
bool SceneBuilder::add_area_lights() {
    Scene& scene = *scene_;
    size_t before = scene.lights.size();
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
        const MaterialUse* use = material_use(s);
        if (!use || use->material == kNone) continue;
        const MaterialDefinition& material = description_.materials[use->material];
        std::vector<ShaderUse> lights = material.lights;
        std::string key;
        apply_binds(use, lights, key);
        for (ShaderUse& light : lights) {
            LightDefinition definition;
            definition.id = material.id;
            definition.name = material.name;
            definition.shader = std::move(light);
            definition.shadows = material.light_shadows;
            definition.samples = material.light_samples;
            description_.lights.push_back(std::move(definition));
            scene.lights.push_back({uint32_t(description_.lights.size() - 1),
                                    scene.shapes[scene.surfaces[s].shape].node, kNone, s});
        }
    }
    return scene.lights.size() > before;
}

// A light without a surface shader is seen in its colour.
std::vector<ShaderUse> SceneBuilder::emitter(const MaterialDefinition& material) {
    ShaderUse use;
    use.shader = library_shader("area_emitter", diagnostics_);
    for (const ParamSource& source : material.lights.back().params)
        if (source.name == "lightcolor") use.params.push_back(source);
    return {use};
}

}  // namespace kinora
