// runtime/programs/play/main.cpp: kinora-play.
#include <cstdio>

#include "runtime/base/memory/heap.h"
#include "runtime/player/player.h"
#include "runtime/programs/common/run_program.h"
#include "runtime/programs/common/standard_streams.h"
#include "runtime/programs/play/headless.h"
#include "runtime/programs/play/options.h"
#include "runtime/programs/play/ui/layout.h"
#include "runtime/programs/play/window/window.h"

namespace kinora {

namespace {

std::optional<OpenedSession> read_session_file(const std::string& file, std::string& error) {
    std::optional<RenderOptions> options = options_of_session(file, error);
    if (!options) return std::nullopt;
    Session session = *options->session;
    return OpenedSession{std::move(*options), std::move(session)};
}

std::optional<StartTime> start_of(const RenderOptions& options) {
    if (options.time) return StartTime{*options.time, true};
    if (options.frames && !options.frames->empty())
        return StartTime{double(options.frames->front())};
    return std::nullopt;
}

int play_scene(const PlayOptions& options) {
    PlayerSetup setup;
    setup.real_time = !options.headless || options.real_time;
    setup.watch_files = setup.real_time;
    if (!options.headless) setup.wake = play::wake_window;
    setup.read_session = read_session_file;
    setup.shows_broken = !options.headless;
    Player player(setup);
    if (!options.record.empty() && !player.record_to(options.record)) {
        std::fprintf(stderr, "kinora-play: error: '%s' cannot be written\n",
                     options.record.c_str());
        return kExitUnwritable;
    }
    player.open(options.scene, options.scene.session, start_of(options.scene));
    if (options.headless) return run_headless(options, player);
    std::string error;
    const play::WindowOptions window{options.scene.width > 0 || options.scene.scale != 1, false,
                                     play::layout_file(), options.script};
    const play::WindowEnd end = play::run_window(player, window, error);
    if (end == play::WindowEnd::Closed) return kExitOk;
    if (end == play::WindowEnd::ScriptFailed) return kExitSomeFailed;
    std::fprintf(stderr,
                 "kinora-play: error: there is no display (%s); "
                 "kinora-play --headless --script FILE works without one\n",
                 error.c_str());
    return kExitUsage;
}

}  // namespace

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::ready_standard_streams();
    kinora::use_large_pages();
    return kinora::run_program("kinora-play", [&]() -> int {
        kinora::PlayOptions options;
        if (std::optional<int> code = kinora::parse_play_options(argc, argv, options)) return *code;
        return kinora::play_scene(options);
    });
}
