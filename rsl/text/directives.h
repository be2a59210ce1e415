// rsl/text/directives.h: the '#' lines.
#pragma once

#include <string>

#include "rsl/text/budget.h"
#include "rsl/text/file_stack.h"
#include "rsl/text/includes.h"
#include "rsl/text/macro_expander.h"
#include "rsl/text/macro_table.h"

namespace kinora::rsl {

class Directives {
  public:
    Directives(MacroTable& macros, FileStack& files, MacroExpander& expander, Includes& includes,
               Budget& budget, TokenStream& out, Reporter& reporter)
        : macros_(macros),
          files_(files),
          expander_(expander),
          includes_(includes),
          budget_(budget),
          out_(out),
          reporter_(reporter) {}

    // Obeys a line whose '#' has been read. Leaves the file at the next line.
    void obey();

  private:
    using Line = const TokenList&;  // the tokens after the directive's name
    struct Row {
        std::string_view name;
        bool conditional;  // obeyed in skipped groups too
        bool text_line;    // reads the rest of the line as text itself; gets no tokens
        void (Directives::*run)(const Token& name, Line line);
    };
    static const Row kRows[];

    TokenList line_tokens();
    void unknown(const Token& name);
    void run_define(const Token& name, Line line);
    void run_undef(const Token& name, Line line);
    void run_include(const Token& name, Line line);
    void include(const std::string& file, bool quoted, const Token& at);
    void text_behind(Line line, size_t first);
    void run_if(const Token& name, Line line);
    void run_ifdef(const Token& name, Line line);
    void run_ifndef(const Token& name, Line line);
    void run_elif(const Token& name, Line line);
    void run_else(const Token& name, Line line);
    void run_endif(const Token& name, Line line);
    bool condition_value(const Token& name, Line line);
    bool defined_argument(const Token& name, Line line);
    Condition* open_condition(const Token& name);
    void run_pragma(const Token& name, Line line);
    void run_error(const Token& name, Line line);
    void run_warning(const Token& name, Line line);
    void run_nothing(const Token& name, Line line);

    MacroTable& macros_;
    FileStack& files_;
    MacroExpander& expander_;
    Includes& includes_;
    Budget& budget_;
    TokenStream& out_;  // gets the pragmas
    Reporter& reporter_;
};

}  // namespace kinora::rsl
