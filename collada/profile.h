// collada/profile.h: how much a finding weighs in a profile.
#pragma once

#include "collada/validate.h"

namespace kinora::collada {

// Of a finding that was reported with `severity`. Strict: each departure from the schema is an
// Error, and so is each deviation that reading tolerates. Lenient: hints and portability are Off.
Severity profile_severity(const FindingInfo& info, Severity severity, Profile profile);

}  // namespace kinora::collada
