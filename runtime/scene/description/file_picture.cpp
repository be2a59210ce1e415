// runtime/scene/description/file_picture.cpp: the modes of displays.
#include "runtime/scene/description/file_picture.h"

#include <string_view>

namespace kinora {
namespace {

struct Mode {
    std::string_view name;
    bool color, alpha, depth;
};
constexpr Mode kModes[] = {
    {"rgb", true, false, false}, {"rgba", true, true, false}, {"a", false, true, false},
    {"z", false, false, true},   {"az", false, true, true},   {"rgbz", true, false, true},
    {"rgbaz", true, true, true}, {"Ci", true, false, false},  {"", true, true, false},
};

}  // namespace

// A variable may have its type before its name: "varying color glow".
DisplayContent content_of(const FileDisplay& display) {
    std::string_view name = display.mode;
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    if (const size_t blank = name.find_last_of(" \t"); blank != name.npos)
        name.remove_prefix(blank + 1);
    for (const Mode& mode : kModes)
        if (mode.name == name) return {mode.color, mode.alpha, mode.depth, ""};
    return {false, false, false, std::string(name)};
}

}  // namespace kinora
