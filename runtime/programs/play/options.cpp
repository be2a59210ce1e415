// runtime/programs/play/options.cpp: kinora-play's command line.
#include "runtime/programs/play/options.h"

#include <cstdio>
#include <filesystem>

#include "runtime/player/commands.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

std::optional<int> parse_play_options(int argc, char** argv, PlayOptions& o) {
    SceneProgram program{"kinora-play", "a scene that plays while its shaders are edited", {}};
    program.own = {
        {"--headless", nullptr, &o.headless,
         "no window: --script or --screenshot say what is done"},
        {"--script", &o.script, nullptr,
         "FILE: one command a line (docs/play.md); - is standard input"},
        {"--screenshot", &o.screenshot, nullptr,
         "FILE: the refined picture as .png or .exr, with a frame token (####) of each frame"},
        {"--record", &o.record, nullptr, "FILE: writes a script of what is done"},
        {"--real-time", nullptr, &o.real_time,
         "without a window too, time runs by the clock and pictures adapt to it"},
        {"--list-commands", nullptr, &o.list_commands,
         "prints the tables of commands, as docs/play.md has them"},
    };
    if (auto code = parse_scene_options(argc, argv, program, o.scene)) return code;
    if (o.list_commands) {
        std::fputs(commands_markdown().c_str(), stdout);
        return kExitOk;
    }
    if (!o.headless) return std::nullopt;
    const std::string& scene = o.scene.scene;
    if (scene.empty()) {
        std::fputs("kinora-play: --headless needs a scene\n", stderr);
        return kExitUsage;
    }
    std::error_code code;
    if (!std::filesystem::exists(scene, code)) {
        std::fprintf(stderr, "kinora-play: error: there is no file '%s'\n", scene.c_str());
        return kExitUnreadable;
    }
    if (o.script.empty() && o.screenshot.empty()) {
        std::fputs("kinora-play: --headless needs --script FILE or --screenshot FILE\n", stderr);
        return kExitUsage;
    }
    return std::nullopt;
}

}  // namespace kinora
