// rsl/objects/units.h: the shaders that become one: the shader itself and its co-shaders.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// What another shader can call, as it is written.
struct Method {
    std::string_view name;
    Function* function = nullptr;
    std::span<Symbol*> parameters;
    Type result;
    const StructDefinition* result_structure = nullptr;
    bool result_handle = false;
};

// Texts that a parameter is bound to: of a string, or handles, which commas may separate; unknown
// handles are null.
using BoundTexts = std::map<std::string, std::vector<std::string>, std::less<>>;

// How many numbers, or texts, parameters are bound to: those of open length are that long.
using BoundCounts = std::map<std::string, size_t, std::less<>>;

// A shader and the functions of its source. Units are numbered; 0 is the shader itself.
struct Unit {
    std::string handle;                  // "" of the shader itself
    ShaderDefinition* shader = nullptr;  // null: a source of several that has no co-shaders
    std::vector<Function*> functions;    // at the level of its file
    uint32_t first_token = 0;
    BoundTexts bound;
    BoundCounts counts = {};

    // Filled by list_members().
    std::vector<Method> methods;
    std::vector<const Symbol*> members;  // parameters, and what is declared public

    // Before the names of its parameters, members and functions in the shader that all become.
    std::string prefix() const { return handle.empty() ? "" : handle + "."; }
    const Symbol* find_member(std::string_view name) const;
    const Symbol* find_parameter(std::string_view name) const;
};

// A co-shader as of RSL 1 becomes a class: its body is the method that its kind names, as in
// surface(output color Ci, Oi); that of a "shader" is begin().
void make_class(Ast& ast, Unit& unit);

// What others can use of it.
void list_members(Unit& unit);

// The string of a literal, or of a parameter that is a string: what it is bound to, or its default.
std::optional<std::string> text_of(const Unit& unit, const Expr& e);

// The unit of the handle; 0 if there is none.
size_t unit_named(const std::vector<Unit>& units, std::string_view handle);

// The unit that a definition at this token belongs to.
size_t unit_at(const std::vector<Unit>& units, uint32_t token);

// Whether a co-shader's categories (its string parameter __category: a list with commas) fit a
// query: "x", "-x" (not x), "x&-y", or alternatives with commas. "" fits all.
bool in_category(const Unit& unit, std::string_view query);

}  // namespace kinora::rsl
