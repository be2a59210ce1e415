// rsl/text/budget.cpp: the limits of expansion and inclusion.
#include "rsl/text/budget.h"

namespace kinora::rsl {

bool Budget::spend_tokens(size_t count, const Token& at) {
    tokens_ += count;
    if (tokens_ <= kMostTokens) return true;
    give_up(at);
    return false;
}

void Budget::give_up(const Token& at) {
    if (!exhausted_) reporter_.report(Code::RSL_MACRO_TOO_LARGE, at);
    exhausted_ = out_.truncated = true;
}

bool Budget::spend_include(size_t depth, const std::string& file, const Token& at) {
    if (depth <= kMostIncludeDepth && ++includes_ <= kMostIncludes) return true;
    reporter_.report(Code::RSL_INCLUDE_TOO_DEEP, at, file);
    exhausted_ = out_.truncated = true;
    return false;
}

}  // namespace kinora::rsl
