// rsl/builtins/table.h: all rows of built-ins, and how they are found by name.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "rsl/model/builtin.h"

namespace kinora::rsl {

// The groups, each defined in rsl/builtins/<group>.cpp. A name may have several rows in one group.
std::span<const Builtin> builtins_arrays();
std::span<const Builtin> builtins_math();
std::span<const Builtin> builtins_filterstep();
std::span<const Builtin> builtins_spline();
std::span<const Builtin> builtins_derivatives();
std::span<const Builtin> builtins_geometric();
std::span<const Builtin> builtins_reflection();
std::span<const Builtin> builtins_spaces();
std::span<const Builtin> builtins_color();
std::span<const Builtin> builtins_noise();
std::span<const Builtin> builtins_light();
std::span<const Builtin> builtins_sampling();
std::span<const Builtin> builtins_rays();
std::span<const Builtin> builtins_occlusion();
std::span<const Builtin> builtins_points();
std::span<const Builtin> builtins_texture();
std::span<const Builtin> builtins_environment();
std::span<const Builtin> builtins_bump();
std::span<const Builtin> builtins_texture_files();
std::span<const Builtin> builtins_matrix();
std::span<const Builtin> builtins_string();
std::span<const Builtin> builtins_message();
std::span<const Builtin> builtins_foreign();

// All groups in order: for the manual and the row tests.
struct BuiltinGroup {
    const char* title;  // of its part of the manual
    std::span<const Builtin> rows;

    operator std::span<const Builtin>() const { return rows; }
    auto begin() const { return rows.begin(); }
    auto end() const { return rows.end(); }
};
const std::vector<BuiltinGroup>& builtin_groups();

// The overloads of a name in row order; empty when there is none. Valid for the life of the
// process; thread-safe.
std::span<const Overload> find_builtin(std::string_view name);

// All names, for did-you-mean.
const std::vector<std::string_view>& builtin_names();

// Names of other renderers' functions that Kinora knows of but does not have: "" or the place they
// come from ("Pixie", "RSL 2.0", "PRMan 13").
std::string_view foreign_builtin(std::string_view name);

// Decodes one signature string; CHECKs that it is well formed (a row is our own text).
std::vector<Signature> parse_signatures(std::string_view text);

}  // namespace kinora::rsl
