// rsl/text/macro_expander.h: reads tokens and expands the macros among them.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "rsl/text/budget.h"
#include "rsl/text/file_stack.h"
#include "rsl/text/macro_table.h"
#include "rsl/text/text_store.h"
#include "rsl/text/token_input.h"

namespace kinora::rsl {

inline constexpr size_t kMostParameterTokens = 2000;  // of a function, looked through
inline constexpr int kMostMacroNesting = 200;         // of macro calls inside arguments

// Replacements are put before the rest of the input and read again; a macro is off while its own
// replacement is read, so expansion always ends.
class MacroExpander {
  public:
    // Adds the macro uses to `out`. `obey_directive` obeys a '#' line that stands between the
    // arguments of a macro, its '#' having been read.
    MacroExpander(MacroTable& macros, FileStack& files, TextStore& texts, Budget& budget,
                  TokenStream& out, const SourceFiles& source_files, Reporter& reporter,
                  std::function<void()> obey_directive)
        : macros_(macros),
          files_(files),
          texts_(texts),
          budget_(budget),
          out_(out),
          source_files_(source_files),
          reporter_(reporter),
          obey_directive_(std::move(obey_directive)),
          input_(files) {}

    // The next token that is no macro use.
    Token next();
    TokenList expand(const TokenList& tokens);
    // The same for an #if: "defined" is an operator there.
    TokenList expand_condition(const TokenList& tokens);

  private:
    using Arguments = std::vector<TokenList>;
    bool try_expand(Token& token);
    bool names_definition() const;
    void expand_special(Token& token, const Macro& macro);
    bool read_arguments(const Token& name, const Macro& macro, Arguments& arguments);
    bool fit_arguments(const Token& name, const Macro& macro, Arguments& arguments);
    Token defined_operator(Token token);

    MacroTable& macros_;
    FileStack& files_;
    TextStore& texts_;
    Budget& budget_;
    TokenStream& out_;
    const SourceFiles& source_files_;
    Reporter& reporter_;
    std::function<void()> obey_directive_;
    TokenInput input_;
    bool in_condition_ = false;  // of an #if
    int nesting_ = 0;            // of lists being expanded
};

}  // namespace kinora::rsl
