// runtime/description/rsl_literals.h: string literals of RSL code that name files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/allowed_paths.h"

namespace kinora {

struct LiteralRange {
    size_t begin, end;  // between the quotes
};

// Those outside comments and #include lines.
std::vector<LiteralRange> string_literals(std::string_view code);

// A relative path, as opposed to a word such as "world".
bool may_name_file(std::string_view name);

// The code with literals that name files as they are seen from the folder of `document`. `files`
// are what the names meant so far.
std::string relinked_code(const std::string& code, const AllowedPaths& files,
                          const std::string& document);

}  // namespace kinora
