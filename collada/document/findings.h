// collada/document/findings.h: the codes of what reading a document may report.
#pragma once

#include "runtime/base/diagnostic.h"

namespace kinora::collada::Code {

#define FINDING(code, ...) extern const FindingInfo code;
#include "collada/document/findings.def"
#undef FINDING

}  // namespace kinora::collada::Code

namespace kinora::collada {

// All of them, ending with a null pointer: for --list-rules and --explain.
const FindingInfo* const* all_findings();

}  // namespace kinora::collada
