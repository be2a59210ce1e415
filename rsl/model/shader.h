// rsl/model/shader.h: a checked shader: its parameters and what it uses.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/model/globals.h"
#include "rsl/syntax/ast.h"

namespace kinora::rsl {

// A value known without running. numbers: component_count x elements; strings for String types.
struct ConstantValue {
    std::vector<float> numbers;
    std::vector<std::string> strings;
    bool in_shader_space =
        false;  // numbers of points, vectors and normals that are still to be transformed
};

struct ShaderParameter {
    std::string_view name;
    Type type;
    Detail detail = Detail::Uniform;  // as declared; Unspecified is Uniform for parameters
    bool output = false;
    Symbol* symbol = nullptr;
    Expr* default_value = nullptr;          // null: zero
    std::optional<ConstantValue> constant;  // the default when it folds
};

// Texts that a parameter is bound to: of a string, or handles for one of type shader.
using LinkTexts = std::map<std::string, std::vector<std::string>, std::less<>>;

// How many numbers, or texts, a parameter is bound to: that decides the length of "T a[]".
using LinkCounts = std::map<std::string, size_t, std::less<>>;

// One of the shaders that a linked shader was made of (rsl/link.h), as it was written.
struct LinkedPart {
    std::string handle;  // "" of the shader itself
    std::string shader;  // its name
    LinkTexts texts;
    std::vector<std::string> handle_parameters;  // those of `texts` that are of type shader
    std::shared_ptr<const std::string> text;     // parts of one text share it
    SourceMap map;
    uint32_t first_token = 0;  // in the Ast
    LinkCounts counts = {};
};

// A checked shader. Shaders of one source share its Ast.
struct Shader {
    std::string name;
    ShaderKind kind = ShaderKind::Surface;
    std::shared_ptr<const Ast> ast;
    const ShaderDefinition* definition = nullptr;  // body, parameters
    std::vector<ShaderParameter> parameters;
    std::vector<const GlobalInfo*> globals_read;  // by it and the functions it calls, table order
    std::vector<const GlobalInfo*> globals_written;
    std::vector<const Function*> functions;  // those it reaches
    std::vector<LinkedPart> parts;  // of a linked shader: itself, then all that it was given
    // Of a surface of a class that has displacement() too: the same class as a displacement, which
    // moves the vertices before the surface is seen.
    std::shared_ptr<const Shader> displacement = nullptr;
};

}  // namespace kinora::rsl
