// runtime/programs/play/ui/layout.cpp: the file of remembered sizes and panels.
#include "runtime/programs/play/ui/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "runtime/base/files/temporary_file.h"

namespace kinora::play {

namespace {

constexpr const char* kAreas[kAreaCount] = {"left", "right", "bottom"};

template <class T>
void take(std::istream& in, T& value, T least, T most) {
    T read{};
    if (in >> read && read >= least && read <= most) value = read;
}

}  // namespace

std::string layout_file() {
    if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder && *folder)
        return std::string(folder) + "/kinora/play.conf";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::string(home) + "/.config/kinora/play.conf";
    return {};
}

Layout read_layout(const std::string& file) {
    Layout layout;
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        if (name == "width") take(words, layout.width, 320, 16384);
        if (name == "height") take(words, layout.height, 240, 16384);
        if (name == "maximized") words >> layout.maximized;
        if (name == "scale") take(words, layout.scale, 0.5f, 4.0f);
        for (size_t i = 0; i < kAreaCount; ++i) {
            if (name == kAreas[i]) take(words, layout.sizes[i], 80.0f, 4096.0f);
            if (name == std::string(kAreas[i]) + "_front") words >> layout.front[i];
        }
        if (name == "panels") {
            layout.has_panels = true;
            for (std::string panel; words >> panel;) layout.panels.push_back(panel);
        }
    }
    return layout;
}

bool write_layout(const std::string& file, const Layout& layout) {
    if (file.empty()) return false;
    std::string text = fmt::format("width {}\nheight {}\nmaximized {:d}\n", layout.width,
                                   layout.height, layout.maximized);
    if (layout.scale > 0) text += fmt::format("scale {:.3g}\n", layout.scale);
    for (size_t i = 0; i < kAreaCount; ++i) {
        text += fmt::format("{} {:.0f}\n", kAreas[i], layout.sizes[i]);
        if (!layout.front[i].empty())
            text += fmt::format("{}_front {}\n", kAreas[i], layout.front[i]);
    }
    text += fmt::format("panels {}\n", fmt::join(layout.panels, " "));
    return make_folder_of(file) == 0 && write_whole_file(file, text) == 0;
}

}  // namespace kinora::play
