// collada/validate/profile.h: how much a finding weighs in a profile.
#pragma once

#include "collada/validate/validate.h"

namespace kinora::collada {

// Of a finding that was reported with `severity`. Strict: each departure from the schema is an
// Error, and so is each deviation that reading tolerates. Lenient: hints and portability are Off.
Severity profile_severity(const FindingInfo& info, Severity severity, Profile profile);

// For V1_4_1 and V1_5: the document is judged by that version's rules from now on. Reports
// DOC_NAMESPACE where it says it is of the other one.
void judge_by_profile(Document& document, Profile profile, Diagnostics& diag);

}  // namespace kinora::collada
