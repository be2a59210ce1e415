// runtime/player/actions_time.cpp: what plays, and what frame is shown.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "runtime/player/clock.h"
#include "runtime/player/core_p.h"

namespace kinora {

namespace {

constexpr double kFastest = 64;
constexpr double kFurthest = 1e9;  // frames

// Frames are whole again where nothing plays, so that they are those of kinora-render.
void stop(TimeState& time) {
    time.playing = false;
    time.frame = std::clamp(whole_frame(time, time.frame), std::floor(range_first(time)),
                            std::ceil(range_last(time)));
}

// What lies between two frames of a film is for playback alone.
void go_to(TimeState& time, double frame) {
    time.frame = std::clamp(frame, -kFurthest, kFurthest);
    if (time.film)
        time.frame = std::clamp(time.playing ? frame : whole_frame(time, frame), time.first,
                                std::max(time.last + 1 - 1e-9, time.first));
}

void step(TimeState& time, double frames) {
    bool playing = time.playing;
    stop(time);
    double first = place_of(time, range_first(time)), last = place_of(time, range_last(time));
    double to = place_of(time, time.frame) + frames;
    if (to > last) to = time.loop == LoopMode::Loop && !playing ? first : last;
    if (to < first) to = time.loop == LoopMode::Loop && !playing ? last : first;
    go_to(time, frame_at(time, to));
}

CommandResult play_towards(TimeState& time, double direction) {
    bool faster = time.playing && time.speed * direction > 0;
    time.speed = faster ? std::clamp(2 * time.speed, -kFastest, kFastest) : direction;
    time.playing = true;
    return {};
}

// "12" a frame; "0.5s" seconds.
std::optional<double> frame_of(const std::string& text, double rate) {
    double value = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    std::string_view rest(end, size_t(text.data() + text.size() - end));
    if (error != std::errc() || !std::isfinite(value) || !(rest.empty() || rest == "s"))
        return std::nullopt;
    return rest == "s" ? value * rate : value;
}

}  // namespace

CommandResult action_play(PlayerCore& core, const Arguments& a) {
    TimeState& time = core.state.time;
    std::string wanted = a.text_or(0, time.playing ? "off" : "on");
    if (wanted != "on" && wanted != "off") return refused("play takes on or off", 1);
    if (wanted == "off") {
        stop(time);
        return {};
    }
    if (time.loop == LoopMode::Once && !time.playing) {
        bool at_end =
            time.speed > 0 ? time.frame >= range_last(time) : time.frame <= range_first(time);
        if (at_end) time.frame = time.speed > 0 ? range_first(time) : range_last(time);
    }
    time.playing = true;
    return {};
}

CommandResult action_backward(PlayerCore& core, const Arguments&) {
    return play_towards(core.state.time, -1);
}
CommandResult action_forward(PlayerCore& core, const Arguments&) {
    return play_towards(core.state.time, 1);
}
CommandResult action_pause(PlayerCore& core, const Arguments&) {
    stop(core.state.time);
    core.state.time.speed = 1;
    return {};
}
CommandResult action_next(PlayerCore& core, const Arguments&) {
    step(core.state.time, 1);
    return {};
}
CommandResult action_previous(PlayerCore& core, const Arguments&) {
    step(core.state.time, -1);
    return {};
}

CommandResult action_next_key(PlayerCore& core, const Arguments&) {
    if (!core.info) return refused("there is no scene yet");
    TimeState& time = core.state.time;
    stop(time);
    for (double key : core.info->keys)
        if (key > time.frame + 1e-6) {
            go_to(time, key);
            return {};
        }
    return refused("there is no key behind this frame");
}

CommandResult action_previous_key(PlayerCore& core, const Arguments&) {
    if (!core.info) return refused("there is no scene yet");
    TimeState& time = core.state.time;
    stop(time);
    const std::vector<double>& keys = core.info->keys;
    for (auto key = keys.rbegin(); key != keys.rend(); ++key)
        if (*key < time.frame - 1e-6) {
            go_to(time, *key);
            return {};
        }
    return refused("there is no key before this frame");
}

CommandResult action_first(PlayerCore& core, const Arguments&) {
    stop(core.state.time);
    go_to(core.state.time, range_first(core.state.time));
    return {};
}
CommandResult action_last(PlayerCore& core, const Arguments&) {
    stop(core.state.time);
    go_to(core.state.time, range_last(core.state.time));
    return {};
}

CommandResult action_seek(PlayerCore& core, const Arguments& a) {
    std::optional<double> frame = frame_of(a.text(0), core.info ? core.info->frame_rate : 24);
    if (!frame) return refused("seek takes a frame (12) or seconds (0.5s)", 1);
    go_to(core.state.time, *frame);
    return {};
}

CommandResult action_in(PlayerCore& core, const Arguments&) {
    TimeState& time = core.state.time;
    double here = whole_frame(time, time.frame);
    time.in = time.in == here ? std::nullopt : std::optional(here);
    return {};
}
CommandResult action_out(PlayerCore& core, const Arguments&) {
    TimeState& time = core.state.time;
    double here = whole_frame(time, time.frame);
    time.out = time.out == here ? std::nullopt : std::optional(here);
    return {};
}

CommandResult action_loop(PlayerCore& core, const Arguments& a) {
    const std::vector<std::string> names{"loop", "pingpong", "once"};
    TimeState& time = core.state.time;
    if (!a.has(0)) {
        time.loop = LoopMode((int(time.loop) + 1) % int(names.size()));
        return {};
    }
    auto found = std::ranges::find(names, a.text(0));
    if (found == names.end()) return refused(unknown_name("loop mode", a.text(0), names), 1);
    time.loop = LoopMode(found - names.begin());
    return {};
}

CommandResult action_speed(PlayerCore& core, const Arguments& a) {
    double speed = a.number(0);
    if (speed == 0 || std::abs(speed) > kFastest)
        return refused("speed takes -64 to 64, but not 0", 1);
    core.state.time.speed = speed;
    return {};
}

CommandResult action_every_frame(PlayerCore& core, const Arguments&) {
    core.state.time.every_frame = !core.state.time.every_frame;
    return {};
}

CommandResult action_clip(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    std::vector<std::string> names;
    for (const ClipInfo& clip : core.info->clips) names.push_back(clip.name);
    std::string wanted;
    if (a.has(0)) {
        wanted = a.text(0);
        if (std::ranges::find(names, wanted) == names.end())
            for (const ClipInfo& clip : core.info->clips)
                if (clip.id == wanted) wanted = clip.name;
        if (!wanted.empty() && std::ranges::find(names, wanted) == names.end())
            return refused(unknown_name("clip", wanted, names), 1);
    } else {
        auto now = std::ranges::find(names, core.state.time.clip);
        size_t next = now == names.end() ? 0 : size_t(now - names.begin()) + 1;
        if (next < names.size()) wanted = names[next];
    }
    if (names.empty()) return refused("the scene has no clips");
    core.state.time.clip = wanted;
    core.request.clip = wanted;
    core.state.time.in.reset();
    core.state.time.out.reset();
    core.open_again();
    return {};
}

}  // namespace kinora
