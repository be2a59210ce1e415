// collada/document/findings.cpp: the rows of findings.def as objects.
#include "collada/document/findings.h"

namespace kinora::collada {

namespace Code {
#define FINDING(code, severity, text, explanation, fix) \
    const FindingInfo code{#code, Severity::severity, text, explanation, fix};
#include "collada/document/findings.def"
#undef FINDING
}  // namespace Code

const FindingInfo* const* all_findings() {
    static const FindingInfo* const kAll[] = {
#define FINDING(code, severity, text, explanation, fix) &Code::code,
#include "collada/document/findings.def"
#undef FINDING
        nullptr};
    return kAll;
}

}  // namespace kinora::collada
