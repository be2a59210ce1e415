// rsl/model/pairs.h: the "name", value pairs that end calls and statements: which optional
// parameters there are, what they take, and which are variables that the renderer writes.
#pragma once

#include <span>
#include <string_view>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// A row: one optional parameter. texture3d and bake3d take any other name as that of a channel.
struct OptionalParameter {
    std::string_view name;
    BaseType type;            // what its value must be, whoever is called; Invalid: anything
    std::string_view takers;  // built-ins, and gather, that it is no news to, separated by spaces
    bool result = false;      // its value is a variable that the call sets
    // It is known and changes nothing, which is no news where its value is one of these words (what
    // is done anyway); null: it does what it should; kHint: it changes nothing, and that is no
    // news.
    const char* idle = nullptr;
};

// What the renderer does anyway, or asks for a method that it has no need of.
inline constexpr char kHint[] = "*";

std::span<const OptionalParameter> optional_parameters();  // for the manual

// Is the built-in of that name, or gather, among the row's takers?
bool is_taker(const OptionalParameter& option, std::string_view callee);

// Is args[value] of the call the variable of an output pair: texture3d(..., "channel", x)?
bool is_output_pair(const CallExpr& call, size_t value);

// The points of "source", p1, p2, p3, p4, which the checker has put into one array; none without.
std::span<Expr* const> source_corners(const CallExpr& call);

// gather(..., "surface:Ci", x, "ray:length", y): names with one of these prefixes are results.
bool is_gather_output(std::string_view name);

// illuminance(..., "light:falloff", x): a parameter of the light.
bool is_light_output(std::string_view name);

// illuminance(..., "recordset", samplinglights(..)): of our own headers.
inline constexpr std::string_view kRecordSetPair = "recordset";

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
