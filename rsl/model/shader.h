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

// Whether pictures of it can be made: numbers that the shader hands out, of each element one.
inline bool is_aov(const ShaderParameter& p) {
    return p.output && p.type.base != BaseType::String && p.type.base != BaseType::Matrix;
}

// A vertex input that a shader reads by name, with readprimvar(): no parameter of it declares it.
struct VertexRequest {
    BaseType type = BaseType::Float;
    std::string name;  // "": known at run time alone, so that any may be meant

    bool operator==(const VertexRequest&) const = default;
};
// The name of its binding, which no parameter can have: "@color.glow".
std::string vertex_request_name(BaseType type, std::string_view input);
// The input of such a binding; nothing where it is another binding, or of another type.
std::optional<std::string_view> requested_input(std::string_view binding, BaseType type);

// An output that a shader names at run time; '*' stands for any text.
struct NamedOutput {
    BaseType type = BaseType::Float;  // or Color, for all triples
    std::string pattern;
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
    std::vector<VertexRequest> vertex_requests;
    std::vector<NamedOutput> named_outputs;
    std::vector<LinkedPart> parts;  // of a linked shader: itself, then all that it was given
    // Of a surface of a class that has displacement() too: the same class as a displacement, which
    // moves the vertices before the surface is seen.
    std::shared_ptr<const Shader> displacement = nullptr;
};

// The type of an output that the shader may name so at run time.
std::optional<BaseType> named_output(const Shader& shader, std::string_view name);

}  // namespace kinora::rsl
