// jit/ir/findings.h: the findings of findings.def as constants.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora::jit::Code {

#define FINDING(code, severity, text, explanation, fix) \
    inline constexpr FindingInfo code = {#code, Severity::severity, text, explanation, fix};
#include "jit/ir/findings.def"
#undef FINDING

}  // namespace kinora::jit::Code
