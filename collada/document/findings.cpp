// collada/document/findings.cpp: the rows of findings.def as objects.
#include "collada/document/findings.h"

namespace kinora::collada {

namespace Code {
using enum Severity;

#define FINDING(code, ...) const FindingInfo code = finding_row(#code, __VA_ARGS__);
#include "collada/document/findings.def"
#undef FINDING
}  // namespace Code

const FindingInfo* const* all_findings() {
    static const FindingInfo* const kAll[] = {
#define FINDING(code, ...) &Code::code,
#include "collada/document/findings.def"
#undef FINDING
        nullptr};
    return kAll;
}

}  // namespace kinora::collada
