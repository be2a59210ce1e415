// collada/scene/effects.h: effects (profile_RSL, profile_COMMON), materials and images.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collada/scene/values.h"

namespace kinora::collada {

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
bool find_param_type(std::string_view name, ParamType& type);  // false: no such type

// Numbers in the order of the file (matrices too). A colour has 3: docs/format.md#profile_rsl.
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
    std::string path;  // the file found; "" if none (FILE_MISSING was reported)
    Location where;
};

enum class Wrap : uint8_t { Wrap, Mirror, Clamp, Border, None };
enum class Filter : uint8_t { None, Nearest, Linear };

struct TextureSampler {
    std::string sid;
    uint32_t image = kNone;
    Wrap wrap_s = Wrap::Wrap, wrap_t = Wrap::Wrap;
    // mip: between the levels of a pyramid; None is the finest alone, 1.4's LINEAR and NEAREST.
    Filter min = Filter::Linear, mag = Filter::Linear, mip = Filter::Linear;
    float mip_bias = 0;         // added to the level
    uint8_t mip_max_level = 0;  // the coarsest used; 0 is all
    std::string surface;        // sid of the <surface> it looks through; "" for none
    vec4 border_color{0, 0, 0, 0};
    // uv' = turned(uv) * repeat + offset, from MAYA/MAX3D/OKINO extras; turned anticlockwise about
    // (1/2, 1/2) by degrees.
    vec2 repeat{1, 1}, offset{0, 0};
    double turn_degrees = 0;
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
    bool bump_is_normals = false;  // the Bump slot holds normals, not heights
    double bump_amount = 1;
    bool emission_is_factor = false;  // of the diffuse color: Blender's "emit", before 2.80
    Location where;
    const CommonValue& operator[](CommonSlot s) const { return slots[size_t(s)]; }
};

enum class RslStage : uint8_t {
    Surface,
    Displacement,
    Light,
    Volume,
    Transformation,
    Imager,
    CoShader
};

struct RslCode {
    std::string text;
    SourceMap map;     // text offset -> location in the .dae or the .sl
    std::string path;  // of the included file; the document's for <code>
    bool included = false;
};

struct RslBind {
    std::string symbol;
    uint32_t param = kNone;  // index into Effect::params; kNone: `literal`
    ParamValue literal;
    Location where;
};

struct RslShader {
    RslStage stage = RslStage::Surface;
    std::string name;    // the function to run; "" when not written: the code's only shader
    std::string handle;  // of a CoShader: what others find it by
    std::vector<RslBind> binds;
    uint32_t pass = 0;  // CoShaders are for the shaders of their pass
    Location where;
    Location handle_where;
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
    std::vector<std::pair<uint32_t, TextureSampler>>
        samplers;                 // in place of effect.samplers[first]
    uint32_t samples = 0;         // <extra> RSL <samples> of an area light; 0 if silent
    std::optional<bool> shadows;  // and its <shadows>
    std::string volume_target;    // <extra> RSL "interior", "exterior", both in order; "" if silent
    bool invisible = false;       // profile_COMMON's formula gives opacity 0 everywhere, always
    bool reversed = false;  // as most of its file are invisible: opacity is 1 less the formula's
    Location where;
};

}  // namespace kinora::collada
