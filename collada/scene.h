// collada/scene.h: what <scene> reaches, as plain structs with their numbers parsed.
//
// Indices name entries of SceneData's lists; kNone is "none". All indices are valid: whatever the
// file got wrong was reported and left out. Angles are degrees, as in the file. Spaces and units
// are the file's own. Matrices are column-major (m[c][r]) unless a comment says otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "collada/document.h"
#include "runtime/base/diagnostic.h"
#include "runtime/base/math.h"

namespace kinora::collada {

inline constexpr uint32_t kNone = ~0u;

enum class UpAxis : uint8_t { X, Y, Z };

struct Asset {
    Version version = Version::V1_4_1;
    double meter = 1.0;  // metres per unit
    std::string unit_name;
    UpAxis up_axis = UpAxis::Y;
};

// Up to 16 numbers that a channel can write.
struct Slot {
    std::array<double, 16> values{};
    uint8_t count = 0;  // 0: absent from the file (values then hold the format's default, if any)
    std::string sid;
    Location where;
    bool present() const { return count > 0; }
};

// --- what a channel or a <bind target> names ----------------------------------------------------

enum class Owner : uint8_t {
    None,
    Transform,      // nodes[owner].transforms[slot]
    Light,          // lights[owner].slots[slot]      (slot = LightSlot)
    Camera,         // cameras[owner].slots[slot]     (slot = CameraSlot)
    EffectParam,    // effects[owner].params[slot].value
    EffectCommon,   // effects[owner].common.slots[slot]  (slot = CommonSlot)
    MaterialParam,  // materials[owner].setparams[slot].value
    MorphWeight,    // morphs[owner].weights, the whole list; component = weight index
};

struct TargetRef {
    Owner kind = Owner::None;
    uint32_t owner = kNone;
    uint32_t slot = 0;
    uint32_t first = 0;         // first component of the slot's values that is written
    uint32_t count = 0;         // how many in a row
    bool whole_matrix = false;  // all 16 of a <matrix>: decomposed when LINEAR
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

// A node definition. It may occur at several places of the tree (instance_node); the tree has no
// cycles and unrolls to at most ExtractOptions::max_node_instances nodes.
struct Node {
    std::string id, sid, name;
    bool joint = false;
    std::vector<Transform> transforms;  // in order: the node's matrix is their product
    std::vector<CameraInstance> cameras;
    std::vector<MeshInstance> meshes;  // in document order
    std::vector<LightInstance> lights;
    std::vector<NodeInstance> instances;
    std::vector<uint32_t> children;
    uint32_t parent = kNone;  // the node it is written in
    uint32_t document = 0;    // index into SceneData::documents
    Location where;
};

// --- geometries ----------------------------------------------------------------------------------

// Values of a <source>, without the unnamed params of its accessor. No NaN or infinity.
struct FloatSource {
    std::string id;
    uint32_t stride = 0;        // floats per entry: 2 or 3 for TEXCOORD, 3 or 4 for COLOR, ...
    std::vector<float> values;  // stride * entries
};

struct VertexInput {
    std::string semantic;  // NORMAL TEXCOORD COLOR TANGENT TEXTANGENT TEXBINORMAL UV or a user's
    uint32_t set = 0;      // 0 when not written
    uint32_t source = 0;   // index into Geometry::sources
    uint32_t list = 0;     // index into PrimitiveGroup::indices
};

// The triangles of one <triangles>, <polylist>, ... element: corner 3t+k is corner k of triangle t.
struct PrimitiveGroup {
    std::string material;                        // symbol, "" if none
    std::vector<VertexInput> inputs;             // all but POSITION
    std::vector<std::vector<uint32_t>> indices;  // [0]: positions; one list per distinct offset
    uint32_t triangle_count() const { return uint32_t(indices[0].size() / 3); }
    Location where;
};

// A mesh, triangulated. Position i is the one that skins and morph targets speak of.
struct Geometry {
    std::string id, name;
    std::vector<dvec3> positions;
    std::vector<FloatSource> sources;
    std::vector<PrimitiveGroup> groups;  // every one has indices[0] and at least one triangle
    bool double_sided = true;            // from <extra>; false hides back faces from camera rays
    uint32_t line_count = 0;             // <lines>/<linestrips> segments read and not shaded
    Location where;
};

// --- controllers ---------------------------------------------------------------------------------

enum class JointNames : uint8_t { Name, Idref, Sidref };

// Vertex i has influences [offsets[i], offsets[i+1]). Weights are as written (sums are not
// normalised; NaN became 0). joint -1 is the bind shape itself.
struct Skin {
    std::string id;
    uint32_t geometry = kNone;
    uint32_t morph = kNone;  // the skin's source is this morph (over `geometry`)
    bool has_bind_shape_matrix = false;
    dmat4 bind_shape_matrix{1.0};
    JointNames joint_kind = JointNames::Name;
    std::vector<std::string> joints;
    std::vector<dmat4> inverse_bind;  // one per joint
    std::vector<uint32_t> offsets;    // geometry positions + 1
    std::vector<int32_t> influence_joints;
    std::vector<float> influence_weights;
    Location where;
};

enum class MorphMethod : uint8_t { Normalized, Relative };

// Targets have as many positions as the base. Normals of a target are in its own sources/groups.
struct Morph {
    std::string id;
    uint32_t geometry = kNone;  // the base mesh
    MorphMethod method = MorphMethod::Normalized;
    std::vector<uint32_t> targets;  // geometries
    std::vector<double> weights;    // one per target: base values that channels write
    Location where;
    Location weights_where;
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
    Location where;
    const Slot& operator[](LightSlot s) const { return slots[size_t(s)]; }
};

// --- effects, materials, images ------------------------------------------------------------------

enum class ParamType : uint8_t {
    Float,
    Float2,
    Float3,
    Float4,
    Float4x4,
    Int,
    Bool,
    Point,
    Color,
    Vector,
    Normal,
    Matrix,
    String,
    Count
};
uint32_t component_count(ParamType type);  // 1 2 3 4 16 1 1 3 3 3 3 16; String 1
const char* param_type_name(ParamType type);

// Numbers in the order of the file (matrices too). A colour has 3: see DESIGN section 5.
struct ParamValue {
    ParamType type = ParamType::Float;
    uint32_t array_length = 0;  // 0: no array
    std::vector<double> numbers;
    std::vector<std::string> strings;
    uint32_t image = kNone;  // String only: it names this image's id
    Location where;
};

enum class ParamScope : uint8_t { Effect, ProfileCommon, ProfileRsl, Technique };

struct Param {
    std::string sid;
    std::string semantic;
    ParamScope scope = ParamScope::Effect;
    ParamValue value;
    Location where;
};

struct Image {
    std::string id, name;
    std::string uri;   // as written
    std::string path;  // the file found; "" if none (IMAGE_MISSING was reported)
    Location where;
};

enum class Wrap : uint8_t { Wrap, Mirror, Clamp, Border, None };
enum class Filter : uint8_t { None, Nearest, Linear };

struct TextureSampler {
    std::string sid;
    uint32_t image = kNone;
    Wrap wrap_s = Wrap::Wrap, wrap_t = Wrap::Wrap;
    Filter min = Filter::Linear, mag = Filter::Linear, mip = Filter::Linear;
    vec4 border_color{0, 0, 0, 0};
    // uv' = uv * repeat + offset, from MAYA/MAX3D/OKINO extras.
    vec2 repeat{1, 1}, offset{0, 0};
    Location where;
};

enum class CommonModel : uint8_t { Constant, Lambert, Phong, Blinn };
enum class CommonSlot : uint8_t {
    Emission,
    Ambient,
    Diffuse,
    Specular,
    Shininess,
    Reflective,
    Reflectivity,
    Transparent,
    Transparency,
    IndexOfRefraction,
    Bump,
    Count
};
enum class SlotSource : uint8_t { Absent, Value, Param, Texture };
enum class Opaque : uint8_t { AOne, RgbZero, AZero, RgbOne };

struct CommonValue {
    SlotSource source = SlotSource::Absent;
    Slot slot;                 // Value: 4 (colour) or 1 (float) numbers
    uint32_t param = kNone;    // Param: index into Effect::params
    uint32_t sampler = kNone;  // Texture: index into Effect::samplers
    std::string texcoord;      // Texture: the name bind_vertex_input speaks of, "" if none
    Location where;
};

struct CommonShading {
    std::string technique_sid;
    CommonModel model = CommonModel::Constant;
    std::array<CommonValue, size_t(CommonSlot::Count)> slots;
    Opaque opaque = Opaque::AOne;  // of <transparent>
    bool double_sided = true;
    Location where;
    const CommonValue& operator[](CommonSlot s) const { return slots[size_t(s)]; }
};

enum class RslStage : uint8_t { Surface, Displacement, Light, Volume, Transformation, Imager };

struct RslCode {
    std::string text;
    SourceMap map;     // text offset -> place in the .dae or the .sl
    std::string path;  // of the included file; the document's for <code>
};

struct RslBind {
    std::string symbol;
    uint32_t param = kNone;  // index into Effect::params; kNone: `literal`
    ParamValue literal;
    Location where;
};

struct RslShader {
    RslStage stage = RslStage::Surface;
    std::string name;  // the function to run; "" when not written: the code's only shader
    std::vector<RslBind> binds;
    uint32_t pass = 0;
    Location where;
};

struct RslShading {
    std::string technique_sid;
    std::vector<RslCode> codes;      // one translation unit: in order
    std::vector<RslShader> shaders;  // in document order
    Location where;
};

struct Effect {
    std::string id, name;
    std::vector<Param> params;  // all scopes; a sid is looked up innermost first
    std::vector<TextureSampler> samplers;
    std::optional<CommonShading> common;
    std::optional<RslShading> rsl;  // wins over common
    uint32_t document = 0;
    Location where;
};

struct SetParam {
    std::string ref;
    uint32_t param = kNone;  // index into the effect's params; kNone: the effect has no such one
    ParamValue value;
    Location where;
};

// A material, or an <instance_effect> inside an RSL <extra> (id "" then).
struct Material {
    std::string id, name;
    uint32_t effect = kNone;  // kNone: unresolved, reported; use the default material
    std::vector<SetParam> setparams;
    std::string volume_target;  // <extra> RSL "interior" or "exterior"; "" if silent
    Location where;
};

// --- the whole -----------------------------------------------------------------------------------

struct SourceDocument {
    std::string path;
    Asset asset;
    FileId file = kNoFile;
};

struct SceneData {
    Asset asset;
    std::vector<SourceDocument> documents;  // [0] is the root; others by external references
    std::string scene_id, scene_name;
    std::vector<uint32_t> roots;          // nodes of the visual scene
    std::vector<uint32_t> rsl_materials;  // the visual scene's <extra> RSL effects

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
    std::vector<dmat4> conversions;  // from an external document's units and axes into the root's

    // From MAYA/MAX3D/FCOLLADA/Blender extras of scene and document, seconds.
    std::optional<double> start_time, end_time, frame_rate;
};

struct ExtractOptions {
    bool allow_external = false;  // read files outside the scene's own folder tree
    uint32_t max_documents = 256;
    uint64_t max_node_instances = 1'000'000;  // nodes after unrolling instance_node
};

// Makes the structs of what <scene> reaches, in one pass over what it needs. Findings go to
// `diag`; nothing is returned when there is nothing to show (no visual scene at all).
// Calls check_elements on every document it reads.
std::optional<SceneData> extract(const Document& document, Diagnostics& diag,
                                 const ExtractOptions& options = {});

}  // namespace kinora::collada
