// rsl/lower.h: a checked shader (or a stack of them) to one module of jit IR.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jit/ir.h"
#include "jit/math.h"
#include "rsl/renderer_services.h"
#include "rsl/shader.h"

namespace kinora::rsl {

// A function that calls itself (EXTREMES.md row 74): so many activations at once, and so many calls
// below the first one, that it cannot hang. Beyond that: a fault, and 0.
inline constexpr int kMaxCallDepth = 64;
inline constexpr int kMaxRecursiveCalls = 1'000'000;

// How a shader parameter reaches the kernel (DESIGN.md decision 4): specialised on shape only.
struct ParamBinding {
    enum class Kind {
        Frame,     // read from the frame block (default)
        Constant,  // a string, or a float that is exactly 0 or 1 and not animated, or one that
                   // reaches a condition or loop bound: folded into the code
        Varying,   // bound to a vertex input: a point-rate input
        Default    // not bound: the shader's own default expression, lowered
    };
    std::string name;
    Kind kind = Kind::Default;
    std::vector<float> constant;       // components (all elements of an array)
    std::vector<std::string> strings;  // for string parameters
    bool plain = false;                // Varying: what a displacement left, numbers of no space
};

// One shader of a stack: displacements first (bottom first), then surfaces (bottom first).
struct Layer {
    const Shader* shader = nullptr;
    std::vector<ParamBinding> params;
    // The shader has run already, on the mesh's vertices: only its parameters are known here, for
    // displacement(); those it wrote come as Varying bindings.
    bool done = false;
};

struct LowerOptions {
    jit::math::Tier math = jit::math::Tier::Precise;
    bool want_Ci = true;  // colour
    bool want_Oi = true;  // opacity; with want_Ci false this is the opacity-only kernel, in which
                          // lights are unshadowed and trace and gather give 0 (decision 6)
    // A kernel that moves vertices: "current" is the object's space, and "camera" another.
    bool of_vertices = false;
    bool area_light = false;  // a light on geometry: its P, N, u, v, s, t are those of a sample
    bool want_N = false;      // the shading normal as the shaders leave it
    bool want_P = false;
    std::vector<std::string> aovs;      // names of output parameters wanted
    std::vector<std::string> messages;  // light shaders: parameters that some lightsource() reads
    // Known coordinate systems besides the standard ones; null: any name is taken.
    const std::vector<std::string>* spaces = nullptr;
};

// One illuminate or solar statement of a light shader, or the whole shader if it has none.
struct LightStatement {
    LightKind kind = kLightAmbient;
    bool casts_shadow = true;  // false: the shader itself calls shadow, transmission or trace
};

struct LoweredShader {
    jit::Module module;
    std::vector<LightStatement> light_statements;  // light shaders; outputs light:k:*
    std::vector<std::string> categories;  // category strings of illuminance, for kLightCategories
    std::vector<std::string> light_messages;  // names read by lightsource(), columns in this order
    std::vector<int> light_message_components;
    std::vector<Type> light_message_types;  // an array's elements follow one another
    // What the gather statements want of each ray, by the number that service "gather" gets.
    struct GatherResult {
        std::string name;  // "surface:Ci"
        BaseType type = BaseType::Float;
    };
    std::vector<std::vector<GatherResult>> gathers;
    bool uses_lights = false;  // reads record set 0
    bool uses_rng = false;
    // Displacements and transformations: whether P, N as they leave them can differ from the input.
    bool moves_P = false, bends_N = false;
    // Oi's class (decision 6), judged from the IR: 1 always, constant, or computed per point.
    enum class Opacity { Opaque, Constant, Computed } opacity = Opacity::Opaque;
};

// Lowers a stack of displacement and surface layers, or one light (or other) shader. Errors of use
// (an unknown constant space name, an array over 1 MiB, a construct not yet compiled) are findings
// at their place in the shader source; the result is then empty.
std::optional<LoweredShader> lower(std::span<const Layer> layers, const LowerOptions& options,
                                   Diagnostics& diagnostics);

// Output parameters that gather statements of the shader read of what they hit ("surface:NAME"),
// each once: those shaders must have them among LowerOptions::aovs. "N" stands for want_N.
std::vector<std::string> gathered_parameters(const Shader& shader);

// Splits which of a shader's parameters decide the kernel's shape: true where the parameter's value
// reaches a condition, a loop bound, an array size or a string use, so that it must be Constant.
std::vector<bool> shape_parameters(const Shader& shader);

}  // namespace kinora::rsl
