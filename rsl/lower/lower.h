// rsl/lower/lower.h: a checked shader (or a stack of them) to one module of jit IR.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "jit/ir/ir.h"
#include "jit/math/math.h"
#include "rsl/model/layer.h"
#include "rsl/model/renderer_services.h"

namespace kinora::rsl {

struct LowerOptions {
    jit::math::Tier math = jit::math::Tier::Precise;
    bool want_Ci = true;  // colour
    bool want_Oi = true;  // opacity; with want_Ci false this is the opacity-only kernel, in which
                          // lights are unshadowed and trace and gather give 0
    // A kernel that moves vertices: "current" is the object's space, and "camera" another.
    bool of_vertices = false;
    bool area_light = false;  // a light on geometry: its P, N, u, v, s, t are those of a sample
    bool want_N = false;      // the shading normal as the shaders leave it
    bool want_P = false;
    // Where a surface's Oi is 0 in all channels, a Ci that is multiplied by it is +0 (never NaN),
    // and what only that Ci needs is not run.
    bool skip_transparent = false;
    // Classes: where opacity() leaves no channel above it, the point is a hole, and the rest is not
    // run.
    float opacity_threshold = 0;
    // Points are numbers of no mesh: a class's displacement() moves P, and nothing moves it back.
    bool moves_points = false;
    // Iterations per entry of a loop: Module::loop_budget, which no array of the module is longer
    // than.
    int32_t loop_budget = 1'000'000;
    std::vector<std::string> aovs;      // names of output parameters wanted
    std::vector<std::string> messages;  // light shaders: parameters that some lightsource() reads
    // Known coordinate systems besides the standard ones: what else is named means "shader". Null:
    // any name is taken.
    const std::vector<std::string>* spaces = nullptr;
};

// One illuminate or solar statement of a light shader, or the whole shader if it has none.
struct LightStatement {
    LightKind kind = kLightAmbient;
    bool casts_shadow = true;  // false: the shader itself calls shadow, transmission or trace
    bool sampled = false;      // no outputs: it sends samples (the service "lightsample")
};

// The lights at P that a kernel's loops look at: those within 90 degrees of ... (bits).
enum LitSide : uint8_t {
    kLitAround = 1,       // anything else: some loop sees all lights
    kLitN = 2,            // N
    kLitBehindN = 4,      // -N
    kLitFacing = 8,       // faceforward(N, I), which goes by Ng
    kLitAverted = 16,     // its opposite
    kLitFacingByN = 32,   // faceforward(N, I, N)
    kLitAvertedByN = 64,  // its opposite
};

struct LoweredShader {
    jit::Module module;
    std::vector<LightStatement> light_statements;  // light shaders; outputs light:k:*
    std::vector<std::string> categories;  // category strings of illuminance, for kLightCategories
    // Which lights its loops look at: bits of `categories` that some loop asks to be set, or not
    // to be; all lights with a direction; ambient ones. Others' kernels need not run.
    uint32_t lit_categories = 0, lit_without = 0;
    bool lit_by_all = false, lit_by_ambient = false;
    bool lit_by_samples = false;  // some integrator asks lights for what they send from directions
    bool reads_bare_light = false;        // kLightBare
    bool tells_lights_apart = false;      // kLightNumber or kLightHandle
    std::string light_domain = "sphere";  // the directions that lights with sample methods are for
    std::vector<std::string> light_messages;  // names read by lightsource(), columns in this order
    std::vector<int> light_message_components;
    std::vector<Type> light_message_types;  // an array's elements follow one another
    // What the gather statements want of each ray, by the number that service "gather" gets.
    struct GatherResult {
        std::string name;  // "surface:Ci"
        BaseType type = BaseType::Float;
        int32_t variable = 0;  // "surface:NAME": the name_id() of the hit shader's output
    };
    std::vector<std::vector<GatherResult>> gathers;
    bool uses_lights = false;  // reads record set 0
    uint8_t lit_sides = 0;     // LitSide of all its loops that see lights with a direction
    bool uses_rng = false;
    bool draws_random = false;  // random() itself
    // Displacements and transformations: whether P, N as they leave them can differ from the input.
    bool moves_P = false, bends_N = false;
    // Oi's class (docs/decisions.md#opacity), judged from the IR: 1 always, constant, or computed
    // per point.
    enum class Opacity { Opaque, Constant, Computed } opacity = Opacity::Opaque;
};

// Lowers a stack of displacement and surface layers, or one light (or other) shader. Errors of use
// (an array over 1 MiB, a construct not yet compiled) are findings at their location in the shader
// source; the result is then empty.
std::optional<LoweredShader> lower(std::span<const Layer> layers, const LowerOptions& options,
                                   Diagnostics& diagnostics);

// Output parameters that gather statements of the shader read of what they hit ("surface:NAME"),
// each once: those shaders must have them among LowerOptions::aovs. "N" stands for want_N.
std::vector<std::string> gathered_parameters(const Shader& shader);

// Splits which of a shader's parameters decide the kernel's shape: true where the parameter's value
// reaches a condition, a loop bound, an array size or a string use, so that it must be Constant.
std::vector<bool> shape_parameters(const Shader& shader);

}  // namespace kinora::rsl
