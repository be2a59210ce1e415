// runtime/scene/scene.h: a scene in memory, ready for frames. Made by build_scene from a
// description; changed by the steps of render_frame only. State depends on the time alone, never on
// the frame before.
//
// Spaces: "world" is the root file's own; "accel" is world minus Scene::origin, as floats;
// "current" is camera space (x right, y up, z into the picture).
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "anim/animation.h"
#include "anim/baked.h"
#include "jit/math/math.h"
#include "jit/target.h"
#include "raytrace/accel.h"
#include "raytrace/camera.h"
#include "raytrace/integrator.h"
#include "runtime/base/arena.h"
#include "runtime/base/diagnostic.h"
#include "runtime/description/scene_description.h"
#include "runtime/description/texture_name.h"
#include "skin/dual_quaternion.h"
#include "skin/morph.h"
#include "skin/skin.h"

namespace kinora {

struct ShaderInstance;  // runtime/shading/shader_instance.h
class VertexWork;       // runtime/vertices/vertex_work.h
class TextureStore;     // runtime/images/texture_store.h
class PointStore;       // runtime/images/point_store.h
struct WatchedEdges;    // runtime/vertices/dice_error.h

// One occurrence of a node definition; parents come first.
struct Node {
    uint32_t definition = kNone;
    uint32_t parent = kNone;
    bool can_move = false;  // it or an ancestor is animated
    bool moved = true;      // by the last update_transforms
    bool hidden = false;    // it or an ancestor is
    bool chosen = true;     // its meshes are there (SceneDescription::only_chosen)
    bool finite = true;     // else `world` is all zero
    bool told = false;      // that it is not finite
    dmat4 conversion{1.0};  // of the reference that brought it in
    dmat4 world{1.0};       // world_from_node
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

    // Where the triangles stand now: own buffers (accel space) for static and deforming shapes,
    // the mesh's own for instanced ones.
    std::vector<vec4> positions, normals;
    dmat4 world{1.0};  // world_from_mesh: the node's matrix and the conversion (not the anchor)
    bool mirrored = false;
    uint32_t positions_version = 0;

    skin::Skeleton skeleton;
    skin::SkinMesh skin_mesh;
    std::vector<dmat4> joint_world;  // world_from_joint, in joint order
    std::vector<skin::JointMatrix> palette;
    std::vector<skin::DualJoint> dual_palette;  // of SkinMethod::Dual, else empty
    std::vector<vec4> morphed_positions, morphed_normals;
    std::vector<double> morph_weights;  // of morph_data's targets

    // Displacement and transformation that run at frames; null where none does. Without a skin they
    // move the (morphed) mesh and the node's matrix comes after; with one they move what it gives.
    std::unique_ptr<VertexWork> vertex_work;
    std::vector<vec4> displaced_positions, displaced_normals;  // without a skin

    std::span<const vec4> rest_positions, rest_normals;  // what the ray tracer and shading read
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

// An occurrence of a light.
struct LightSource {
    uint32_t definition = kNone;
    uint32_t node = kNone;
    uint32_t look = kNone;
    uint32_t surface = kNone;  // whose triangles shine; kNone: no area light
};

// What an animation can move; all else stays as the first frame left it.
struct MovingParts {
    std::vector<uint32_t> nodes, shapes, surfaces;  // indices, in order
    bool rest_finite = true;                        // the matrices of all other nodes
};

struct CameraSource {
    uint32_t definition = kNone;  // kNone: the default camera
    uint32_t node = kNone;
    std::string name;  // as --camera takes it
};

enum class ShadowMode : uint8_t { Auto, Explicit, Off };
// Which lights shine: the scene's, and the default ones where it has none that light anything
// (Auto); only the scene's; only the default ones; both.
enum class LightSet : uint8_t { Auto, Scene, Default, Both };
enum class DisplacementMode : uint8_t { True, Bump };
// How joints are blended: by their matrices, as COLLADA has it, or by dual quaternions.
enum class SkinMethod : uint8_t { Linear, Dual };

// How a camera is put up that no file brought, and what it is to see.
struct ViewOptions {
    bool follow = false;      // it moves with the centre of what it shows
    double turn_seconds = 0;  // of a full turn about the up axis; 0: none
    double turn_start = 0;    // seconds
    double yfov = 0;          // degrees, of any camera; 0: its own
    std::optional<dvec3> from, at;
    std::string at_node;  // at the node with this path, id or name

    bool any_place() const { return follow || turn_seconds > 0 || from || at || !at_node.empty(); }
};

// What a scene is built for; part of what the kernels are.
struct SceneOptions {
    // A view (runtime/build/views.h), or a node path or id or a camera id, the latter also behind
    // '#'; "": the first instance in document order, if it sees something of the scene.
    std::string camera;
    ViewOptions view;
    jit::math::Tier math = jit::math::Tier::Precise;
    const jit::Target* target = nullptr;  // null: the best of this CPU
    ShadowMode shadows = ShadowMode::Auto;
    LightSet lights = LightSet::Auto;
    int ray_depth = 16;  // rays that trace, gather and indirectdiffuse may hang behind each other
    int diffuse_depth = 1;  // of those, bounces of indirectdiffuse
    int split = 1;  // hits of a path where both what is reflected and what passes is followed
    int ray_limit = 1000;  // rays that a camera ray's points may shoot (docs/rays.md#budgets)
    raytrace::AccelPolicy accel;
    anim::KeyOptions keys;    // how curves through keys are followed
    bool derivatives = true;  // of shaders; false: Du, Dv and the widths of filters are 0
    TextureFilter texture_filter = TextureFilter::Anisotropic;  // the best that lookups have
    bool decode_textures = true;  // 8-bit colours from sRGB; false: --color legacy
    uint32_t light_samples = 0;   // of area lights; 0: the file's, else 16
    // The weakest lights of a point cast no shadow rays and count as shadowed, up to this share of
    // what all lights send there.
    float weak_lights = 0;
    // Classes: where opacity() leaves no channel above it, the point counts as a hole.
    float opacity_threshold = 0;
    std::vector<std::string> aovs;  // output parameters of surfaces that the picture keeps
    double frame_rate = 0;          // frames a second that option("Frame") counts; 0: the file's
    // Range played, seconds: what added cameras frame, and its views tell how fine to dice.
    double start_time = 0, end_time = 0;
    DisplacementMode displacement = DisplacementMode::True;  // Bump: only N is bent
    SkinMethod skin_method = SkinMethod::Linear;
    uint32_t influences = 0;        // the strongest that a vertex keeps; 0: all
    double dice = 2;                // length of a displaced surface's edges, pixels
    size_t dice_limit = 4'000'000;  // triangles of all displaced surfaces together
    int width = 640, height = 0;    // of the picture that dicing is for; 0: from the camera
    std::vector<std::pair<std::string, std::string>> dumps;  // filled when want_dumps
    bool want_dumps = false;
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

class Shading;  // runtime/shading/shading.h

struct Scene {
    Scene();
    ~Scene();
    Scene(const Scene&) = delete;

    std::shared_ptr<SceneDescription> description;
    std::vector<anim::Sampler> baked_samplers;  // instead of the description's; none: those
    std::vector<double> values;
    std::vector<uint64_t> changed;  // owner bits of the last evaluate
    bool first_frame = true;

    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<skin::Morph> morphs;
    std::vector<Shape> shapes;
    std::vector<Surface> surfaces;
    std::vector<LightSource> lights;
    MovingParts moving;  // known from the first frame on
    std::vector<CameraSource> cameras;
    std::vector<std::unique_ptr<ShaderInstance>> shader_instances;
    // Displacements and transformations.
    std::vector<std::unique_ptr<ShaderInstance>> vertex_instances;
    uint32_t camera = 0;          // into cameras
    uint32_t atmosphere = kNone;  // the volume outside all objects, into shader_instances
    uint32_t imager = kNone;      // what the finished picture is run through, into shader_instances
    std::vector<OutputPlane> outputs;
    // Interiors and exteriors, into shader_instances: ShaderInstance::volume is k + 1.
    std::vector<uint32_t> volumes;
    std::vector<std::string> added;  // "default camera", "default key light": what --list shows
    // Frames whose points are yet to be counted for LIGHTS_DARK: only its own lights shine.
    uint32_t watch_dark = 0;
    float world_light = 0;  // the brightness of the grey world that was added, which is no light

    double time = 0, shutter = 0;  // of the last evaluate, seconds

    DiceStats dice;
    std::vector<std::unique_ptr<WatchedEdges>> watched;  // by displaced mesh that was diced

    dvec3 origin{0.0};
    double size = 1;  // diagonal of the first frame's bounds
    dvec3 low{0.0}, high{0.0};

    std::vector<raytrace::Geometry> geometry;  // one row a surface
    raytrace::Accel accel;
    raytrace::Camera view;
    raytrace::IntegratorScratch scratch;
    std::shared_ptr<TextureStore> textures;  // what names in shaders stand for
    std::shared_ptr<PointStore> points;
    std::unique_ptr<Shading> shading;
    SceneOptions options;

    bool all_finite = true;  // the nodes' matrices, in this frame
    std::set<std::pair<uint32_t, raytrace::GeometryIssue>> told_issues;  // of rows
};

}  // namespace kinora
