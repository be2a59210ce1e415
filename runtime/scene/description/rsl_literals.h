// runtime/scene/description/rsl_literals.h: string literals of RSL code that name files.
#pragma once

#include <cstddef>
#include <functional>
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

struct IncludeLine {
    LiteralRange line;  // from '#' to behind the closing quote
    LiteralRange name;
};

// The lines #include "name" outside comments.
std::vector<IncludeLine> include_lines(std::string_view code);

// A relative path, as opposed to a word such as "world".
bool may_name_file(std::string_view name);

// How code shall name a file that is there.
using FileLink = std::function<std::string(const std::string& file)>;
// As seen from the folder of `document`.
FileLink link_from(const std::string& document);

// The code with literals that name files as `link` gives them. `files` are what the names meant so
// far.
std::string relinked_code(const std::string& code, const AllowedPaths& files, const FileLink& link);

}  // namespace kinora
