// runtime/player/core.cpp: between the state and the threads.
#include "runtime/player/core_p.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "runtime/picture/explain/explain.h"
#include "runtime/player/clock.h"
#include "runtime/player/picture/guide.h"
#include "runtime/player/pixel/pixel_story.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

constexpr size_t kMostFindings = 1000;
constexpr size_t kMostUndo = 200;
constexpr double kAnswerSeconds = 600;

// Other threads run kernels from here on.
PlayerSetup prepared(PlayerSetup setup) {
    prepare_stories();
    return setup;
}

bool same(const FindingText& a, const FindingText& b) {
    return a.code == b.code && a.message == b.message && a.file == b.file && a.begin == b.begin;
}

void add_new(std::vector<FindingText>& to, const std::vector<FindingText>& from) {
    for (const FindingText& finding : from) {
        bool known = std::ranges::any_of(to, [&](const auto& f) { return same(f, finding); });
        if (!known && to.size() < kMostFindings) to.push_back(finding);
    }
}

// A camera moved by hand stays where it is in the file's world; where that has no place for it, the
// file's camera is back.
void keep_place(CameraState& camera, dvec3& follow_from, const ShownScene& before,
                const ShownScene& now) {
    if (!camera.free) return;
    const dmat4 moves =
        now.scene->description->world_space * glm::inverse(before.scene->description->world_space);
    if (const std::optional<FreeCamera> own = moved(camera.own, moves)) {
        camera.own = *own;
        follow_from = dvec3(moves * dvec4(follow_from, 1));
        return;
    }
    camera.free = camera.turntable = false;
    camera.follow.clear();
}

// Where the camera looks: as far as the middle of the scene, seen along its way.
double distance_to(const SceneInfo& info, const Picture& picture) {
    dvec3 eye = picture.origin + picture.view.eye, middle = 0.5 * (info.low + info.high);
    double along = glm::dot(middle - eye, picture.view.forward);
    double size = glm::length(info.high - info.low);
    return along > 0.05 * size ? along : std::max(size, 1e-6);
}

}  // namespace

PlayerCore::PlayerCore(PlayerSetup player_setup)
    : setup(prepared(std::move(player_setup))),
      watch([this] {
          {
              std::lock_guard lock(wake_mutex);
              files_changed = true;
          }
          wake();
      }),
      loop(setup.real_time, [this] { wake(); }),
      maker([this] { wake(); }, setup.real_time, setup.shows_broken),
      inspector([this] { wake(); }),
      thumbnails([this] { wake(); }),
      board([this] { wake(); }) {}

void PlayerCore::wake() {
    {
        std::lock_guard lock(wake_mutex);
        news = true;
    }
    woken.notify_all();
    if (setup.wake) setup.wake();
}

bool PlayerCore::wait_for(const std::function<bool()>& reached, double seconds) {
    auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (true) {
        take_news();
        if (reached()) {
            watch_images();
            return true;
        }
        std::unique_lock lock(wake_mutex);
        if (!woken.wait_until(lock, end, [&] { return news; })) return false;
        news = false;
    }
}

void PlayerCore::take_news() {
    while (auto made = maker.take()) take_scene(std::move(made));
    for (const Answer& answer : inspector.take()) answer();
    color_pick();
    add_new(frame_findings, loop.take_findings());
    note_stop();
    watch_images();
    bool reload = false;
    {
        std::lock_guard lock(wake_mutex);
        std::swap(reload, files_changed);
    }
    if (reload && setup.watch_files && !maker.opening()) {
        forget_stops();
        open_again();
    }
    merge_findings();
}

// Images that shaders name are read when a picture asks for them.
void PlayerCore::watch_images() {
    if (!textures || textures->images() == images_watched) return;
    images_watched = textures->images();
    textures->each_image([&](const StoredImage& image) {
        if (std::ranges::find(files, image.file) == files.end()) files.push_back(image.file);
    });
    watch.watch(files);
}

constexpr int kQuickRank = 0;  // presets come behind it

// The picture shown as a stop of the slider, if it is one.
void PlayerCore::note_stop() {
    if (std::ranges::find(state.panels, "quality") == state.panels.end()) return forget_stops();
    const ViewOrder view = view_order();
    if (!board_view || !board_view->same_picture(view) || !(board_edits == edits)) {
        board.clear();
        board_view = view;
        board_edits = edits;
    }
    state.picture.stops = board.stops();
    const std::string& quality = state.picture.quality;
    const auto picture = loop.picture();
    if (!picture || picture->serial == noted || state.time.playing) return;
    if (!maker.idle() || !loop.caught_up()) return;
    // Of one sample a pixel, the quick one is refined as well.
    const bool refined =
        state.picture.refine && picture->refined && loop.idle() && !quality.empty();
    if (!refined && !picture->quick) return;
    noted = picture->serial;
    int rank = kQuickRank;
    if (refined)
        rank = 1 + int(std::ranges::find(kPresetNames, quality) - std::begin(kPresetNames));
    std::shared_ptr<const raytrace::Film> film(picture, &picture->film);
    if (film->width != picture->width || film->height != picture->height) {
        auto large = std::make_shared<raytrace::Film>();
        enlarge(*film, picture->guide, picture->width, picture->height, *large);
        film = std::move(large);
    }
    board.add(refined ? quality : "quick", rank, picture->ms, std::move(film));
    state.picture.stops = board.stops();
}

void PlayerCore::forget_stops() {
    if (!board_view) return;
    board.clear();
    board_view.reset();
    noted = 0;
    state.picture.stops.clear();
}

void PlayerCore::take_scene(std::unique_ptr<MadeScene> made) {
    if (made->finer) {  // what a later text is told stays
        add_new(scene_findings, made->findings);
    } else {
        scene_findings = made->findings;
        take_text(*made);
        error = made->error;
    }
    if (!made->files.empty()) watch.watch(files = made->files);
    if (made->swapped) return take_swap(*made);
    if (!made->shown) {
        if (!info) load = LoadState::Failed;
        if (made->replaces_camera) keep_scene();
        return;  // the last good scene stays
    }
    const std::shared_ptr<const SceneInfo> before = info;
    const std::shared_ptr<const ShownScene> shown_before = shown;
    bool first = !before || made->replaces_camera;
    if (made->replaces_camera) changes_before.reset();
    info = made->info;
    shown = made->shown;
    inspector.keep(shown);
    picked_in.reset();
    textures = shown->scene->textures;
    images_watched = 0;
    request = shown->request;
    if (first) document = {};
    for (const MaterialInfo& material : info->materials)
        if (material.id == document.material) document.params = material.params;
    load = LoadState::Ready;
    frame_findings.clear();
    if (std::ranges::find(info->lights, state.picture.light) == info->lights.end())
        state.picture.light.clear();
    state.picture.bounces = request.gi;
    state.picture.quality.clear();
    for (const Quality& preset : qualities())
        if (knob_texts(preset) == knob_texts(request.quality)) state.picture.quality = preset.name;
    if (!sized && (first || info->film)) {
        state.picture.width = shown->settings.width;
        state.picture.height = shown->settings.height;
    }
    if (first)
        begin_scene(*made);
    else
        go_on_in(*before, *shown_before);
    loop.show(std::move(made), view_order(), display_settings());
    send_order();
}

void PlayerCore::begin_scene(MadeScene& made) {
    state.camera = {};
    state.camera.index = info->camera;
    state.time = {};
    state.time.first = info->first;
    state.time.last = info->last;
    state.time.film = info->film;
    state.time.frame = info->film ? info->number() : info->first;
    state.time.clip = request.clip;
    film_frame = info->film_frame;
    state.selection = {};
    const std::optional<StartTime> begins = std::exchange(start, std::nullopt);
    if (begins && !info->film) state.time.frame = begins->frame(info->frame_rate);
    if (std::optional<Session> taken = std::exchange(session, std::nullopt))
        take_session(*taken, made);
}

// The same scene, or the next frame of its film: what the user has chosen stays.
void PlayerCore::go_on_in(const SceneInfo& before, const ShownScene& seen_before) {
    CameraState& camera = state.camera;
    camera.index = camera.index == before.camera
                       ? info->camera
                       : std::min(camera.index, uint32_t(info->cameras.size() - 1));
    if (before.film && info->film) keep_place(camera, follow_from, seen_before, *shown);
    TimeState& time = state.time;
    time.first = info->first;
    time.last = info->last;
    if (time.film == info->film) {
        if (!time.film) time.frame = std::clamp(time.frame, time.first, time.last);
        return;
    }
    time.film = info->film;
    film_frame = info->film_frame;
    time.frame =
        time.film ? whole_frame(time, time.frame) : std::clamp(time.frame, time.first, time.last);
}

// The scene stays; its shaders are others.
void PlayerCore::take_swap(MadeScene& made) {
    info = made.info;
    shown = made.shown;
    for (const MaterialInfo& material : info->materials)
        if (material.id == document.material) document.params = material.params;
    frame_findings.clear();
    loop.swap(shown);
    send_order();
}

void PlayerCore::open(const SceneRequest& scene, std::optional<Session> with,
                      std::optional<StartTime> from) {
    if (!info) load = LoadState::Loading;
    if (info && !changes_before) changes_before = {edits, undo, redo};
    edits = with ? with->edits : SceneEdits{};
    for (SceneEdits::Text& text : edits.texts) text.version = ++document.version;
    undo.clear();
    redo.clear();
    start = from;
    if (with && !from) from = StartTime{with->frame};
    session = std::move(with);
    forget_stops();
    maker.open(scene, edits, true, from);
}

void PlayerCore::keep_scene() {
    session.reset();
    start.reset();
    if (!changes_before) return;
    edits = std::move(changes_before->edits);
    undo = std::move(changes_before->undo);
    redo = std::move(changes_before->redo);
    changes_before.reset();
}

bool PlayerCore::cancel_open() {
    if (!setup.real_time || !maker.cancel()) return false;
    if (!info) load = LoadState::Nothing;
    keep_scene();
    return true;
}

std::optional<Awaited> PlayerCore::ordered() const {
    if (!maker.idle()) return std::nullopt;
    return Awaited{loop.ordered(), inspector.asked()};
}

bool PlayerCore::picture_ready(const Awaited& of) const {
    return loop.has_made(of.pictures) && inspector.has_answered(of.questions) &&
           (loop.picture() || loop.idle());
}

// What a new scene begins with instead of its own beginning.
void PlayerCore::take_session(const Session& taken, MadeScene& made) {
    choose_camera(*shown->scene, *made.pose, taken.camera);
    state.camera.index = made.pose->camera;
    if (taken.camera.own) {
        state.camera.own = *taken.camera.own;
        state.camera.free = true;
    }
    if (taken.camera.follow) std::tie(state.camera.follow, follow_from) = *taken.camera.follow;
    state.time.frame = taken.frame;
    state.picture.exposure = taken.exposure;
    if (taken.width > 0 && taken.height > 0) {
        state.picture.width = taken.width;
        state.picture.height = taken.height;
        sized = true;
    }
    state.panels = taken.panels;
    if (taken.kept) {
        auto picture = std::make_shared<Picture>();
        picture->width = taken.kept->image.width;
        picture->height = taken.kept->image.height;
        picture->rgba = taken.kept->image.rgba;
        picture->frame = taken.kept->frame;
        keep(std::move(picture));
    }
    for (const std::string& line : taken.commands) {
        Words words = split_words(line);
        const Command* command = words.texts.empty() ? nullptr : find_command(words.texts.front());
        if (!command) continue;  // of a newer Kinora
        words.texts.erase(words.texts.begin());
        act(size_t(command - commands().data()), words.texts);
    }
}

// Left of the wipe from now on.
void PlayerCore::keep(std::shared_ptr<const Picture> picture) {
    kept = std::move(picture);
    state.picture.wipe = kept ? fmt::format("frame {:g}", kept->frame) : "";
}

// What has become of the edited text.
void PlayerCore::take_text(const MadeScene& made) {
    for (const SceneEdits::Text& text : made.edits.texts) {
        if (text.material != document.wearer || text.version == 0) continue;
        document.compiling = text.version != document.version;
        document.compile_ms = made.build_ms;
        if (made.shown) document.shown = text.version;
        document.findings.clear();
        for (const FindingText& finding : made.findings)
            if (finding.file == document.name) document.findings.push_back(finding);
    }
}

// After undo: the text is what the edits say, or as it was read.
void PlayerCore::restore_text() {
    typing = false;
    dragged.clear();
    if (document.material.empty() || !info) return;
    std::string text, as_read;
    document.compiling = false;
    document.shown = document.version;
    for (const MaterialInfo& material : info->materials)
        if (material.id == document.material && material.source) as_read = material.source->text;
    text = as_read;
    for (const SceneEdits::Text& edit : edits.texts)
        if (edit.material == document.wearer) text = edit.text;
    document.dirty = text != as_read;
    if (text == document.text) return;
    document.text = text;
    ++document.version;
    document.caret = std::min(document.caret, text.size());
    document.findings.clear();
    document.shown = document.version;
    for (SceneEdits::Text& edit : edits.texts)
        if (edit.material == document.wearer) edit.version = document.version;
}

void PlayerCore::merge_findings() {
    all_findings.clear();
    add_new(all_findings, document.findings);
    add_new(all_findings, scene_findings);
    add_new(all_findings, frame_findings);
}

ViewOrder PlayerCore::view_order() const {
    ViewOrder order;
    // A film's frame is ordered when it is there; until then the picture before it stays.
    order.frame = info && info->film ? info->number() : state.time.frame;
    if (state.camera.free) {
        order.camera = state.camera.own;
        if (!state.camera.follow.empty()) order.follow = {state.camera.follow, follow_from};
    }
    order.camera_index = state.camera.index;
    if (info)
        if (auto at = std::ranges::find(info->lights, state.picture.light);
            at != info->lights.end())
            order.only_light = uint32_t(at - info->lights.begin());
    order.width = state.picture.width;
    order.height = state.picture.height;
    order.exposure = state.picture.exposure;
    order.playing = state.time.playing;
    order.refine = state.picture.refine;
    order.adapt = state.picture.adapt;
    order.filter = state.picture.filter;
    order.hold_rate = state.picture.hold_rate;
    return order;
}

DisplaySettings PlayerCore::display_settings() const {
    DisplaySettings display;
    display.tone = state.picture.tone;
    display.aov = state.picture.aov;
    display.false_color = state.picture.false_color;
    if (shown) display.encoding = shown->encoding;
    display.kept = kept;
    display.wipe_at = state.picture.wipe_at;
    if (state.picture.rays) display.rays = state.selection.story;
    return display;
}

void PlayerCore::send_order() {
    if (!info) return;
    follow_film();
    loop.order(view_order(), display_settings());
    order_thumbnails();
    const bool open = std::ranges::find(state.panels, "explained") != state.panels.end();
    if (open && std::exchange(explained_serial, info->serial) != info->serial) explain_scene();
}

// The time may be in another frame of the film than the one that was ordered last.
void PlayerCore::follow_film() {
    if (!info->film || maker.opening()) return;
    const size_t wanted = info->film->at(state.time.frame);
    if (std::exchange(film_frame, wanted) != wanted)
        maker.show_frame(request, edits, state.time.frame);
}

bool PlayerCore::shows_frame() const {
    return !info || !info->film || maker.idle();
}

void PlayerCore::await_frame() {
    if (!setup.real_time) wait_for([this] { return shows_frame(); }, kAnswerSeconds);
}

// The rows come with take_news().
void PlayerCore::explain_scene() {
    std::string preset(kDefaultQuality);
    for (const std::string& word : request.words)
        if (word.starts_with("--quality=")) preset = word.substr(word.find('=') + 1);
    const auto look = [this, preset](Inspected& inspected) -> Answer {
        auto rows = std::make_shared<const std::vector<Explained>>(
            explain(inspected.scene, inspected.pose, inspected.shown.request.quality, preset));
        return [this, rows] { state.explained = rows; };
    };
    inspector.add({shown, shown->scene, view_order(), true, look});
}

// While the panel is open: our shaders on the selected object, or on the first that wears the
// material.
void PlayerCore::order_thumbnails() {
    const Selection& selection = state.selection;
    const bool open = std::ranges::find(state.panels, "library") != state.panels.end();
    if (!open || selection.material.empty()) return thumbnails.forget();
    auto wears = [&](const NodeInfo& node) {
        return std::ranges::find(node.materials, selection.material) != node.materials.end();
    };
    auto object = std::ranges::find_if(info->nodes, [&](const NodeInfo& node) {
        return node.path == selection.node && wears(node);
    });
    if (object == info->nodes.end()) object = std::ranges::find_if(info->nodes, wears);
    if (object == info->nodes.end()) return thumbnails.forget();
    thumbnails.order({shown, request.scene, selection.material, object->path, view_order()});
}

ViewOrder PlayerCore::seen_order() const {
    // Without a clock it must not matter which picture is ready.
    if (!setup.real_time || !state.time.playing) return view_order();
    const PictureSource source = loop.source();
    return source.shown == shown ? source.order : view_order();
}

void PlayerCore::inspect(bool poses, std::function<Answer(Inspected&)> look) {
    send_order();
    const PictureSource source = loop.source();
    const auto& scene = source.shown == shown ? source.scene : shown->scene;
    inspector.add({shown, scene, seen_order(), poses, std::move(look)});
    if (!setup.real_time) wait_for([&] { return inspector.has_answered(); }, kAnswerSeconds);
}

void PlayerCore::color_pick() {
    std::optional<PickedPixel>& pixel = state.selection.pixel;
    if (!picked_in || !pixel) return;
    const PictureSource source = loop.source();
    if (source.shown != shown || !source.order.same_picture(*picked_in)) return;
    pixel->color = color_at(*source.picture, pixel->x, pixel->y);
    picked_in.reset();
}

FreeCamera* PlayerCore::own_camera(std::string& why_not) {
    CameraState& camera = state.camera;
    if (camera.locked && !camera.free) {
        why_not = "the camera is locked; camera_lock frees it";
        return nullptr;
    }
    if (camera.free) return &camera.own;
    if (!info) {
        why_not = "there is no scene yet";
        return nullptr;
    }
    std::shared_ptr<const Picture> seen = loop.picture();
    Picture posed;
    if (!setup.real_time) {
        // Where the camera is at this time, without a picture of it.
        inspect(false, [this](Inspected& inspected) -> Answer {
            const double time = time_of(inspected.shown, inspected.order);
            const std::optional<raytrace::Camera> view =
                view_of(inspected.scene, inspected.pose, inspected.order, time);
            return [this, view, origin = inspected.scene.origin] {
                if (view) answered_view = {*view, origin};
            };
        });
        if (answered_view) {
            posed.view = answered_view->first;
            posed.origin = answered_view->second;
            answered_view.reset();
            seen = std::make_shared<Picture>(std::move(posed));
        }
    }
    if (!seen) {
        why_not = "there is no picture yet";
        return nullptr;
    }
    camera.own = free_camera_of(seen->view, seen->origin, distance_to(*info, *seen));
    camera.free = true;
    if (setup.real_time) taken_camera = camera_text(camera.own);
    return &camera.own;
}

// What a clock or a late picture has decided is written with all digits, so that the lines lead to
// the same state.
void PlayerCore::record_line(const Command& command, const std::vector<std::string>& arguments,
                             const TimeState& before, const std::string& turned) {
    if (!record.is_open()) return;
    if (since_recorded >= 1e-3) record << fmt::format("wait {}\n", since_recorded);
    since_recorded = 0;
    if (before.playing) record << fmt::format("seek {}\n", before.frame);
    const std::string taken = std::exchange(taken_camera, {});
    if (!taken.empty() || !turned.empty())
        record << "stand " << quoted(taken.empty() ? turned : taken) << '\n';
    record << command.word;
    for (const std::string& argument : arguments) record << ' ' << quoted(argument);
    record << std::endl;
}

void PlayerCore::change_scene(SceneEdits changed) {
    undo.push_back(edits);
    if (undo.size() > kMostUndo) undo.erase(undo.begin());
    redo.clear();
    dragged.clear();
    edits = std::move(changed);
    rebuild();
}

void PlayerCore::show_panel(const std::string& name) {
    if (std::ranges::find(state.panels, name) == state.panels.end()) state.panels.push_back(name);
    state.raised = {name, state.raised.times + 1};
}

}  // namespace kinora
