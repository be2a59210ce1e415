// runtime/build/build_scene.h: from a description to a scene ready for frames.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "raytrace/camera.h"
#include "runtime/scene/scene.h"

namespace kinora {

// A view that displaced meshes are to be fine enough for, beside those of the range played.
struct CloserView {
    double time = 0;                         // seconds: how deforming meshes stand
    std::optional<raytrace::Camera> camera;  // accel space; none: the scene's own at that time
};

// A scene built again, from the same description (as import gave it) and options, for one view
// more. Its accel space is that of the first.
struct BuildAgain {
    CloserView view;
    std::shared_ptr<TextureStore> textures;   // of the first
    const std::atomic<bool>* stop = nullptr;  // once it is true build_scene gives up
};

// Unrolls the nodes, places meshes, lights and cameras, lowers and compiles every look. Errors (no
// such camera, a shader that cannot be compiled) are findings; nothing is returned when the scene
// cannot be rendered. The description is extended (default camera and lights), and loses what no
// one reads again.
std::unique_ptr<Scene> build_scene(std::shared_ptr<SceneDescription> description,
                                   const SceneOptions& options, Diagnostics& diagnostics,
                                   const BuildAgain* again = nullptr);

}  // namespace kinora
