// rsl/objects/light_samples.h: lights that are classes with sample methods.
#pragma once

#include <string_view>

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// The method of such a class that the renderer runs, a name that no source can have.
inline constexpr std::string_view kLightSamples = "light samples";

// Whether the class has that method, of the form (string what; output __radiancesample samples[]).
bool has_sample_method(const ClassDefinition& c, std::string_view method);

// A light with generateSamples() and evaluateSamples() gets a function of
// assets/shaders/include/lightsamples.h as its method kLightSamples. Works on the tree as it was
// parsed, before expand_objects(). Units: a shader and its co-shaders, if any.
void bind_light_samples(Ast& ast, std::span<Unit> units);

}  // namespace kinora::rsl
