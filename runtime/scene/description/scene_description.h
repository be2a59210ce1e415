// runtime/scene/description/scene_description.h: a scene as importers deliver it: definitions,
// values, channels.
//
// Every animatable number is a double in `values`; definitions own values, instances own matrices.
// Importers (import_collada, later import_gltf) fill this; build_scene makes a Scene of it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anim/animation.h"
#include "rsl/compile.h"
#include "runtime/base/allowed_paths.h"
#include "runtime/base/math.h"
#include "runtime/scene/description/environment.h"
#include "runtime/scene/description/file_picture.h"
#include "runtime/scene/description/memory_file.h"
#include "skin/morph.h"

namespace kinora {

inline constexpr uint32_t kNone = ~0u;

// A run of doubles in SceneDescription::values.
struct ValueSlot {
    uint32_t offset = kNone;
    uint32_t count = 0;
    bool present() const { return offset != kNone; }
    // Where component `c` of `needed` stands; one number may stand for all of them.
    uint32_t component(uint32_t needed, uint32_t c) const {
        return offset + (count == 1 && needed > 1 ? 0 : std::min(c, count - 1));
    }
};

// Whose numbers a channel writes; the bit that a change sets. Node bits are per definition.
enum class TransformKind : uint8_t { Translate, Rotate, Scale, Matrix, Lookat, Skew, Quaternion };

// Values as in COLLADA: Translate xyz; Rotate axis xyz + degrees; Scale xyz; Matrix 16 in document
// (row-major) order; Lookat eye, interest, up; Skew degrees, rotated axis, translated axis;
// Quaternion x y z w, of any length (glTF's rotation).
struct Transform {
    TransformKind kind;
    uint32_t value;  // offset into values
};

struct VertexBinding {
    std::string param;     // the shader parameter (or texcoord name of profile_COMMON)
    std::string semantic;  // "TEXCOORD"
    uint32_t set = kNone;  // kNone: the lowest
};

// A material as it is put on one primitive group of one instance.
struct MaterialUse {
    std::string symbol;
    uint32_t material = kNone;
    std::vector<VertexBinding> vertex_bindings;
    std::vector<std::pair<std::string, ValueSlot>> params;  // <bind semantic target>
};

// Whose rays meet a mesh.
struct Visibility {
    bool camera = true, reflections = true, diffuse = true, shadows = true;
    // The camera sees a hole in the picture: what is behind is hidden, and coverage is 0.
    bool matte = false;

    bool any() const { return camera || reflections || diffuse || shadows; }
    bool operator==(const Visibility&) const = default;
};

struct MeshUse {
    uint32_t mesh = kNone;
    uint32_t morph = kNone;
    uint32_t skin = kNone;
    std::vector<uint32_t> joint_nodes;  // node definitions, kNone where unresolved
    std::vector<MaterialUse> materials;
    // The light definitions that light it; nothing: all do.
    std::optional<std::vector<uint32_t>> lights;
    Visibility visibility;
    dmat4 conversion{1.0};  // from the mesh's document into the scene's units and axes
};

struct ChildUse {
    uint32_t node = kNone;
    dmat4 conversion{1.0};
};

// <extra><technique profile="RSL"><attribute name="user:tint">1 0.5 0</attribute>: what attribute()
// finds on the node and those below it.
struct UserAttribute {
    std::string name;
    std::vector<double> numbers;
    std::string text;  // where it is no numbers
};

struct NodeDefinition {
    std::string id, sid, name;
    std::vector<UserAttribute> attributes;
    std::vector<Transform> transforms;
    std::vector<ChildUse> children;  // own children and instance_node targets
    std::vector<MeshUse> meshes;
    std::vector<uint32_t> lights;
    std::vector<uint32_t> cameras;
    bool invisible = false;  // the file hides it and what is below
    bool hidden = false;     // --hide: nothing of it and below is there
    bool chosen = false;     // --only: its meshes and those below are there
    bool reference = false;  // stands for what brings in the light or camera of another file
    Location where;
};

// One attribute of a mesh with its own index per corner: NORMAL, TEXCOORD n, COLOR n.
struct VertexAttribute {
    std::string semantic;
    uint32_t set = 0;
    uint32_t stride = 0;            // floats an entry
    std::vector<float> values;      // stride x entries
    std::vector<uint32_t> corners;  // entry of each corner, 3 a triangle
    // Written by shaders in each frame: its number among Pose::vertex_outputs, where the values
    // are.
    uint32_t output = kNone;
};

// Vertex colours in linear light, beside COLOR of the same set as the file holds them.
inline constexpr const char* kLinearColor = "COLOR:linear";

// u and v of a surface that has parameters of its own; stride 2.
inline constexpr const char* kSurfaceParameters = "surface:uv";

// Triangles that wear one material.
struct PrimitiveGroup {
    std::string symbol;
    std::vector<uint32_t> triangles;  // position indices, 3 a triangle
    std::vector<VertexAttribute> attributes;
    bool one_sided = false;  // seen from its front alone, whatever its material says
};

struct MeshDefinition {
    std::string id, name;
    std::vector<dvec3> positions;
    std::vector<PrimitiveGroup> groups;
    bool double_sided = true;
    bool lasts = false;  // the film's next pictures may have it, too: its tree is kept
    Location where;
};

struct SkinDefinition {
    std::string id;
    dmat4 bind_shape{1.0};
    bool has_bind_shape = false;
    bool in_world = false;  // the node's matrix never applies (glTF); else COLLADA's rule decides
    std::vector<std::string> joint_names;
    std::vector<dmat4> inverse_bind;
    std::vector<uint32_t> offsets;
    std::vector<int32_t> joints;
    std::vector<float> weights;
    bool weights_told = false;  // the reader has said which of them are no sound weights
    Location where;
};

struct MorphDefinition {
    std::string id;
    bool relative = false;
    std::vector<uint32_t> targets;  // meshes
    ValueSlot weights;
    Location where;
    uint32_t base = kNone;  // the morph whose result it changes, of the same mesh
};

// What a shader parameter is given: numbers from a slot (animated or not), strings, or nothing
// (then the shader's own default holds, or a vertex input of that name).
struct ParamSource {
    std::string name;
    ValueSlot value;
    std::vector<std::string> strings;
    std::string texcoord;  // a texture parameter: the texcoord name it reads st by
    Location where;
    bool by_columns = false;  // a node's <matrix>, written for column vectors: RSL's are for rows
};

// A parameter, or Cs or Os, that has what a shader below in the stack left in one of its own.
struct LayerLink {
    std::string param;
    uint32_t below = 1;  // so many layers
    std::string variable;
};

struct ShaderUse {
    std::shared_ptr<const rsl::Shader> shader;
    std::vector<ParamSource> params;
    bool linear_inputs = false;  // reads kLinearColor in place of COLOR where there is one
    bool untinted = false;       // Cs is 1, whatever colours the mesh has
    std::string space = {};      // the id of the node whose space is "shader"; "": the object's
    std::vector<LayerLink> links = {};

    // What gives a parameter its value; null: no layer below does.
    const LayerLink* find_link(std::string_view param) const {
        for (const LayerLink& link : links)
            if (link.param == param) return &link;
        return nullptr;
    }
    // What a parameter is bound to; null: to nothing.
    const ParamSource* find(std::string_view name) const {
        for (const ParamSource& source : params)
            if (source.name == name) return &source;
        return nullptr;
    }
};

struct MaterialDefinition {
    std::string id, name;
    std::vector<ShaderUse> transformations;     // bottom first
    std::vector<ShaderUse> displacements;       // bottom first
    std::vector<ShaderUse> surfaces;            // bottom first
    std::vector<ShaderUse> interior, exterior;  // volumes, each on what the one before it left
    std::vector<ShaderUse> lights;              // make the geometry an area light
    uint32_t light_samples = 0;                 // 0: Quality::light_samples
    std::optional<bool> light_shadows;
    uint32_t light =
        kNone;  // the definition that MeshUse::lights name it by; kNone: it reaches all
    uint32_t atmosphere =
        kNone;  // of camera rays to it, into SceneDescription::atmospheres; kNone: the picture's
    bool hide_backfaces = false;
};

struct LightDefinition {
    std::string id, name;
    ShaderUse shader;
    std::optional<bool> shadows;  // profile RSL's <shadows>; nothing: automatic
    bool ambient = false;
    bool blender = false;        // Blender wrote it, without the grey world that it lights with too
    bool indirect = false;       // --gi's: not for surfaces that gather such light themselves
    bool surrounds = false;      // rays that leave the scene see what it sends
    bool behind_picture = true;  // of such a light: the camera's rays do, too
    bool blender_watts = false;  // one of COLLADA's that Blender wrote in watts
    uint32_t samples = 0;        // of a light on geometry; 0: not said
    Location where;
};

// What a visual scene or a camera runs on rays and on the picture; the camera's wins.
struct PictureShaders {
    std::vector<ShaderUse> atmosphere, imagers;  // each on what the one before it left
};

// A display colour that moves: the channels write it as the file has it, and what they wrote is
// decoded after. Offsets of three values each.
struct MovingColor {
    uint32_t display, linear;
};

inline constexpr size_t kMostClippingPlanes = 16;

struct CameraDefinition {
    std::string id, name;
    bool orthographic = false;
    bool clips = false;                   // what lies before znear or behind zfar is not seen
    ValueSlot x, y, aspect, znear, zfar;  // fov in degrees, or magnifications; absent = not given
    // Instead of x, y and aspect: what the picture spans, left, right, bottom and top, at z = 1 or,
    // orthographic, anywhere. Left above right, or bottom above top, is a mirrored picture.
    std::optional<std::array<double, 4>> window;
    // What lies before one of these planes is not seen: n . p + w > 0, in the scene's space.
    std::vector<dvec4> planes;
    PictureShaders picture;
    Location where;
};

struct ClipDefinition {
    std::string id, name;  // --clip takes both; without a name in the file both are the id
    double start = 0, end = 0;
    // What moves in the clip where that is not simply a range of the scene's animation.
    std::shared_ptr<const anim::Animation> animation = nullptr;
};

enum class UpAxis : uint8_t { X, Y, Z };

struct SceneDescription {
    std::string path;
    std::shared_ptr<const void> files;  // what paths name is there as long as this is held
    // Where shaders may read point files, and write them. Importers limit both to the scene's
    // folder and what the user allows.
    AllowedPaths readable, writable;
    double meter = 1;
    UpAxis up_axis = UpAxis::Y;
    std::vector<double> values;
    std::vector<NodeDefinition> nodes;
    std::vector<ChildUse> roots;
    bool only_chosen = false;      // --only: other meshes are not there
    uint32_t camera_node = kNone;  // the first camera at or below it is the default one
    std::vector<MeshDefinition> meshes;
    std::vector<SkinDefinition> skins;
    std::vector<MorphDefinition> morphs;
    std::vector<MaterialDefinition> materials;
    std::vector<std::vector<ShaderUse>> atmospheres;  // those that materials have of their own
    std::vector<LightDefinition> lights;
    std::vector<LightDefinition> default_lights;     // they replace runtime/scene/build/defaults.h
    std::vector<std::string> hidden_default_lights;  // names of those that are not added (--hide)
    std::vector<CameraDefinition> cameras;
    PictureShaders picture;
    std::optional<EnvironmentDefinition> environment;
    std::vector<ClipDefinition> clips;
    std::shared_ptr<const rsl::Shader> default_surface;  // of surfaces without material; null: ours
    bool tints = true;  // vertex colours tint our default surface (ImportOptions::vertex_colors)
    anim::Animation animation;
    std::vector<bool> animated;  // per value: some channel writes it, or it is decoded from such
    std::vector<MovingColor> moving_colors;
    std::optional<double> start_time, end_time, frame_rate;
    std::vector<std::string> inputs;  // read besides the texts in Diagnostics, for fingerprints
    std::vector<std::shared_ptr<const MemoryFile>> memory_files;  // images inside the scene's file
    AllowedPaths pictures;  // where textures and maps may lie: anywhere, unless they are confined
    // t of texture() is 0 at the top of a picture, as the RenderMan Interface has it; else at the
    // bottom, as COLLADA has it.
    bool textures_from_top = false;
    dmat4 world_space{1.0};  // from what shaders call "world"; formats may bring scenes turned
    std::optional<FilePicture> file_picture;
};

// Calls f(ShaderUse&) for every shader of the scene with its parameters.
template <class Description, class F>
void for_each_shader_use(Description& description, F&& f) {
    auto all = [&](auto&... lists) {
        auto one = [&](auto& list) {
            for (auto& use : list) f(use);
        };
        (one(lists), ...);
    };
    for (auto& m : description.materials) {
        all(m.transformations, m.displacements, m.surfaces, m.interior, m.exterior);
        all(m.lights);
    }
    for (auto& light : description.lights) f(light.shader);
    for (auto& atmosphere : description.atmospheres) all(atmosphere);
    all(description.picture.atmosphere, description.picture.imagers);
    for (auto& camera : description.cameras) all(camera.picture.atmosphere, camera.picture.imagers);
}

}  // namespace kinora
