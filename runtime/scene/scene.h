// runtime/scene/scene.h: a scene in memory: what no time changes. Made by build_scene from a
// description, and constant afterwards. A Pose (runtime/scene/pose.h) holds what a time decides.
//
// Spaces: "world" is the root file's own; "accel" is world minus Scene::origin, as floats;
// "current" is camera space (x right, y up, z into the picture).
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "anim/animation.h"
#include "runtime/base/memory/shared_vector.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/scene_options.h"
#include "runtime/scene/shapes.h"
#include "skin/morph.h"

namespace kinora {

struct ShaderInstance;  // runtime/scene/shaders/shader_instance.h
class TextureStore;     // runtime/scene/images/texture_store.h
class PointStore;       // runtime/scene/images/point_store.h
struct WatchedEdges;    // runtime/scene/vertices/dice_error.h

// One occurrence of a node definition; parents come first.
struct Node {
    uint32_t definition = kNone;
    uint32_t parent = kNone;
    bool can_move = false;  // it or an ancestor is animated
    bool hidden = false;    // it or an ancestor is
    bool chosen = true;     // its meshes are there (SceneDescription::only_chosen)
    dmat4 conversion{1.0};  // of the reference that brought it in
};

// The ray tracer's tree of a scene in which nothing moves: its first pose makes it, all share it.
struct StillTree {
    std::mutex mutex;
    std::optional<raytrace::Accel> accel;
};

// An occurrence of a light.
struct LightSource {
    uint32_t definition = kNone;
    uint32_t node = kNone;
    uint32_t look = kNone;
    uint32_t surface = kNone;  // whose triangles shine; kNone: no area light
};

// What an animation can move; all else stands in every pose as in the first frame of each.
struct MovingParts {
    std::vector<uint32_t> nodes, shapes, surfaces;  // indices, in order
};

struct CameraSource {
    uint32_t definition = kNone;  // kNone: the default camera
    uint32_t node = kNone;
    std::string name;  // as --camera takes it
};

// A plane of the film: one component of an output parameter of surfaces.
struct OutputPlane {
    std::string name;       // as the film has it: "glow.R", "dirt", "lamps.2.R"
    std::string parameter;  // "glow"
    uint32_t component = 0;
    int element = -1;     // of an array; -1: it is none
    bool in_file = true;  // false: only an imager reads it
};

// What dicing made at load.
struct DiceStats {
    double ms = 0;
    size_t triangles = 0, vertices = 0;
    double pixels = 0;  // edge length used; more than asked for where the limit bound
};

// What copies of a scene share, or hold themselves where it is small.
struct SceneParts {
    std::shared_ptr<SceneDescription> description;
    std::vector<anim::Sampler> baked_samplers;  // instead of the description's; none: those

    SharedVector<Node> nodes;
    SharedVector<Mesh> meshes;
    SharedVector<skin::Morph> morphs;
    SharedVector<Shape> shapes;
    SharedVector<Surface> surfaces;
    std::vector<LightSource> lights;
    MovingParts moving;
    std::vector<CameraSource> cameras;
    std::vector<std::shared_ptr<ShaderInstance>> shader_instances;
    // Displacements and transformations.
    std::vector<std::shared_ptr<ShaderInstance>> vertex_instances;
    uint32_t atmosphere = kNone;  // the volume outside all objects, into shader_instances
    uint32_t imager = kNone;      // what the finished picture is run through, into shader_instances
    std::vector<OutputPlane> outputs;
    // Interiors and exteriors, into shader_instances: ShaderInstance::volume is k + 1.
    std::vector<uint32_t> volumes;
    std::vector<std::string> added;  // "default camera", "default key light": what --list shows
    // Frames of a pose whose points are counted for LIGHTS_DARK: only its own lights shine.
    uint32_t watch_dark = 0;
    float world_light = 0;  // the brightness of the grey world that was added, which is no light

    DiceStats dice;
    std::vector<std::shared_ptr<WatchedEdges>> watched;  // by displaced mesh that was diced
    std::vector<size_t> vertex_outputs;  // floats of each attribute with VertexAttribute::output

    dvec3 origin{0.0};
    double size = 1;  // diagonal of the first frame's bounds
    dvec3 low{0.0}, high{0.0};

    SharedVector<raytrace::Geometry> rows;   // one a surface; a pose has those of its own vertices
    std::shared_ptr<StillTree> still_tree;   // null: something moves
    std::shared_ptr<TextureStore> textures;  // what names in shaders stand for
    std::shared_ptr<PointStore> points;
    SceneOptions options;
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
