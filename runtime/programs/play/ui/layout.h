// runtime/programs/play/ui/layout.h: what the window remembers from one session to the next.
#pragma once

#include <string>
#include <vector>

namespace kinora::play {

enum class Area : unsigned char { Left, Right, Bottom, Count };
inline constexpr size_t kAreaCount = static_cast<size_t>(Area::Count);

// Sizes at scale 1.
struct Layout {
    int width = 1280, height = 800;  // of the window
    bool maximized = false;
    float scale = 0;                            // of text and widgets; 0: by the display
    float sizes[kAreaCount] = {230, 390, 190};  // widths of the sides, height of the bottom
    std::string front[kAreaCount];              // the panel in front of each area
    std::vector<std::string> panels;            // open ones
    bool has_panels = false;                    // `panels` was read
};

// $XDG_CONFIG_HOME/kinora/play.conf, or ~/.config/kinora/play.conf; "" without either.
std::string layout_file();

// Lines of "name value"; what is missing, unknown or out of range keeps its default.
Layout read_layout(const std::string& file);
// False where it cannot be written; the old file stays then.
bool write_layout(const std::string& file, const Layout& layout);

}  // namespace kinora::play
