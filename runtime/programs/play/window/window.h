// runtime/programs/play/window/window.h: the player in a window.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/player/player.h"

namespace kinora::play {

struct WindowOptions {
    bool fixed_size = false;   // --size: pictures keep it, whatever the window's size
    bool full_screen = false;  // from the start
    std::string layout;        // the file of remembered sizes; "" none
    std::string script;        // the file whose lines run in the window; "" none, "-" stdin
};

// For PlayerSetup::wake, from any thread: the window turns. Nothing happens without a window.
void wake_window();

enum class WindowEnd : uint8_t { Closed, ScriptFailed, NoWindow };

// Until the player or the window is closed. Where no window could be had `error` says why; errors
// of the script are printed as they come.
WindowEnd run_window(Player& player, const WindowOptions& options, std::string& error);

}  // namespace kinora::play
