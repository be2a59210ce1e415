// runtime/scene/build/instances/imager.cpp: the shader instance that runs over the finished
// picture.
#include "runtime/scene/build/instances/imager.h"

#include <algorithm>

#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

const std::vector<ShaderUse>& own_imagers(const SceneDescription& description,
                                          const CameraSource& camera) {
    return description.cameras[camera.definition].picture.imagers;
}

}  // namespace

const std::vector<ShaderUse>& imagers_of(const SceneDescription& description,
                                         const CameraSource& camera) {
    const std::vector<ShaderUse>& own = own_imagers(description, camera);
    return own.empty() ? description.picture.imagers : own;
}

void add_imager(const SceneDescription& description, const CameraSource& camera,
                SceneShaders& scene, std::span<const std::string> outputs) {
    const std::vector<ShaderUse>& layers = imagers_of(description, camera);
    if (layers.empty()) return;
    auto instance = std::make_unique<ShaderInstance>();
    instance->kind = ShaderInstanceKind::Imager;
    instance->name = "imager";
    instance->layers = layers;
    instance->node = own_imagers(description, camera).empty() ? kNone : camera.node;
    for (uint32_t l = 0; l < layers.size(); ++l)
        for (const rsl::ShaderParameter& p : layers[l].shader->parameters) {
            if (std::ranges::find(outputs, p.name) == outputs.end()) continue;
            VaryingParam varying;
            varying.name = varying.semantic = p.name;
            varying.layer = l;
            varying.components = uint32_t(rsl::component_count(p.type.base));
            instance->varying.push_back(std::move(varying));
        }
    scene.imager = uint32_t(scene.shader_instances.size());
    scene.shader_instances.push_back(std::move(instance));
}

}  // namespace kinora
