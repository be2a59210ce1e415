// tests/rsl/random_shader.h: random well-typed shaders for differential tests, written from the
// rows of the built-in table and of globals.def: a new row is fuzzed without another line here.
#pragma once

#include <cstdint>
#include <string>

namespace kinora::rsl {

// What a shader is made of: chances out of 100 of a statement, the rest are assignments and
// declarations.
struct ShaderPolicy {
    const char* name;
    int ifs;
    int loops;
    int jumps;  // break, continue, return (where they may stand)
    int arrays;
    int calls;    // statements that call void built-ins and functions
    int selects;  // of expressions
    int statements;
    int functions;
    bool keep_all;  // every local of the shader reaches an output, so that many live long
};
extern const ShaderPolicy kShaderPolicies[];
extern const int kShaderPolicyCount;

// The same source for the same seed on every machine: helper functions and one surface,
// displacement or light, one statement a line. Parameters named frame_* are meant to be bound to
// frame inputs, vary_* to point inputs; output parameters are AOVs. Rows without a reference
// meaning are called only if `all_rows`.
std::string random_shader(uint64_t seed, bool all_rows);

}  // namespace kinora::rsl
