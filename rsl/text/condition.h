// rsl/text/condition.h: #if: which lines of a file count, and what a condition is worth.
#pragma once

#include <vector>

#include "rsl/text/reporter.h"
#include "rsl/text/token.h"

namespace kinora::rsl {

inline constexpr int kMostConditionNesting = 200;  // of parentheses in #if

// An open #if.
struct Condition {
    Location where;
    bool active = false;  // the group being read counts
    bool done = false;    // a group has counted, or none may
    bool saw_else = false;
};

// The open #if of one file.
class ConditionStack {
  public:
    bool skipping() const { return !open_.empty() && !open_.back().active; }
    // Opens an #if; inside a skipped group none of its own counts.
    void open(Location where, bool value);
    Condition* innermost() { return open_.empty() ? nullptr : &open_.back(); }
    void close() { open_.pop_back(); }

  private:
    std::vector<Condition> open_;
};

// Is an #if expression not 0 whose macros are expanded and whose defined() are 0 or 1? Unknown
// names are 0. Reports RSL_BAD_CONDITION and returns false when it is malformed.
bool evaluate_condition(const TokenList& tokens, const Token& at, Reporter& reporter);

}  // namespace kinora::rsl
