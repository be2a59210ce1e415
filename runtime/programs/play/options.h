// runtime/programs/play/options.h: what kinora-play was asked for.
#pragma once

#include <optional>
#include <string>

#include "runtime/programs/render/options.h"

namespace kinora {

struct PlayOptions {
    RenderOptions scene;
    bool headless = false;
    bool real_time = false;  // headless: by the clock
    std::string script, screenshot, record;
    bool list_commands = false;  // prints the tables of docs/play.md
};

// As parse_render_options.
std::optional<int> parse_play_options(int argc, char** argv, PlayOptions& options);

}  // namespace kinora
