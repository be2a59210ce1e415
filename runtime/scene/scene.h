// runtime/scene/scene.h: a scene in memory: what no time changes. Made by build_scene from a
// description, and constant afterwards. A Pose (runtime/scene/pose.h) holds what a time decides.
//
// Spaces: "world" is the root file's own; "accel" is world minus Scene::origin, as floats;
// "current" is camera space (x right, y up, z into the picture).
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/accel.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/lights.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// The ray tracer's tree of a scene in which nothing moves: its first pose makes it, all share it.
struct StillTree {
    std::mutex mutex;
    std::optional<raytrace::Accel> accel;
};

// What copies of a scene share, or hold themselves where it is small. A function takes the parts
// that it reads.
struct SceneParts : SceneNodes, SceneShapes, SceneLights, SceneCameras, SceneShaders {
    std::vector<std::string> added;  // "default camera", "default key light": what --list shows
    std::shared_ptr<StillTree> still_tree;  // null: something moves
};

struct Scene : SceneParts {
    Scene() = default;
    // Another scene that begins as that one does: its start is to be filled.
    explicit Scene(const SceneParts& parts) : SceneParts(parts) {}
    Scene(const Scene&) = delete;

    // As the scene stands at its start time. build_scene works in it, and takes its vertices away
    // at its end.
    Pose start;
};

// A scene with the pose that its frames are made in.
struct PosedScene {
    std::unique_ptr<Scene> scene;
    std::unique_ptr<Pose> pose;
    explicit operator bool() const { return scene != nullptr; }
};

}  // namespace kinora
