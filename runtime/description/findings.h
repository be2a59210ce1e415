// runtime/description/findings.h: the findings of runtime, one constant a row of findings.def.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora::Code {

#define FINDING(code, severity, text, explanation, fix) \
    inline constexpr FindingInfo code{#code, Severity::severity, text, explanation, fix};
#include "runtime/description/findings.def"
#undef FINDING

}  // namespace kinora::Code
