// rsl/text/preprocess.h: directives and macros, keeping for each token where it came from.
#pragma once

#include <set>
#include <string_view>

#include "rsl/text/budget.h"
#include "rsl/text/compile_options.h"
#include "rsl/text/directives.h"
#include "rsl/text/file_stack.h"
#include "rsl/text/includes.h"
#include "rsl/text/macro_expander.h"
#include "rsl/text/macro_table.h"
#include "rsl/text/text_store.h"

namespace kinora::rsl {

class Preprocessor {
  public:
    Preprocessor(const CompileOptions& options, Diagnostics& diagnostics, TokenStream& out,
                 Reporter& reporter);
    void run(const ShaderSource& source);

  private:
    void define_from_options();
    void define(std::string_view name, std::string_view value);
    void read();
    void emit(Token token);
    bool begins_remark(const Token& token);

    const CompileOptions& options_;
    const SourceFiles& source_files_;
    TokenStream& out_;
    Reporter& reporter_;
    TextStore texts_;
    MacroTable macros_;
    FileStack files_;
    Budget budget_;
    Includes includes_;
    MacroExpander expander_;
    Directives directives_;
    std::set<std::string_view> misprints_;  // of built-in types, that are reported
};

}  // namespace kinora::rsl
