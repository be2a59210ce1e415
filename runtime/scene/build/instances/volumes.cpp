// runtime/scene/build/instances/volumes.cpp: shader instances of volumes: what fills or surrounds
// objects, and the atmosphere.
#include "runtime/scene/build/instances/volumes.h"

#include <fmt/format.h>

#include "runtime/scene/build/instances/material_instance.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/medium.h"

namespace kinora {

namespace {

std::unique_ptr<ShaderInstance> volume_instance(std::string name,
                                                const std::vector<ShaderUse>& layers,
                                                uint32_t node) {
    auto instance = std::make_unique<ShaderInstance>();
    instance->kind = ShaderInstanceKind::Volume;
    instance->name = std::move(name);
    instance->layers = layers;
    instance->node = node;
    return instance;
}

}  // namespace

void VolumeInstances::add(Surface& surface, const MaterialDefinition& material,
                          const MaterialUse* use) {
    uint32_t node = shapes_.shapes[surface.shape].node;
    const std::string& name = material.id.empty() ? material.name : material.id;
    if (!material.interior.empty())
        surface.interior = add_volume(material.interior, name, node, use, false);
    if (!material.exterior.empty())
        surface.exterior = add_volume(material.exterior, name, node, use, true);
    if (material.atmosphere != kNone) surface.atmosphere = add_atmosphere(material.atmosphere);
}

// One for all of its surfaces, whose shaders name their spaces.
uint32_t VolumeInstances::add_atmosphere(uint32_t atmosphere) {
    auto [entry, is_new] =
        atmospheres_.try_emplace(atmosphere, uint32_t(scene_.shader_instances.size()));
    if (!is_new) return entry->second;
    scene_.own_atmospheres = true;
    scene_.shader_instances.push_back(
        volume_instance("atmosphere", description_.atmospheres[atmosphere], kNone));
    return entry->second;
}

// An instance a node: "object" and "shader" are the space of the node whose material has the
// volume, whatever surface lies behind it.
uint32_t VolumeInstances::add_volume(const std::vector<ShaderUse>& layers, const std::string& name,
                                     uint32_t node, const MaterialUse* use, bool exterior) {
    auto instance = volume_instance(name, layers, node);
    std::string key = fmt::format("{} {}", static_cast<const void*>(layers.data()), node);
    apply_binds(description_, use, instance->layers, key);
    auto [entry, is_new] = by_key_.try_emplace(key, uint32_t(scene_.shader_instances.size()));
    if (!is_new) return entry->second;
    if (scene_.volumes.size() == kMaxVolumes) {
        diagnostics_.report(Code::VOLUME_LIMIT, Location{}, kMaxVolumes, name);
        return entry->second = kNone;
    }
    scene_.volumes.push_back(entry->second);
    instance->volume = uint32_t(scene_.volumes.size());
    instance->exterior = exterior;
    scene_.shader_instances.push_back(std::move(instance));
    return entry->second;
}

void add_atmosphere(const SceneDescription& description, const CameraSource& camera,
                    SceneShaders& scene) {
    const auto& own = description.cameras[camera.definition].picture.atmosphere;
    const auto& layers = own.empty() ? description.picture.atmosphere : own;
    if (layers.empty()) return;
    scene.atmosphere = uint32_t(scene.shader_instances.size());
    scene.shader_instances.push_back(
        volume_instance("atmosphere", layers, own.empty() ? kNone : camera.node));
}

}  // namespace kinora
