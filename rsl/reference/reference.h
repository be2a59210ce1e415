// rsl/reference/reference.h: defines the language by running it: an evaluator of the checked syntax
// tree, one shading point at a time, in plain C++ (docs/decisions.md#independent-oracles). As float
// it checks what lowering and the targets do; as double it measures their accuracy. It shares no
// code with lowering.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "rsl/model/layer.h"
#include "rsl/model/renderer_services.h"

namespace kinora::rsl {

// A light's answer at the point, as the columns and uniforms of a light record.
struct ReferenceLight {
    LightKind kind = kLightIlluminate;
    std::vector<std::string> categories;
    double nondiffuse = 0;
    double nonspecular = 0;
    std::array<double, 3> L{}, Cl{}, Ol{};
    bool lit = true;
    // What lightsource() finds: numbers by name; it asks for so many.
    std::vector<std::pair<std::string, std::vector<double>>> messages;
    int number = 0;                // for observers
    int which = 0;                 // kLightNumber
    bool sampled = false;          // kLightSampled
    double density = 0;            // kLightDensity
    std::array<double, 3> bare{};  // kLightBare
    // Whether it is of a category that illuminance names; else by `categories`.
    std::vector<std::pair<std::string, bool>> known_categories;
};

// A variable's numbers, all elements counted; strings as intern ids.
struct ReferenceVariable {
    std::string_view name;
    Type type;
    bool varying = false;  // as the checker found
    std::vector<double> values;
};

// What a statement has changed. The first of a shader has no changes but its parameters and the
// globals that it reads; a turn of illuminance has one for L, Cl and Ol.
struct ReferenceStep {
    const Shader* shader = nullptr;
    const Function* function = nullptr;  // null: the shader's body
    Location where;
    std::span<const int32_t> turns;         // of the loops around it
    const ReferenceLight* light = nullptr;  // inside illuminance
    std::vector<ReferenceVariable> changes;
};
using ReferenceObserver = std::function<void(const ReferenceStep&)>;

// What a renderer answers; the defaults are a world without textures and other objects. Arguments
// and results in the order of rsl/model/services.def; strings as intern ids.
using ReferenceService =
    std::function<std::vector<double>(Service service, std::span<const double> args)>;

using ReferenceLightsAt =
    std::function<std::span<const ReferenceLight>(std::array<double, 3> position)>;
using ReferenceLightsOf = std::function<std::span<const ReferenceLight>(double set)>;

// The point, by the names of kernel inputs ("P.x", "dPdu.x", "param:0:Kd", "space:world:to_current:
// 03"): what is missing is 0, a missing space is the identity.
struct ReferenceInputs {
    std::map<std::string, double> values;
    std::vector<ReferenceLight> lights;  // at any position asked for, but for `lights_at`
    // Those of illuminance() at a position in "current". Null: `lights`.
    const ReferenceLightsAt* lights_at = nullptr;
    // Those of a set that the service "samplinglights" gave. Null: none.
    const ReferenceLightsOf* lights_of = nullptr;
    ReferenceService service;
    // Coordinate systems beside the standard ones; any other name means "shader". Null: all exist.
    const std::vector<std::string>* spaces = nullptr;
    // Not 0: every sum, product and built-in's result that is no whole number is moved by up to
    // 2^-22 of itself, at random from this seed (Monte Carlo arithmetic): shows what rounding may
    // change.
    uint64_t jitter = 0;
    int loop_budget = 1'000'000;  // docs/numerics.md#loops
    // Statements run in all: loops inside recursion multiply. Beyond it the result is `too_long`.
    int64_t statement_budget = INT64_MAX;
    // Called after each statement that changes something, in the run in float alone.
    const ReferenceObserver* observer = nullptr;
};

struct ReferenceResult {
    std::map<std::string, double> values;  // by the names of kernel outputs; all that exist
    // A hash of the branches taken and of the whole numbers that floor, step and the like gave. Two
    // runs with different decisions (float and double near an edge) are not comparable.
    uint64_t decisions = 0;
    std::string missing;    // a built-in that was called and whose row has no reference; "" if none
    int faults = 0;         // loops ended by their budget, indices outside their arrays
    bool too_long = false;  // stopped at the statement budget: no value means anything
    Location nan;  // with an observer: the first operation or call that gave a NaN; no file: none
};

// Runs a stack of displacement and surface shaders, or one light; those that are done are passed
// over. Parameters come from their bindings, as in lower().
template <class Real>
ReferenceResult run_reference(std::span<const Layer> layers, const ReferenceInputs& inputs);

// The value of an expression that names nothing but PI and calls pure built-ins only. Nothing where
// a built-in has no reference meaning.
std::optional<ConstantValue> evaluate_constant(const Expr& expr);

}  // namespace kinora::rsl
