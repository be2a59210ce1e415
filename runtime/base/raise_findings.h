// runtime/base/raise_findings.h: what was left out becomes an error where nothing is left.
#pragma once

#include <string_view>

#include "runtime/base/diagnostic.h"

namespace kinora {

// Findings whose codes begin with `group` become errors if validating calls them so. Returns
// whether there are any: then they are the cause, and no other needs to be told.
bool raise_findings(Diagnostics& diagnostics, std::string_view group);

}  // namespace kinora
