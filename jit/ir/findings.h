// jit/ir/findings.h: the findings of findings.def as constants.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora::jit::Code {

using enum Severity;

#define FINDING(code, ...) inline constexpr FindingInfo code = finding_row(#code, __VA_ARGS__);
#include "jit/ir/findings.def"
#undef FINDING

}  // namespace kinora::jit::Code
