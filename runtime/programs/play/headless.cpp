// runtime/programs/play/headless.cpp: scripts and screenshots.
#include "runtime/programs/play/headless.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "runtime/player/script.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/missing_asset.h"
#include "runtime/programs/common/scene_exit_code.h"

namespace kinora {

namespace {

constexpr double kPatience = 24 * 3600;

void say(const std::string& line) {
    std::fprintf(stderr, "%s\n", line.c_str());
}

int run_script(const PlayOptions& options, Player& player) {
    const bool piped = options.script == "-";
    std::ifstream in(piped ? "/dev/stdin" : options.script);
    std::stringstream text;
    text << in.rdbuf();
    if (!in) {
        say(fmt::format("kinora-play: error: the script '{}' cannot be read", options.script));
        return kExitUsage;
    }
    return Script(player, options.script, say).run(text.str()) ? kExitOk : kExitSomeFailed;
}

int one_screenshot(Player& player, const std::string& file) {
    CommandResult result = player.run("screenshot", {file});
    if (result.done) return kExitOk;
    say("kinora-play: error: " + result.message);
    return kExitUnwritable;
}

// A film may have gaps.
bool has_frame(const Player& player, int64_t frame) {
    const std::shared_ptr<const FilmFrames>& film = player.state().time.film;
    return !film || std::ranges::count(film->frames, frame, &FilmFrame::number) > 0;
}

int take_screenshots(const PlayOptions& options, Player& player) {
    OutputName name(options.screenshot);
    const RenderOptions& scene = options.scene;
    if (scene.time) player.run("seek", {fmt::format("{}s", *scene.time)});
    if (!scene.frames) {
        player.wait_idle(kPatience);
        return one_screenshot(player, name.file(int64_t(player.state().time.frame)));
    }
    if (scene.frames->size() > 1 && !name.has_token()) {
        say("kinora-play: error: several frames need a frame token in --screenshot, as f.####.png");
        return kExitUsage;
    }
    const auto is_there = [&](int64_t frame) { return has_frame(player, frame); };
    if (std::ranges::none_of(*scene.frames, is_there)) {
        say("kinora-play: error: the film has none of the frames of --frames");
        return kExitUsage;
    }
    for (int64_t frame : *scene.frames) {
        if (!is_there(frame)) continue;
        player.run("seek", {fmt::format("{}", frame)});
        player.wait_idle(kPatience);
        if (int code = one_screenshot(player, name.file(frame))) return code;
    }
    return kExitOk;
}

}  // namespace

void PlayerFindings::print(const Player& player) {
    for (const FindingText& finding : player.findings()) {
        if (!seen_.insert(finding.printed).second) continue;
        bool error = finding.severity == "error", warning = finding.severity == "warning";
        fails_ |= error || (warning && options_.fail_on == Severity::Warning);
        missing_ |= is_missing_asset(finding.code);
        lacks_memory_ |= finding.code == "MEMORY";
        bool wanted = error || (!options_.quiet && (options_.verbose || warning));
        if (wanted)
            lines_.add(error     ? Severity::Error
                       : warning ? Severity::Warning
                                 : Severity::Info,
                       finding.code, finding.printed);
    }
    std::fputs(lines_.take().c_str(), stderr);
}

void PlayerFindings::summarize() {
    std::fputs(lines_.take_rest().c_str(), stderr);
}

int run_headless(const PlayOptions& options, Player& player) {
    PlayerFindings lines(options.scene.findings);
    player.wait_loaded(kPatience);
    lines.print(player);
    if (player.load_state() != LoadState::Ready) {
        lines.summarize();
        if (lines.lacks_assets()) return kExitMissingAsset;
        const int code = exit_code_of(player.error());
        return code != kExitOk ? code : int(kExitUnreadable);
    }
    int code = options.script.empty() ? int(kExitOk) : run_script(options, player);
    if (code == kExitOk && !options.screenshot.empty()) code = take_screenshots(options, player);
    lines.print(player);
    lines.summarize();
    if (lines.lacks_memory()) return kExitRetry;
    if (code == kExitOk && lines.lacks_assets()) return kExitMissingAsset;
    return code == kExitOk && lines.fails() ? int(kExitSomeFailed) : code;
}

}  // namespace kinora
