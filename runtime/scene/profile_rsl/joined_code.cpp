// runtime/scene/profile_rsl/joined_code.cpp: several <code> and <include> texts as one, with their
// locations.
#include "runtime/scene/profile_rsl/joined_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace kinora {

namespace {

namespace fs = std::filesystem;

// As it is found from the folder of another file.
std::string seen_from(const std::string& path, const std::string& file) {
    fs::path folder = fs::path(file).parent_path();
    fs::path seen = folder.empty() ? fs::path(path) : fs::path(path).lexically_relative(folder);
    return seen.empty() ? path : seen.generic_string();
}

}  // namespace

std::string joined_code(const collada::RslShading& shading, SourceMap& map) {
    std::string text;
    auto own = std::ranges::find(shading.codes, false, &collada::RslCode::included);
    if (own == shading.codes.end()) own = shading.codes.begin();
    map.file = own->map.file;
    for (const collada::RslCode& code : shading.codes) {
        if (code.map.file != map.file) {
            text += fmt::format("#include \"{}\"\n", seen_from(code.path, own->path));
            continue;
        }
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
