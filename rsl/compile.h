// rsl/shader.h: from source text to checked shaders: preprocess, parse, check.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rsl/ast.h"
#include "rsl/globals.h"
#include "runtime/base/diagnostic.h"
#include "runtime/base/file_trees.h"

namespace kinora::rsl {

// Text to compile and where its bytes stand: a whole .sl file (identity map) or the decoded <code>
// of a .dae. The views need to live only during compile().
struct ShaderSource {
    std::string_view text;
    SourceMap map;  // map.file is registered in the Diagnostics given to compile()
};

struct CompileOptions {
    std::vector<std::string> include_directories;  // after the including file's own
    std::vector<std::pair<std::string, std::string>>
        defines;                         // -D NAME=VALUE ("1" when none given)
    std::vector<std::string> undefines;  // -U NAME
    int max_errors = 20;                 // then one "too many errors" and silence
    bool require_implemented = true;     // a built-in whose row has no lowering is an error
    // What the source may read. #include of a file elsewhere is an error, a literal that names a
    // texture or point file elsewhere a warning (whoever runs the shader must refuse it).
    FileTrees files;
};

// A value known without running. numbers: component_count x elements; strings for String types.
struct ConstantValue {
    std::vector<float> numbers;
    std::vector<std::string> strings;
    bool in_shader_space = false;  // numbers of points, vectors and normals that are still to be placed
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
};

// Preprocesses, parses and checks all shaders of the source. Findings go to `diagnostics`, with
// places in the file that source.map names. A shader is returned only when the whole source has no
// error. Never throws on bad input, never hangs (limits on expansion, nesting and includes).
std::vector<std::unique_ptr<Shader>> compile(const ShaderSource& source,
                                             const CompileOptions& options,
                                             Diagnostics& diagnostics);

// Reads the file, registers it and compiles it; a missing file is a finding.
std::vector<std::unique_ptr<Shader>> compile_file(const std::string& path,
                                                  const CompileOptions& options,
                                                  Diagnostics& diagnostics);

// The stages alone, for --dump and tests. parse() returns null when there are errors.
TokenStream preprocess(const ShaderSource& source, const CompileOptions& options,
                       Diagnostics& diagnostics);
std::shared_ptr<Ast> parse(const ShaderSource& source, const CompileOptions& options,
                           Diagnostics& diagnostics);

// One token a line: place, kind, text.
std::string print_tokens(const TokenStream& tokens, const SourceFiles& files);
// Source text again, in one canonical layout; implicit casts are left out, so that
// print -> parse -> print gives the same text.
std::string print_ast(const Ast& ast);
// The source with types, rates, casts and chosen overloads of a checked Ast written out.
std::string print_types(const Ast& ast);
// After preprocessing, as text (-E).
std::string print_preprocessed(const TokenStream& tokens);

}  // namespace kinora::rsl
