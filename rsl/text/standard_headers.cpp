// rsl/text/standard_headers.cpp: finds the embedded headers. Their texts are in
// standard_headers_data.cpp, which CMake makes from assets/shaders/include.
#include "rsl/text/standard_headers.h"

#include <cstddef>
#include <string>

namespace kinora::rsl {

struct StandardHeader {
    const char* name;
    const char* text;
};
extern const StandardHeader kStandardHeaders[];
extern const size_t kStandardHeadersCount;

// Names that differ by letter case are the same, as on the systems where shaders were written.
std::string_view standard_header(std::string_view name) {
    bool in_stdrsl = name.find("stdrsl/") != name.npos;
    name.remove_prefix(name.find_last_of('/') + 1);  // npos + 1 is 0
    std::string lower(name);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    if (lower.ends_with(".sl")) lower.replace(lower.size() - 2, 2, "h");  // as some are spelled
    for (size_t i = 0; i < kStandardHeadersCount; ++i)
        if (lower == kStandardHeaders[i].name &&
            in_stdrsl == std::string_view(kStandardHeaders[i].text).starts_with("// stdrsl/"))
            return kStandardHeaders[i].text;
    return {};
}

namespace {

// "#define NAME(" or "type NAME(" at the beginning of a line.
bool defines(std::string_view text, std::string_view function) {
    std::string call = " " + std::string(function) + "(";
    for (size_t at = text.find(call); at != text.npos; at = text.find(call, at + 1)) {
        size_t line = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
        std::string_view before = text.substr(line, at - line);
        bool word =
            !before.empty() && before.find(' ') == before.npos && before.find('/') == before.npos;
        if (word) return true;
    }
    return false;
}

}  // namespace

std::string_view header_that_defines(std::string_view function) {
    for (size_t i = 0; i < kStandardHeadersCount; ++i)
        if (defines(kStandardHeaders[i].text, function)) return kStandardHeaders[i].name;
    return {};
}

}  // namespace kinora::rsl
