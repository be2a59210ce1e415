// runtime/player/actions_picture.cpp: how the picture is shown, and where it is saved.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/base/file_extension.h"
#include "runtime/base/files/temporary_file.h"
#include "runtime/player/core_p.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

constexpr double kMostStops = 60;
constexpr double kSaveSeconds = 3600;

CommandResult expose(PlayerCore& core, double stops) {
    core.state.picture.exposure = std::clamp(stops, -kMostStops, kMostStops);
    return {};
}

// The scene is read again with an option, of the request already. A session's options are the
// words, which then say the same: the new one stands for those that it replaces.
template <class F>
void open_with(PlayerCore& core, std::string word, F&& replaces) {
    std::erase_if(core.request.words, [&](const std::string& given) {
        return replaces(std::string_view(given).substr(0, given.find('=')));
    });
    core.request.words.push_back(std::move(word));
    core.open_again();
}

// The picture of the state as it is: without a clock refined where that is asked for.
std::shared_ptr<const Picture> picture_now(PlayerCore& core) {
    core.send_order();
    if (!core.setup.real_time) core.wait_for([&] { return core.idle(); }, kSaveSeconds);
    return core.loop.picture();
}

CommandResult written(PlayerCore& core, const std::string& file, const std::string& error) {
    if (!error.empty()) return refused(fmt::format("'{}' cannot be written: {}", file, error), 1);
    ++core.state.files_written;
    return {true, file, 0};
}

std::string save_shown(const Picture& picture, const std::string& file) {
    if (int number = make_folder_of(file)) return std::strerror(number);
    return write_png(file, {picture.width, picture.height, picture.rgba}, {});
}

std::string without_extension(const std::string& file) {
    return is_image_path(file) ? file.substr(0, file.rfind('.')) : file;
}

}  // namespace

CommandResult action_size(PlayerCore& core, const Arguments& a) {
    for (size_t k = 0; k < 2; ++k)
        if (!(a.number(k) >= 1 && a.number(k) <= 65536))
            return refused("a picture has 1 to 65536 pixels a side", k + 1);
    core.state.picture.width = int(a.number(0));
    core.state.picture.height = int(a.number(1));
    core.sized = true;
    return {};
}

CommandResult action_exposure(PlayerCore& core, const Arguments& a) {
    if (std::abs(a.number(0)) > kMostStops) return refused("exposure takes -60 to 60 stops", 1);
    return expose(core, a.number(0));
}
CommandResult action_brighter(PlayerCore& core, const Arguments&) {
    return expose(core, core.state.picture.exposure + 1.0 / 3);
}
CommandResult action_darker(PlayerCore& core, const Arguments&) {
    return expose(core, core.state.picture.exposure - 1.0 / 3);
}

CommandResult action_tone(PlayerCore& core, const Arguments& a) {
    ToneCurve& tone = core.state.picture.tone;
    std::string wanted = a.text_or(0, tone == ToneCurve::Plain ? "filmic" : "plain");
    if (wanted != "plain" && wanted != "filmic")
        return refused(unknown_name("tone curve", wanted, {"plain", "filmic"}), 1);
    tone = wanted == "plain" ? ToneCurve::Plain : ToneCurve::Filmic;
    return {};
}

CommandResult action_aov(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    const std::vector<std::string>& names = core.info->aovs;
    std::string& aov = core.state.picture.aov;
    auto found = std::ranges::find(names, a.text_or(0, aov));
    if (a.has(0) && found == names.end()) return refused(unknown_name("AOV", a.text(0), names), 1);
    if (!a.has(0) && (found == names.end() || ++found == names.end())) found = names.begin();
    aov = *found;
    return {};
}

CommandResult action_light(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    const std::vector<std::string>& lights = core.info->lights;
    std::string& light = core.state.picture.light;
    if (a.has(0)) {
        const bool all = a.text(0) == "all";
        if (!all && std::ranges::find(lights, a.text(0)) == lights.end())
            return refused(unknown_name("light", a.text(0), lights), 1);
        light = all ? "" : a.text(0);
        return {};
    }
    if (lights.empty()) return refused("the scene has no lights");
    auto at = light.empty() ? lights.begin() : std::ranges::find(lights, light);
    if (!light.empty() && at != lights.end()) ++at;
    light = at == lights.end() ? "" : *at;
    return {};
}

CommandResult action_false_color(PlayerCore& core, const Arguments&) {
    core.state.picture.false_color = !core.state.picture.false_color;
    return {};
}

CommandResult action_quality(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    // Of least quality: the quick picture stays, as while something moves.
    std::vector<std::string> names{"quick"};
    names.insert(names.end(), std::begin(kPresetNames), std::end(kPresetNames));
    PictureState& picture = core.state.picture;
    auto at = std::ranges::find(names, a.text_or(0, picture.refine ? picture.quality : "quick"));
    if (a.has(0) && at == names.end()) return refused(unknown_name("quality", a.text(0), names), 1);
    if (!a.has(0) && (at == names.end() || ++at == names.end())) at = names.begin();
    picture.refine = at != names.begin();
    if (!picture.refine || *at == picture.quality) return {};
    core.request.quality = *find_quality(*at);
    core.state.picture.quality = *at;
    open_with(core, "--quality=" + *at, [](std::string_view option) {
        return option == "--quality" || (option.starts_with("--") && find_knob(option.substr(2)));
    });
    return {};
}

CommandResult action_gi(PlayerCore& core, const Arguments& a) {
    constexpr double kMostBounces = 64;
    constexpr uint32_t kUsualBounces = 2;
    if (!core.info) return refused("there is no scene yet");
    const uint32_t before = core.request.gi;
    uint32_t bounces = before ? 0 : kUsualBounces;
    if (a.has(0)) {
        const double wanted = a.number(0);
        if (!(wanted >= 0 && wanted <= kMostBounces && wanted == std::floor(wanted)))
            return refused("gi takes 0 to 64 bounces", 1);
        bounces = uint32_t(wanted);
    }
    if (bounces == before) return {};
    core.request.gi = core.state.picture.bounces = bounces;
    open_with(core, fmt::format("--gi={}", bounces),
              [](std::string_view option) { return option == "--gi"; });
    return {};
}

CommandResult action_hold_rate(PlayerCore& core, const Arguments& a) {
    if (!(a.number(0) >= 1 && a.number(0) <= 240))
        return refused("hold_rate takes 1 to 240 pictures a second", 1);
    core.state.picture.hold_rate = a.number(0);
    return {};
}
CommandResult action_filter(PlayerCore& core, const Arguments&) {
    core.state.picture.filter = !core.state.picture.filter;
    return {};
}

CommandResult action_adapt(PlayerCore& core, const Arguments&) {
    core.state.picture.adapt = !core.state.picture.adapt;
    return {};
}
CommandResult action_refine(PlayerCore& core, const Arguments&) {
    core.state.picture.refine = !core.state.picture.refine;
    return {};
}

CommandResult action_keep(PlayerCore& core, const Arguments&) {
    std::shared_ptr<const Picture> picture = core.kept ? nullptr : picture_now(core);
    if (!core.kept && !picture) return refused("there is no picture yet");
    core.keep(std::move(picture));
    return {};
}

CommandResult action_wipe(PlayerCore& core, const Arguments& a) {
    if (!(a.number(0) >= 0 && a.number(0) <= 1)) return refused("wipe takes 0 to 1", 1);
    core.state.picture.wipe_at = a.number(0);
    return {};
}

CommandResult action_rays(PlayerCore& core, const Arguments&) {
    core.state.picture.rays = !core.state.picture.rays;
    return {};
}

CommandResult action_save_picture(PlayerCore& core, const Arguments& a) {
    std::shared_ptr<const Picture> picture = picture_now(core);
    if (!picture) return refused("there is no picture yet");
    std::string name = without_extension(
        a.text_or(0, fmt::format("kinora-play.{:04}", std::lround(picture->frame))));
    std::string error =
        write_image_and_folder(name + ".exr", picture->film, core.shown->encoding, {});
    if (error.empty()) error = save_shown(*picture, name + ".png");
    return written(core, name, error);
}

CommandResult action_screenshot(PlayerCore& core, const Arguments& a) {
    const std::string& file = a.text(0);
    if (!is_image_path(file)) return refused("a screenshot's name ends in .png or .exr", 1);
    std::shared_ptr<const Picture> picture = picture_now(core);
    if (!picture) return refused("there is no picture yet");
    return written(core, file,
                   has_extension(file, {".exr"})
                       ? write_image_and_folder(file, picture->film, core.shown->encoding, {})
                       : save_shown(*picture, file));
}

}  // namespace kinora
