// runtime/profile_rsl/joined_code.cpp: several <code> and <include> texts as one, with their
// locations.
#include "runtime/profile_rsl/joined_code.h"

#include <fmt/format.h>

namespace kinora {

std::string joined_code(const collada::RslShading& shading, SourceMap& map) {
    std::string text;
    for (const collada::RslCode& code : shading.codes) {
        bool embedded = map.file == kNoFile || code.map.file == map.file;
        if (!embedded) {
            text += fmt::format("#include \"{}\"\n", code.path);
            continue;
        }
        map.file = code.map.file;
        uint32_t base = uint32_t(text.size());
        if (code.map.segments.empty()) map.segments.push_back({base, 0});
        for (const SourceMap::Segment& s : code.map.segments)
            map.segments.push_back({base + s.text_offset, s.file_offset});
        text += code.text;
        text += '\n';
    }
    return text;
}

}  // namespace kinora
