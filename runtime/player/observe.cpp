// runtime/player/observe.cpp: what commands change, as texts that can be compared.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "runtime/player/core_p.h"
#include "runtime/player/pixel/pixel_story.h"
#include "runtime/player/player.h"

namespace kinora {

namespace {

std::string text_of(dvec3 v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}

std::string text_of(const CameraState& camera) {
    std::string text =
        fmt::format("scene camera {}, {}, {}, turntable {}, follows '{}'", camera.index,
                    camera.free ? "free" : "its own", camera.locked ? "locked" : "open",
                    camera.turntable, camera.follow);
    if (!camera.free) return text;
    const FreeCamera& own = camera.own;
    return text + fmt::format("; eye {}, pivot {}, up {}, back {}, {} {}", text_of(own.eye()),
                              text_of(own.pivot), text_of(own.axes[1]), text_of(own.axes[2]),
                              own.parallel ? "parallel" : "perspective", own.half_height);
}

std::string text_of(const TimeState& time) {
    auto end = [](const std::optional<double>& frame) {
        return frame ? fmt::format("{}", *frame) : std::string("none");
    };
    return fmt::format("{} at {} times, in {}, out {}, loop mode {}, every frame {}, clip '{}'",
                       time.playing ? "plays" : "stands", time.speed, end(time.in), end(time.out),
                       int(time.loop), time.every_frame, time.clip);
}

std::string text_of(const PictureState& p) {
    return fmt::format(
        "{}x{}, {} stops, tone {}, aov '{}', false color {}, {} a second, adapts {}, filters {}, "
        "refines {}, "
        "wipe '{}' at {}, light '{}', quality '{}', indirect light {}, rays {}",
        p.width, p.height, p.exposure, int(p.tone), p.aov, p.false_color, p.hold_rate, p.adapt,
        p.filter, p.refine, p.wipe, p.wipe_at, p.light, p.quality, p.bounces, p.rays);
}

std::string text_of(const Selection& selection) {
    std::string text = fmt::format("node '{}', material '{}'", selection.node, selection.material);
    if (selection.pixel)
        text += fmt::format(", pixel {} {} {}", selection.pixel->x, selection.pixel->y,
                            selection.pixel->hit);
    return text;
}

std::string text_of(const SceneEdits& edits) {
    std::string text;
    for (const auto& [material, shader] : edits.shaders)
        text += fmt::format("shader {} {}\n", material, shader);
    for (const SceneEdits::Text& edit : edits.texts)
        text += fmt::format("text {} {}\n", edit.material, edit.text);
    for (const auto& [target, value] : edits.params)
        text += fmt::format("param {} {}\n", target, value);
    for (const std::string& node : edits.hidden) text += fmt::format("hidden {}\n", node);
    return text;
}

}  // namespace

std::string PlayerCore::observe(Observable what) const {
    switch (what) {
        case Observable::Camera:
            return text_of(state.camera);
        case Observable::Time:
            return fmt::format("frame {}", state.time.frame);
        case Observable::Playback:
            return text_of(state.time);
        case Observable::Picture:
            return text_of(state.picture);
        case Observable::Selection:
            return text_of(state.selection);
        case Observable::Shader:
            return fmt::format("material '{}', caret {}, {}dirty: {}", document.material,
                               document.caret, document.dirty ? "" : "not ", document.text);
        case Observable::Scene:
            return info ? fmt::format("scene {} of {}", info->serial, info->path)
                        : std::string("none");
        case Observable::Panels:
            return fmt::format("{}", fmt::join(state.panels, " "));
        case Observable::File:
            return fmt::format("{} files", state.files_written);
        case Observable::Quit:
            return state.quit ? "ends" : "goes on";
    }
    return "";
}

std::string Player::observe(Observable what) const {
    return core_->observe(what);
}

std::string PlayerCore::state_json() const {
    std::string out = "{";
    for (const ObservableRow& row : observables())
        out += fmt::format("\n  \"{}\": {},", row.name, json_text(observe(row.what)));
    return out + fmt::format("\n  \"edits\": {}\n}}\n", json_text(text_of(edits)));
}

}  // namespace kinora
