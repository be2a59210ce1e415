// runtime/scene/build/build_scene.h: from a description to a scene ready for frames.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "runtime/scene/build/displacement/closer_view.h"
#include "runtime/scene/scene.h"

namespace kinora {

// A scene built again, from the same description (as import gave it). Its accel space is that of
// the first.
struct BuildAgain {
    std::optional<CloserView> view;           // one more that meshes are diced for
    std::shared_ptr<TextureStore> textures;   // of the first
    const std::atomic<bool>* stop = nullptr;  // once it is true build_scene gives up
};

// Unrolls the nodes, adds meshes, cameras and lights, lowers and compiles the shader instances.
// Errors (no such camera, a shader that cannot be compiled) are findings; nothing is returned when
// the scene cannot be rendered. The description is extended (default camera and lights), and loses
// what nothing reads again.
std::unique_ptr<Scene> build_scene(std::shared_ptr<SceneDescription> description,
                                   const SceneOptions& options, Diagnostics& diagnostics,
                                   const BuildAgain* again = nullptr);

}  // namespace kinora
