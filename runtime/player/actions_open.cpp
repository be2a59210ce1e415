// runtime/player/actions_open.cpp: other scenes, and sessions: what is shown, to be shown
// elsewhere.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/base/file_extension.h"
#include "runtime/player/core_p.h"

namespace kinora {

namespace {

bool is_session(const std::string& file) {
    return has_extension(file, {".kinora"});
}

// Names of the scene before.
constexpr std::string_view kOfTheScene[] = {
    "--camera=", "--clip=", "--shader=", "--param=", "--hide=", "--only="};

void forget_names(SceneRequest& request) {
    request.camera.clear();
    request.clip.clear();
    request.shaders.clear();
    request.params.clear();
    request.hide.clear();
    request.only.clear();
    std::erase_if(request.words, [](const std::string& word) {
        return std::ranges::any_of(
            kOfTheScene, [&](std::string_view option) { return word.starts_with(option); });
    });
}

// The options as they are by now.
std::vector<std::string> options_of(const PlayerCore& core) {
    std::vector<std::string> words = core.request.words;
    std::erase_if(words, [](const std::string& word) { return word.starts_with("--clip="); });
    if (!core.request.clip.empty()) words.push_back("--clip=" + core.request.clip);
    return words;
}

// What the player alone has, as lines that set it.
std::vector<std::string> lines_of(const PlayerState& state, const ShaderDocument& document) {
    std::vector<std::string> lines;
    auto line = [&](bool wanted, std::string_view word, const std::string& text = "") {
        if (wanted)
            lines.push_back(text.empty() ? std::string(word)
                                         : fmt::format("{} {}", word, quoted(text)));
    };
    constexpr const char* kLoops[] = {"loop", "pingpong", "once"};
    const TimeState& time = state.time;
    auto end = [&](const char* word, const std::optional<double>& frame) {
        if (!frame) return;
        line(true, "seek", fmt::format("{}", *frame));
        line(true, word);
    };
    end("in", time.in);
    end("out", time.out);
    if (time.in || time.out) line(true, "seek", fmt::format("{}", time.frame));
    line(time.loop != LoopMode::Loop, "loop", kLoops[size_t(time.loop)]);
    line(time.speed != 1, "speed", fmt::format("{}", time.speed));
    line(time.every_frame, "every_frame");
    line(state.camera.locked, "camera_lock");
    line(state.camera.turntable, "turntable");
    const PictureState &picture = state.picture, plain;
    line(picture.tone == ToneCurve::Filmic, "tone", "filmic");
    line(!picture.aov.empty(), "aov", picture.aov);
    line(picture.false_color, "false_color");
    line(!picture.light.empty(), "light", picture.light);
    line(picture.wipe_at != plain.wipe_at, "wipe", fmt::format("{}", picture.wipe_at));
    line(picture.hold_rate != plain.hold_rate, "hold_rate", fmt::format("{}", picture.hold_rate));
    line(!picture.adapt, "adapt");
    line(!picture.filter, "filter");
    line(!picture.refine, "refine");
    line(!state.selection.node.empty(), "select", state.selection.node);
    line(!document.material.empty(), "select_material", document.material);
    line(!document.material.empty(), "edit");
    line(!state.selection.material.empty(), "select_material", state.selection.material);
    return lines;
}

Session session_of(const PlayerCore& core) {
    const PlayerState& state = core.state;
    Session session;
    session.scene = core.request.scene;
    session.options = options_of(core);
    session.frame = state.time.frame;
    session.width = state.picture.width;
    session.height = state.picture.height;
    session.exposure = state.picture.exposure;
    SessionCamera& camera = session.camera;
    camera.index = state.camera.index;
    if (camera.index < core.info->cameras.size()) camera.name = core.info->cameras[camera.index];
    if (state.camera.free) camera.own = state.camera.own;
    if (state.camera.free && !state.camera.follow.empty())
        camera.follow = {state.camera.follow, core.follow_from};
    session.edits = core.edits;
    session.panels = state.panels;
    session.commands = lines_of(state, core.document);
    if (const Picture* kept = core.kept.get())
        session.kept = {{kept->width, kept->height, kept->rgba}, kept->frame};
    return session;
}

}  // namespace

CommandResult action_open(PlayerCore& core, const Arguments& a) {
    const std::string& file = a.text(0);
    if (is_session(file)) {
        std::string error = "sessions cannot be opened here";
        std::optional<OpenedSession> opened;
        if (core.setup.read_session) opened = core.setup.read_session(file, error);
        if (!opened) return refused(error, 1);
        opened->request.threads = core.request.threads;
        opened->request.target = core.request.target;
        opened->request.strict = core.request.strict;
        core.open(opened->request, std::move(opened->session));
        return {};
    }
    SceneRequest request = core.request;
    request.scene = file;
    forget_names(request);
    core.open(request, std::nullopt);
    return {};
}

CommandResult action_save_session(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    std::string file = a.text_or(0, "");
    if (file.empty()) {
        std::string name = core.request.scene.substr(core.request.scene.rfind('/') + 1);
        file = name.substr(0, name.rfind('.')) + ".kinora";
    }
    if (!is_session(file)) return refused("a session's name ends in .kinora", 1);
    std::string error = write_session(file, session_of(core));
    if (!error.empty())
        return refused(fmt::format("'{}' cannot be written: {}", file, error), a.count());
    ++core.state.files_written;
    return {true, file, 0};
}

}  // namespace kinora
