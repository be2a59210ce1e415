// runtime/scene/images/exr_format.cpp: the table of compressions.
#include "runtime/scene/images/exr_format.h"

#include <algorithm>

#include "runtime/base/numbers.h"

namespace kinora {

namespace {

// Numbers of openexr.com, "OpenEXR File Layout". Levels are those of zlib, and DWA's loss.
constexpr ExrCompression kCompressions[] = {
    {"none", 0, false, 0},  {"rle", 1, false, 0},   {"zips", 2, false, 9}, {"zip", 3, false, 9},
    {"piz", 4, false, 0},   {"pxr24", 5, true, 0},  {"b44", 6, true, 0},   {"b44a", 7, true, 0},
    {"dwaa", 8, true, 1e6}, {"dwab", 9, true, 1e6},
};

}  // namespace

std::span<const ExrCompression> exr_compressions() {
    return kCompressions;
}

bool parse_compression(std::string_view text, ExrFormat& format) {
    const size_t colon = std::min(text.find(':'), text.size());
    const auto* found =
        std::ranges::find(kCompressions, text.substr(0, colon), &ExrCompression::name);
    if (found == std::end(kCompressions)) return false;
    format.compression = found;
    if (colon == text.size()) return true;
    double level[1];
    if (!read_numbers<double>(text.substr(colon + 1), ',', level)) return false;
    format.level = level[0];
    return level[0] >= 0 && level[0] <= found->most_level;
}

}  // namespace kinora
