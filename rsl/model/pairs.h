// rsl/model/pairs.h: the "name", value pairs that end calls and statements: which optional
// parameters there are, what they take, and which are variables that the renderer writes.
#pragma once

#include <string_view>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// Is args[value] of the call the variable of an output pair: texture3d(..., "channel", x)?
bool is_output_pair(const CallExpr& call, size_t value);

// gather(..., "surface:Ci", x, "ray:length", y): names with one of these prefixes are results.
bool is_gather_output(std::string_view name);

// illuminance(..., "light:falloff", x): a parameter of the light.
bool is_light_output(std::string_view name);

// What an optional parameter that Kinora knows takes: String or Float; Invalid where anything goes
// and for names it does not know.
BaseType option_type(std::string_view name);

// Does the built-in of that name, or gather, know this optional parameter (if only to pass it by)?
bool takes_option(std::string_view callee, std::string_view name);

// Is it known and without effect? `text`: its value where that is a constant string, else null.
bool is_idle_option(std::string_view callee, std::string_view name, const std::string* text);

// The literal that names the pair whose value is args[value]; "" if it is no literal.
std::string_view pair_name(std::span<Expr* const> args, size_t value);

}  // namespace kinora::rsl
