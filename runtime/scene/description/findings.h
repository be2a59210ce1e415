// runtime/scene/description/findings.h: the findings of runtime, one constant a row of
// findings.def.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora::Code {

using enum Severity;

#define FINDING(code, ...) inline constexpr FindingInfo code = finding_row(#code, __VA_ARGS__);
#include "runtime/scene/description/findings.def"
#undef FINDING

}  // namespace kinora::Code
