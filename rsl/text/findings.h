// rsl/text/findings.h: the findings of the shading language: rows of findings.def as constants.
#pragma once

#include <span>

#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

struct Code {
    using enum Severity;

#define FINDING(code, ...) static constexpr FindingInfo code = finding_row(#code, __VA_ARGS__);
#include "rsl/text/findings.def"
#undef FINDING
};

// All rows, for --explain and the manual.
std::span<const FindingInfo* const> finding_rows();

}  // namespace kinora::rsl
