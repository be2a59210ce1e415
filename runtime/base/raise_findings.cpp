// runtime/base/raise_findings.cpp: what was left out becomes an error where nothing is left.
#include "runtime/base/raise_findings.h"

namespace kinora {

bool raise_findings(Diagnostics& diagnostics, std::string_view group) {
    std::vector<Finding> findings = diagnostics.findings();
    bool any = false;
    for (Finding& f : findings) {
        if (!std::string_view(f.info->code).starts_with(group)) continue;
        if (f.info->severity != Severity::Error || f.severity == Severity::Off) continue;
        f.severity = Severity::Error;
        any = true;
    }
    if (!any) return false;
    diagnostics.clear();
    for (Finding& f : findings) {
        Finding& again = diagnostics.add(*f.info, f.where, f.message);
        again = std::move(f);
    }
    return true;
}

}  // namespace kinora
