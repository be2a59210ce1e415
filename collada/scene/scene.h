// collada/scene/scene.h: what <scene> reaches, as plain structs with their numbers parsed.
//
// Indices name entries of SceneData's lists; kNone is "none". All indices are valid: whatever the
// file got wrong was reported and left out. Angles are degrees, as in the file. Spaces and units
// are the file's own. Matrices are column-major (m[c][r]) unless a comment says otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collada/document/document.h"
#include "collada/scene/effects.h"
#include "collada/scene/meshes.h"
#include "collada/scene/values.h"
#include "runtime/base/diagnostic.h"
#include "runtime/base/math.h"

namespace kinora::collada {

enum class UpAxis : uint8_t { X, Y, Z };

struct Asset {
    Version version = Version::V1_4_1;
    double meter = 1.0;  // metres per unit
    std::string unit_name;
    UpAxis up_axis = UpAxis::Y;
};

// --- nodes ---------------------------------------------------------------------------------------

enum class TransformKind : uint8_t { Translate, Rotate, Scale, Matrix, Lookat, Skew };

// Values: Translate x y z; Rotate x y z angle; Scale x y z; Matrix 16, column-major; Lookat
// eye(3) interest(3) up(3); Skew angle, rotated axis(3), translated axis(3).
struct Transform {
    TransformKind kind = TransformKind::Translate;
    Slot slot;
};

// <bind semantic target>: the shader parameter and the slot it reads.
struct ParamBinding {
    std::string semantic;
    std::string target;  // as written
    TargetRef ref;       // Owner::None never occurs: an unresolved one is left out
    Location where;
};

struct VertexInputBinding {
    std::string semantic;        // the name the material uses: "UVSET0", "CHANNEL1"
    std::string input_semantic;  // "TEXCOORD", "COLOR"
    uint32_t input_set = kNone;  // kNone: not given, match the lowest set
    Location where;
};

struct MaterialBinding {
    std::string symbol;
    uint32_t material = kNone;
    std::vector<VertexInputBinding> vertex_inputs;
    std::vector<ParamBinding> params;
    Location where;
};

// <instance_geometry> and <instance_controller> alike: a mesh, perhaps morphed, perhaps skinned.
struct MeshInstance {
    uint32_t geometry = kNone;             // the base mesh
    uint32_t morph = kNone;                // index into morphs: applied first
    uint32_t skin = kNone;                 // index into skins: applied second
    std::vector<uint32_t> joint_nodes;     // per joint of the skin: a node definition, or kNone
    std::vector<uint32_t> skeleton_roots;  // node definitions of <skeleton>, in order
    std::vector<MaterialBinding> materials;
    uint32_t conversion = kNone;  // index into SceneData::conversions: apply to the mesh first
    // <extra><technique profile="RSL"><lights>: those that light it, sorted; nothing: all do.
    std::optional<std::vector<uint32_t>> lights;
    Location where;
};

struct LightInstance {
    uint32_t light = kNone;
    uint32_t conversion = kNone;
    Location where;
};

struct CameraInstance {
    uint32_t camera = kNone;
    uint32_t conversion = kNone;
    Location where;
};

struct NodeInstance {
    uint32_t node = kNone;
    uint32_t conversion = kNone;
    Location where;
};

// A node definition. It may occur several times in the tree (instance_node); the tree has no
// cycles and unrolls to at most ExtractOptions::max_node_instances nodes.
struct Node {
    std::string id, sid, name;
    bool joint = false;
    bool hidden = false;                // by an extra: nothing of it and below is shown
    std::vector<Transform> transforms;  // in order: the node's matrix is their product
    std::vector<CameraInstance> cameras;
    std::vector<MeshInstance> meshes;  // in document order
    std::vector<LightInstance> lights;
    std::vector<NodeInstance> instances;
    std::vector<uint32_t> children;
    uint32_t parent = kNone;  // the node it is written in
    // Index into SceneData::conversions: of its own <asset>, into that of the node it is written in
    // (else the root document's). An instance has its own instead.
    uint32_t conversion = kNone;
    uint32_t document = 0;  // index into SceneData::documents
    Location where;
    // <extra><technique profile="RSL"><attribute name="user:x">text</attribute>: what shaders ask
    // the geometry for.
    std::vector<std::pair<std::string, std::string>> attributes;
};

// --- animation -----------------------------------------------------------------------------------

enum class Interpolation : uint8_t { Linear, Step, Bezier, Hermite, Cardinal, Bspline };
enum class Behavior : uint8_t { Undefined, Constant, Gradient, Cycle, Oscillate, CycleRelative };

// Keys have finite numbers and ascending times (equal ones stay). Tangents: 1-D are values relative
// to the key, 2-D are absolute (time, value) points; layout [key][component][dims]. Samplers of
// whole matrices have their values and tangents in column-major order.
struct Sampler {
    std::string id;
    std::vector<double> times;
    std::vector<double> values;  // stride * keys
    uint32_t stride = 1;
    std::vector<Interpolation> interpolation;       // one per key; segment k uses entry k
    std::vector<double> in_tangents, out_tangents;  // both empty, or keys * stride * tangent_dims
    uint8_t tangent_dims = 0;                       // 0, 1 or 2
    Behavior pre = Behavior::Undefined, post = Behavior::Undefined;
    Location where;
};

// sampler.stride == ref.count, always.
struct Channel {
    std::string target;  // as written
    uint32_t sampler = 0;
    TargetRef ref;         // never Owner::None
    bool in_clip = false;  // some clip instantiates its animation
    Location where;
};

struct Clip {
    std::string id, name;
    double start = 0, end = 0;       // seconds
    std::vector<uint32_t> channels;  // those of the animations it instantiates
    Location where;
};

// --- cameras and lights --------------------------------------------------------------------------

enum class CameraSlot : uint8_t { Xfov, Yfov, Xmag, Ymag, AspectRatio, Znear, Zfar, Count };

struct Camera {
    std::string id, name;
    bool orthographic = false;
    std::array<Slot, size_t(CameraSlot::Count)> slots;  // absent ones have count 0
    std::vector<uint32_t> rsl_materials;                // <extra> RSL effects (IMAGER, VOLUME)
    Location where;
    const Slot& operator[](CameraSlot s) const { return slots[size_t(s)]; }
};

enum class LightKind : uint8_t { Ambient, Directional, Point, Spot };
enum class LightSlot : uint8_t {
    Color,  // 3
    ConstantAttenuation,
    LinearAttenuation,
    QuadraticAttenuation,
    FalloffAngle,  // degrees, the whole cone
    FalloffExponent,
    Count
};

struct Light {
    std::string id, name;
    LightKind kind = LightKind::Ambient;
    std::array<Slot, size_t(LightSlot::Count)> slots;  // always filled (defaults 1,1,1 1 0 0 180 0)
    uint32_t rsl_material = kNone;  // <extra><technique profile="RSL">: shades instead of `kind`
    std::optional<bool> shadows;    // <shadows> of that extra
    bool blender = false;           // Blender wrote it
    bool blender_watts = false;     // in watts
    Location where;
    const Slot& operator[](LightSlot s) const { return slots[size_t(s)]; }
};

// --- the whole -----------------------------------------------------------------------------------

// What lies around the visual scene: a picture of latitudes and longitudes times a color.
struct Environment {
    uint32_t image = kNone;  // kNone: the color alone
    std::array<double, 3> color = {1, 1, 1};
    double rotation = 0;  // degrees about the up axis, counterclockwise as seen from above
    double brightness = 1;
    bool hidden = false;  // behind the picture
    Location where;
};

struct SourceDocument {
    std::string path;
    Asset asset;
    FileId file = kNoFile;
};

struct SceneData {
    Asset asset;
    std::vector<SourceDocument> documents;  // [0] is the root; others by external references
    std::string scene_id, scene_name;
    std::vector<uint32_t> roots;                     // nodes of the visual scene
    std::vector<uint32_t> rsl_materials;             // the visual scene's <extra> RSL effects
    std::optional<Environment> environment;          // of its <extra>
    uint32_t camera_node = kNone;                    // of <evaluate_scene><render camera_node>
    std::vector<std::shared_ptr<const void>> files;  // embedded images live as long as these

    std::vector<Node> nodes;
    std::vector<Geometry> geometries;
    std::vector<Skin> skins;
    std::vector<Morph> morphs;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<Effect> effects;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
    std::vector<Clip> clips;
    std::vector<dmat4> conversions;  // from the units and axes of a definition into its user's

    // From MAYA/MAX3D/FCOLLADA/Blender extras of scene and document, seconds.
    std::optional<double> start_time, end_time, frame_rate;
};

}  // namespace kinora::collada
