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
#include "skin/morph.h"
#include "skin/skeleton.h"
#include "skin/skin.h"

namespace kinora {

struct ShaderInstance;  // runtime/scene/shaders/shader_instance.h
class VertexWork;       // runtime/scene/vertices/vertex_work.h
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

// Rest data of a mesh, shared by all its shapes. Positions are minus `anchor`.
struct MeshGroup {
    std::string symbol;
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> normal_corners;  // entry of Mesh::normals for each corner; empty: flat
    const PrimitiveGroup* definition = nullptr;  // texture coordinates, colours
    // The file gives no normals: N is Ng at each hit.
    bool flat() const { return normal_corners.empty(); }
};
struct Mesh {
    dvec3 anchor{0.0};
    std::vector<vec4> positions;
    std::vector<vec4> normals;
    std::vector<uint32_t> normal_positions;  // position of each normal
    std::vector<MeshGroup> groups;
    bool double_sided = true;
    // Bounds of the triangles as in the document; low > high: there are none.
    dvec3 low{0.0}, high{0.0};
    uint32_t definition = kNone;  // index into SceneDescription::meshes
    // Groups of a diced mesh, which no document holds.
    std::vector<std::unique_ptr<PrimitiveGroup>> own_groups;
};

// A mesh on a node, with what deforms it.
struct Shape {
    Shape();
    ~Shape();
    Shape(Shape&&) noexcept;
    Shape& operator=(Shape&&) noexcept;

    raytrace::GeometryKind kind = raytrace::GeometryKind::Static;
    uint32_t mesh = kNone;
    uint32_t node = kNone;
    uint32_t skin = kNone;        // index into SceneDescription::skins
    uint32_t morph = kNone;       // index into SceneDescription::morphs
    uint32_t morph_data = kNone;  // index into Scene::morphs: of it and those it changes
    dmat4 conversion{1.0};
    bool in_world = false;  // a skin's result is in world space; its node's matrix does not apply
    uint32_t applies_below = kNone;     // if it does: below this node, which moves the joints, too
    std::vector<uint32_t> joint_nodes;  // scene nodes

    // Of a static shape: where its triangles stand, accel space.
    std::vector<vec4> positions, normals;

    skin::Skeleton skeleton;
    skin::SkinMesh skin_mesh;

    // Displacement and transformation that run at frames; null where none does. Without a skin they
    // move the (morphed) mesh and the node's matrix comes after; with one they move what it gives.
    std::unique_ptr<VertexWork> vertex_work;
};

// A shader that moves a surface's vertices.
struct VertexUse {
    uint32_t instance = kNone;  // into Scene::vertex_instances
    std::vector<const VertexAttribute*> varying;
};

// Triangles of one shape that share a shader instance: a row of the ray tracer.
struct Surface {
    uint32_t shape = kNone;
    uint32_t group = kNone;
    uint32_t look = kNone;      // into Scene::shader_instances
    uint32_t material = kNone;  // index into description.materials, kNone: the default
    uint32_t interior =
        kNone;  // volumes inside and around, into Scene::shader_instances; kNone: none
    uint32_t exterior = kNone;
    const VertexAttribute* st = nullptr;  // the bound or lowest TEXCOORD set; null if none
    // Vertex inputs of the instance's varying parameters, in the order of ShaderInstance::varying.
    std::vector<const VertexAttribute*> varying;
    VertexUse transformation, displacement;
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
