// runtime/programs/manual/statements.h: what the manual says of statements, storage classes,
// preprocessor lines and kinds of shader: each with an example that compiles.
#pragma once

#include <span>
#include <string_view>

namespace kinora {

struct ManualEntry {
    std::string_view names;        // that ask for it, separated by spaces
    std::string_view form;         // "while (condition) statement"
    std::string_view text;         // what it does
    std::string_view example;      // a whole source
    std::string_view attach = {};  // of a kind of shader: the lines of the scene that use it
    bool has_name(std::string_view name) const;
};

struct ManualChapter {
    std::string_view title;
    std::span<const ManualEntry> entries;
};
std::span<const ManualChapter> manual_chapters();

}  // namespace kinora
