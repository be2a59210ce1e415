// rsl/syntax/syntax_errors.h: errors of the grammar, and where the parser goes on after one.
#pragma once

#include <string>
#include <string_view>

#include "rsl/syntax/parse_recovery.h"
#include "rsl/syntax/token_cursor.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// After an error there is panic: nothing more is said, and the parser returns to the statement or
// definition, which skips to the next one.
class SyntaxErrors {
  public:
    SyntaxErrors(TokenCursor& cursor, Reporter& reporter) : cursor_(cursor), reporter_(reporter) {}

    bool panic() const { return panic_; }
    // RSL 2.0 was met: nothing more is read.
    bool stopped() const { return stopped_; }
    bool full() const { return reporter_.full(); }
    int count() const { return reporter_.errors(); }
    // Grows whenever something is not in the tree that the source has.
    uint32_t breaks() const { return breaks_; }

    // A finding that the parser goes on after.
    template <class... Args>
    Finding& report(const FindingInfo& info, const Token& at, const Args&... args) {
        return reporter_.report(info, at, args...);
    }
    template <class... Args>
    Finding& report(const FindingInfo& info, Location where, uint32_t macro, const Args&... args) {
        return reporter_.report(info, where, macro, {}, args...);
    }
    // A finding and panic; null in panic.
    template <class... Args>
    Finding* error(const FindingInfo& info, const Token& at, const Args&... args) {
        if (panic_) return nullptr;
        panic_ = true;
        mark_broken();
        return &reporter_.report(info, at, args...);
    }
    // The token is not what the grammar wants here.
    void syntax_error(const char* expected);
    // What is missing between the last token and this one, where both are whole.
    void missing_behind(const char* expected);
    // RSL 2.0 is another language: it is named once, and nothing more is said of the source. True.
    bool newer_language(const Token& at, const char* feature);

    bool expect(Punct punct, const char* what);
    void expect_semicolon();
    std::string_view expect_name(const char* what);
    // What a syntax error here most likely was to be; "" for nothing.
    void set_meant(std::string meant) { meant_ = std::move(meant); }

    // ---- recovery
    ParseRecovery& recovery() { return recovery_; }
    void begin_definition();
    void mark_broken();
    // The tokens from `begin` on to here are not in the tree. `declares`, `whole_file`: as of
    // ParseRecovery::lose.
    void lose(uint32_t begin, bool declares = false, bool whole_file = false);
    // Ends a panic at this position.
    void resume_at(uint32_t position, uint32_t begin, bool declares = false);
    // In panic: to the end of the statement, or definition, that begins at the token.
    void leave_statement(uint32_t begin);
    void leave_definition(uint32_t begin);

  private:
    void skip_statement();
    void skip_definition();
    bool foreign_character();
    std::string decimal_comma() const;
    bool behind_nested_comment() const;

    TokenCursor& cursor_;
    Reporter& reporter_;
    ParseRecovery recovery_;
    bool panic_ = false;
    bool stopped_ = false;
    uint32_t breaks_ = 0;
    std::string meant_;
};

}  // namespace kinora::rsl
