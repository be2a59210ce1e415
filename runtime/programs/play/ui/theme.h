// runtime/programs/play/ui/theme.h: colours, spacing and fonts of the window.
#pragma once

#include <imgui.h>

#include <cstddef>

#include "runtime/programs/play/editor/editor_pane.h"

namespace kinora::play {

class Letters;  // letters.h

struct Fonts {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* mono = nullptr;
    bool found = false;  // else ImGui's own font, Latin letters alone
};

inline constexpr size_t kHudStages = 6;

struct Theme {
    float scale = 1;  // of all sizes: 1 at 96 dots an inch
    Fonts fonts;
    ImU32 text, dim, faint, accent, good, warning, error;
    ImU32 stage, panel, raised, line;  // `stage`: around the picture
    ImU32 stages[kHudStages];          // of StageTimes
    EditorColors editor;

    float px(float size) const { return size * scale; }
};

// Loads the fonts of the current ImGui context and sets its style.
Theme make_theme(float scale);

// DejaVu from Debian's folders, ImGui's own where it is missing; with these letters, in whatever
// font of the system has them. All fonts before are gone.
Fonts load_fonts(float scale, const Letters& letters);

}  // namespace kinora::play
