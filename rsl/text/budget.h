// rsl/text/budget.h: how much one compile may expand and include, so that hostile or mistaken
// source comes to an end.
#pragma once

#include <string>

#include "rsl/text/reporter.h"
#include "rsl/text/token.h"

namespace kinora::rsl {

inline constexpr size_t kMostTokens = 1'000'000;  // made by expansion
inline constexpr size_t kMostIncludeDepth = 64;
inline constexpr size_t kMostIncludes = 1000;

class Budget {
  public:
    // Going over a limit is reported once and marks `out` as truncated.
    Budget(TokenStream& out, Reporter& reporter) : out_(out), reporter_(reporter) {}

    // Whether that many more tokens may be made for the macro use `at`.
    bool spend_tokens(size_t count, const Token& at);
    // Whether one more file may be included, inside `depth` others.
    bool spend_include(size_t depth, const std::string& file, const Token& at);
    // An expansion is too large in another way.
    void give_up(const Token& at);
    // Nothing more is to be read.
    bool exhausted() const { return exhausted_; }

  private:
    TokenStream& out_;
    Reporter& reporter_;
    size_t tokens_ = 0;
    size_t includes_ = 0;
    bool exhausted_ = false;
};

}  // namespace kinora::rsl
