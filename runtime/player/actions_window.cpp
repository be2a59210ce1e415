// runtime/player/actions_window.cpp: what is open in the window. The state names it; the window
// shows it.
#include <fmt/format.h>

#include <vector>

#include "runtime/player/core_p.h"

namespace kinora {

namespace {

CommandResult toggle(PlayerCore& core, const std::string& panel) {
    std::vector<std::string>& panels = core.state.panels;
    if (std::erase(panels, panel) == 0) panels.push_back(panel);
    return {};
}

}  // namespace

CommandResult action_panel(PlayerCore& core, const Arguments& a) {
    return toggle(core, a.text(0));
}
#define PANEL(word, name)                                             \
    CommandResult action_##word(PlayerCore& core, const Arguments&) { \
        return toggle(core, name);                                    \
    }
PANEL(show_scene, "scene")
PANEL(show_parameters, "parameters")
PANEL(show_editor, "editor")
PANEL(show_pixel, "pixel")
PANEL(show_findings, "findings")
PANEL(show_source, "source")
PANEL(show_explained, "explained")
PANEL(show_lights, "lights")
PANEL(show_library, "library")
PANEL(show_quality, "quality")
PANEL(show_times, "times")
PANEL(hud, "hud")
PANEL(full_screen, "full_screen")
PANEL(keys, "keys")
PANEL(commands, "commands")
#undef PANEL

// It stands under the statements of the panel Pixel.
CommandResult action_show_code(PlayerCore& core, const Arguments&) {
    CommandResult result = toggle(core, "code");
    const auto& panels = core.state.panels;
    if (!panels.empty() && panels.back() == "code") core.show_panel("pixel");
    return result;
}

CommandResult action_state(PlayerCore& core, const Arguments& a) {
    std::ofstream out(a.text(0), std::ios::binary);
    out << core.state_json();
    if (!out.flush()) return refused(fmt::format("'{}' cannot be written", a.text(0)), 1);
    ++core.state.files_written;
    return {true, a.text(0), 0};
}

}  // namespace kinora
