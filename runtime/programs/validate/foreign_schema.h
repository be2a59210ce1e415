// runtime/programs/validate/foreign_schema.h: elements of other makers against their XML Schema, by
// libxml2.
#pragma once

#include <string>

#include "collada/validate/validate.h"

namespace kinora {

// Validates each element and what is inside it and reports what the schema forbids, as
// SCHEMA_FOREIGN at the element or attribute. Returns "" or why nothing could be checked. The
// schema, and what it includes, is read from `what.files` only; there is no network. Thread-safe.
std::string check_foreign(const collada::ForeignElements& what);

}  // namespace kinora
