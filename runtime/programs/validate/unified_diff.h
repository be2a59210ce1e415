// runtime/programs/validate/unified_diff.h: what changed between two texts, as `diff -u` says it.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// "" if nothing changed; `patch` makes the second text of the first one. Lines end with '\n', and
// keep whatever else they have.
std::string unified_diff(std::string_view before, std::string_view after,
                         const std::string& before_name, const std::string& after_name);

}  // namespace kinora
