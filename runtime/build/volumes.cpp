// runtime/build/volumes.cpp: looks of volumes: what fills or surrounds objects, and the atmosphere.
#include <fmt/format.h>

#include "runtime/build/scene_p.h"
#include "runtime/description/findings.h"
#include "runtime/scene/medium.h"

namespace kinora {

// A look a node: "object" and "shader" are the space of the node whose material has the volume,
// whatever surface lies behind it.
uint32_t SceneBuilder::volume_look(const std::vector<ShaderUse>& layers, const std::string& name,
                                   uint32_t node, const MaterialUse* use, bool exterior) {
    Scene& scene = *scene_;
    auto look = std::make_unique<ShaderInstance>();
    look->kind = ShaderInstanceKind::Volume;
    look->name = name;
    look->layers = layers;
    look->node = node;
    std::string key = fmt::format("volume {} {}", static_cast<const void*>(layers.data()), node);
    apply_binds(use, look->layers, key);
    auto [place, is_new] = looks_by_key_.try_emplace(key, uint32_t(scene.looks.size()));
    if (!is_new) return place->second;
    if (scene.volumes.size() == kMaxVolumes) {
        diagnostics_.report(Code::VOLUME_LIMIT, Location{}, kMaxVolumes, name);
        return place->second = kNone;
    }
    scene.volumes.push_back(place->second);
    look->volume = uint32_t(scene.volumes.size());
    look->exterior = exterior;
    scene.looks.push_back(std::move(look));
    return place->second;
}

void SceneBuilder::add_volumes(Surface& surface, const MaterialDefinition& material,
                               const MaterialUse* use) {
    uint32_t node = scene_->shapes[surface.shape].node;
    const std::string& name = material.id.empty() ? material.name : material.id;
    if (!material.interior.empty())
        surface.interior = volume_look(material.interior, name, node, use, false);
    if (!material.exterior.empty())
        surface.exterior = volume_look(material.exterior, name, node, use, true);
}

// The camera's, in its space; else the scene's, in world space.
void SceneBuilder::add_atmosphere() {
    Scene& scene = *scene_;
    const CameraSource& camera = scene.cameras[scene.camera];
    const auto& own = description_.cameras[camera.definition].picture.atmosphere;
    const auto& layers = own.empty() ? description_.picture.atmosphere : own;
    if (layers.empty()) return;
    auto look = std::make_unique<ShaderInstance>();
    look->kind = ShaderInstanceKind::Volume;
    look->name = "atmosphere";
    look->layers = layers;
    look->node = own.empty() ? kNone : camera.node;
    scene.atmosphere = uint32_t(scene.looks.size());
    scene.looks.push_back(std::move(look));
}

}  // namespace kinora
