// rsl/text/preprocess.h: directives and macros, keeping for each token where it came from.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rsl/text/compile_options.h"
#include "rsl/text/lexer.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// Bounds that keep hostile or mistaken source from hanging us.
inline constexpr size_t kMostTokens = 1'000'000;  // made by expansion, in one compile
inline constexpr size_t kMostIncludeDepth = 64;
inline constexpr size_t kMostIncludes = 1000;
inline constexpr uintmax_t kMostIncludeBytes = 64 << 20;  // of one file
inline constexpr size_t kMostParameterTokens = 2000;      // of a function, looked through
inline constexpr int kMostMacroNesting = 200;             // of macro calls inside arguments
inline constexpr int kMostConditionNesting = 200;         // of parentheses in #if

struct Macro {
    std::string_view name;
    Location definition;
    bool function_like = false;
    bool variadic = false;
    bool special = false;    // __FILE__, __LINE__
    bool standard = false;   // of a customary header of ours
    bool undefined = false;  // by #undef: the node stays, since expansions may point to it
    bool expanding = false;  // its replacement is being read: its name is no macro inside
    std::vector<std::string_view> parameters;
    std::vector<Token> replacement;
};

class Preprocessor {
  public:
    Preprocessor(const CompileOptions& options, Diagnostics& diagnostics, TokenStream& out,
                 Reporter& reporter);
    void run(const ShaderSource& source);

  private:
    using TokenList = std::vector<Token>;
    struct File {
        Lexer lexer;
        FileId id = kNoFile;
        std::string path;
        size_t conditions = 0;  // open #if of the includers
        bool standard = false;  // a customary header of ours
    };
    // An open #if.
    struct Condition {
        Location where;
        bool active = false;  // the group being read counts
        bool done = false;    // a group has counted, or none may
        bool saw_else = false;
    };
    // Tokens to be read before the file's next ones.
    struct Pending {
        TokenList tokens;
        size_t next = 0;
        Macro* macro = nullptr;  // to be enabled again when read to the end
    };
    // preprocess.cpp
    void define_from_options();
    void define_text(std::string_view name, std::string_view value);
    TokenList text_tokens(std::string text);
    void read_file();
    Token raw_next();
    Token peek_raw();
    void emit(Token token);
    void report_trouble();
    void enter_text(std::string_view text, const SourceMap& map, std::string path);
    void finish_file();

    // preprocess_directives.cpp: each gets the directive's name and the tokens after it
    using Line = const TokenList&;
    struct DirectiveRow {
        std::string_view name;
        bool conditional;  // obeyed in skipped groups too
        void (Preprocessor::*run)(const Token& name, Line line);
    };
    static const DirectiveRow kDirectives[];
    void directive();
    TokenList directive_tokens();
    bool is_defined(std::string_view name) const;
    void run_define(const Token& name, Line line);
    bool define_parameters(Macro& macro, Line line, size_t& next);
    void run_undef(const Token& name, Line line);
    void run_include(const Token& name, Line line);
    bool load_include(std::string file, bool quoted, const Token& at);
    void run_if(const Token& name, Line line);
    void run_ifdef(const Token& name, Line line);
    void run_ifndef(const Token& name, Line line);
    void run_elif(const Token& name, Line line);
    void run_else(const Token& name, Line line);
    void run_endif(const Token& name, Line line);
    void run_pragma(const Token& name, Line line);
    void run_error(const Token& name, Line line);
    void run_warning(const Token& name, Line line);
    void run_nothing(const Token& name, Line line);
    void open_condition(const Token& name, bool value);
    bool condition_value(const Token& name, Line line);
    Token defined_operator(Token token);
    bool defined_argument(const Token& name, Line line);
    Condition* inner_condition(const Token& name);
    bool skipping() const { return !conditions_.empty() && !conditions_.back().active; }

    // preprocess_macros.cpp
    Token next_expanded();
    Token next_unexpanded();
    Token peek_unexpanded();
    bool try_expand(Token& token);
    bool names_definition() const;
    bool expand_special(Token& token, const Macro& macro);
    bool read_arguments(const Token& name, const Macro& macro, std::vector<TokenList>& arguments);
    bool fit_arguments(const Token& name, const Macro& macro, std::vector<TokenList>& arguments);
    TokenList substitute(const Macro& macro, const std::vector<TokenList>& arguments, uint32_t use,
                         const Token& name);
    TokenList expand_list(const TokenList& tokens);
    std::optional<Token> paste(const Token& left, const Token& right, const Token& at);
    Token stringise(const TokenList& tokens, const Token& at);
    void push(TokenList tokens, Macro* macro);
    std::string_view keep(std::string text);
    bool spend(size_t tokens, const Token& at);
    void give_up(const Token& at);

    const CompileOptions& options_;
    Diagnostics& diagnostics_;
    TokenStream& out_;
    Reporter& reporter_;
    std::unordered_map<std::string_view, Macro> macros_;  // nodes do not move
    std::vector<File> files_;
    std::vector<Condition> conditions_;
    std::vector<Pending> pending_;
    size_t floor_ = 0;           // pending_ below it is out of reach (argument expansion)
    bool isolated_ = false;      // reading a list, not the file
    bool in_condition_ = false;  // of an #if: "defined" is an operator
    int nesting_ = 0;
    size_t spent_ = 0;
    size_t includes_ = 0;
    bool exhausted_ = false;
    std::deque<SourceMap> maps_;
    std::vector<std::string> once_;  // paths of files with #pragma once
};

// Is an #if expression not 0 whose macros are expanded and whose defined() are 0 or 1? Unknown
// names are 0. Reports RSL_BAD_CONDITION and returns false when it is malformed.
bool evaluate_condition(const std::vector<Token>& tokens, const Token& at, Reporter& reporter);

}  // namespace kinora::rsl
