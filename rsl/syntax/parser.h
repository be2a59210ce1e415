// rsl/syntax/parser.h: tokens to a syntax tree, by recursive descent. After an error the parser
// skips to the next statement or definition and says nothing until then.
#pragma once

#include <string>
#include <vector>

#include "rsl/syntax/ast.h"
#include "rsl/syntax/parse_recovery.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

inline constexpr int kMostNesting = 400;  // of expressions and statements
inline constexpr int kMostHeight = 400;   // of an expression's tree, which later passes walk
inline constexpr int kMostArrayLength = 1 << 20;

class Parser {
  public:
    Parser(Ast& ast, Reporter& reporter) : ast_(ast), reporter_(reporter) {}
    void run();
    // What of the source is not in the tree.
    ParseRecovery& recovery() { return recovery_; }

  private:
    // parser.cpp: tokens, errors, recovery
    const Token& token(int ahead = 0) const;
    bool is(Punct punct, int ahead = 0) const { return token(ahead).punct == punct; }
    bool is(Word word, int ahead = 0) const { return token(ahead).word == word; }
    bool at_end() const { return token().kind == TokenKind::End; }
    void advance() { next_ += !at_end(); }
    bool accept(Punct punct);
    bool accept(Word word);
    bool expect(Punct punct, const char* what);
    void expect_semicolon();
    void missing_behind(const char* expected);
    bool after_reported() const;
    bool behind_nested_comment() const;
    bool begins_definition() const;
    bool begins_shader() const;
    std::string_view expect_name(const char* what);
    bool is_reserved(int ahead = 0) const;
    bool word_as_name(int ahead = 0) const;
    bool is_type(int ahead = 0) const {
        return token(ahead).word >= Word::Float && token(ahead).word <= Word::Void;
    }
    bool is_detail(int ahead = 0) const {
        return token(ahead).word >= Word::Uniform && token(ahead).word <= Word::Output;
    }
    void syntax_error(const char* expected);
    template <class... Args>
    Finding* error(const FindingInfo& info, const Token& at, const Args&... args) {
        if (panic_) return nullptr;
        panic_ = true;
        mark_broken();
        return &reporter_.report(info, at, args...);
    }
    SourceSpan span_from(uint32_t first) const;
    SourceSpan span_from(const SourceSpan& first, uint32_t token) const;
    void mark_broken();
    void skip_statement();
    void leave_statement(uint32_t begin);
    void lose(uint32_t begin, bool parameters = false);
    void skip_definition();
    void skip_balanced(Punct open, Punct close);
    uint32_t after_parens(uint32_t open) const;

    // parse_definition.cpp: shaders, functions, parameters, declarations
    void definition();
    bool newer_definition();
    bool file_variable();
    bool shader_definition();
    BlockStmt* shader_body(ShaderDefinition& shader);
    BlockStmt* body_as_function(BlockStmt* body);
    void function_definition();
    void unknown_definition();
    Function* function();
    std::span<Symbol*> parameters(SymbolKind kind);
    void end_of_parameters();
    bool is_parameter(uint32_t index) const;
    bool resume_parameters(uint32_t begin);
    struct Declaration {
        Type type;
        Detail detail = Detail::Unspecified;
        bool output = false;
    };
    bool declaration_head(Declaration& head);
    Symbol* declarator(const Declaration& head, SymbolKind kind);
    void array_suffix(Symbol& symbol);
    Expr* initialiser(Symbol& symbol);
    bool at_declaration() const;
    bool at_function(uint32_t ahead = 0) const;

    // parse_statement.cpp
    Stmt* statement();
    Stmt* statement_unguarded();
    BlockStmt* block();
    Stmt* declaration_statement();
    Stmt* extern_statement();
    Stmt* expression_statement();
    Expr* effect();
    Expr* step(Expr* target, uint32_t at);
    Stmt* if_statement();
    Stmt* while_statement();
    Stmt* for_statement();
    Stmt* jump_statement(Word word);
    Stmt* return_statement();
    Stmt* illuminance_statement();
    Stmt* illuminate_statement();
    Stmt* solar_statement();
    Stmt* gather_statement();
    Stmt* empty_statement();
    Stmt* body_statement();
    void leave_header(uint32_t open);
    bool head(Stmt& node, std::span<Expr*>& args);
    Expr* condition();
    std::span<Symbol*> declared_symbols(const Declaration& head, SymbolKind kind);

    // parse_expression.cpp
    Expr* expression();
    Expr* ternary();
    Expr* binary(int lowest);
    Expr* unary();
    bool at_doubled_sign() const;
    Expr* negated(int lowest);
    Expr* cast();
    Expr* c_cast();
    Expr* postfix();
    Expr* primary();
    Expr* number();
    Expr* string();
    Expr* parenthesised();
    Expr* call();
    Expr* bad_expression();
    void grow(int part_height);
    std::span<Expr*> arguments();
    std::span<Expr*> expression_list(Punct end, const char* expected);

    // parse_foreign.cpp: other languages, misspelt words
    bool newer_language(const Token& at, const char* feature);
    bool at_foreign_type(int ahead = 0) const;
    bool foreign_type(BaseType& base);
    bool shader_handle();
    bool foreign_cast();
    bool idle_word();
    bool foreign_statement();
    std::string_view resembled_word() const;
    std::string decimal_comma() const;
    Punct word_operator() const;
    bool word_not();
    bool foreign_character();
    bool misspelt_statement();
    bool else_if_word() const;
    Stmt* lonely_else();

    template <class Node>
    Node* make(SourceSpan span) {
        return ast_.make<Node>(span);
    }

    Ast& ast_;
    Reporter& reporter_;
    uint32_t next_ = 0;
    ParseRecovery recovery_;
    bool panic_ = false;     // an error was reported and nothing has been skipped to yet
    bool unclosed_ = false;  // the end of the file or shader was met inside a block, and said
    bool skipped_ = false;   // the statement before was broken: it may have been an if
    bool stopped_ = false;   // a construct of RSL 2.0 was met: nothing more is read
    std::string meant_;      // what a syntax error here most likely was to be
    int depth_ = 0;
    int height_ = 0;                           // of the expression parsed last
    Function* function_ = nullptr;             // being parsed
    ReturnStmt* shader_return_ = nullptr;      // the first "return;" of the shader being parsed
    std::vector<Symbol*> shader_locals_;       // what its body declares
    std::vector<Function*> shader_functions_;  // and the functions it defines
};

// The value of a constant whole-number expression (array lengths); -1 when it is none.
long constant_length(const Expr& expr);

}  // namespace kinora::rsl
