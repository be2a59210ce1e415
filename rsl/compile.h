// rsl/compile.h: from source text to checked shaders: preprocess, parse, check.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rsl/model/shader.h"
#include "rsl/text/compile_options.h"

namespace kinora::rsl {

// Preprocesses, parses and checks all shaders of the source. Findings go to `diagnostics`, with
// locations in the file that source.map names. A shader is returned only when the whole source has
// no error. Never throws on bad input, never hangs (limits on expansion, nesting and includes).
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

// One token a line: location, kind, text.
std::string print_tokens(const TokenStream& tokens, const SourceFiles& files);
// Source text again, in one canonical layout; implicit casts are left out, so that
// print -> parse -> print gives the same text.
std::string print_ast(const Ast& ast);
// The source with types, rates, casts and chosen overloads of a checked Ast written out.
std::string print_types(const Ast& ast);
// After preprocessing, as text (-E): the source whose tokens begin at `first`.
std::string print_preprocessed(const TokenStream& tokens, uint32_t first = 0);

}  // namespace kinora::rsl
