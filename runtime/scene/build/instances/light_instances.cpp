// runtime/scene/build/instances/light_instances.cpp: shader instances of lights.
#include "runtime/scene/build/instances/light_instances.h"

#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

// COLLADA's attenuation is by distance in units of the light's file.
void set_unit(const SceneNodes& scene, Pose& start, uint32_t node, ShaderUse& use) {
    double unit = unit_of(path_conversion(scene, node));
    if (unit == 1 || !use.shader->name.starts_with("collada_")) return;
    std::vector<double>& values = scene.description->values;
    ParamSource source;
    source.name = "unit";
    source.value = {uint32_t(values.size()), 1};
    values.push_back(unit);
    take_added_values(*scene.description, start);
    use.params.push_back(std::move(source));
}

std::unique_ptr<ShaderInstance> light_instance(const SceneNodes& scene, Pose& start,
                                               const LightSource& light) {
    const LightDefinition& definition = scene.description->lights[light.definition];
    auto instance = std::make_unique<ShaderInstance>();
    instance->kind = ShaderInstanceKind::Light;
    instance->name = definition.id.empty() ? definition.name : definition.id;
    instance->layers = {definition.shader};
    set_unit(scene, start, light.node, instance->layers.front());
    instance->node = light.node;
    instance->area_light = light.surface != kNone;
    return instance;
}

}  // namespace

bool add_light_instances(const SceneNodes& nodes, SceneLights& lights, SceneShaders& shaders,
                         Pose& start, InstanceCompiler& compiler,
                         const std::vector<std::string>& messages) {
    std::erase_if(lights.lights, [&](const LightSource& light) {
        return !nodes.description->lights[light.definition].shader.shader;
    });
    ShaderInstanceOptions wanted;
    wanted.light_messages = messages;
    bool ok = true;
    for (LightSource& light : lights.lights) {
        if (light.look != kNone) continue;
        auto instance = light_instance(nodes, start, light);
        ok &= compiler.compile(*instance, wanted);
        light.look = instance->index = uint32_t(shaders.shader_instances.size());
        shaders.shader_instances.push_back(std::move(instance));
    }
    return ok;
}

}  // namespace kinora
