// runtime/player/scene_maker.cpp: orders to scenes, the last order first.
#include "runtime/player/scene_maker.h"

#include <algorithm>
#include <new>
#include <utility>

#include "jit/compiler.h"
#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {

namespace {

// Pixels that an edge of a coarse scene has, and how long nobody minds to wait for a finer one.
constexpr double kCoarseDice = 4;
constexpr double kFastDiceMs = 250;

}  // namespace

SceneMaker::SceneMaker(std::function<void()> done, bool hurries, bool shows_broken)
    : done_(std::move(done)),
      hurries_(hurries),
      shows_broken_(shows_broken),
      thread_([this] { run(); }) {}

SceneMaker::~SceneMaker() {
    {
        std::lock_guard lock(mutex_);
        quit_ = overtaken_ = true;
        stop_maps_ = 1;
        order_.reset();
    }
    wanted_.notify_one();
    thread_.join();
}

void SceneMaker::open(const SceneRequest& request, SceneEdits edits, bool replaces_camera,
                      std::optional<StartTime> start) {
    {
        std::lock_guard lock(mutex_);
        order({.open = request,
               .edits = std::move(edits),
               .replaces_camera = replaces_camera,
               .start = start,
               .counts = true});
    }
    wanted_.notify_one();
}

void SceneMaker::show_frame(const SceneRequest& request, SceneEdits edits, double frame) {
    {
        std::lock_guard lock(mutex_);
        Order step{.open = request, .edits = std::move(edits), .start = StartTime{frame}};
        if (order_ && order_->open) {  // a reload, which is still to be done
            step.open = std::move(order_->open);
            step.counts = order_->counts;
        }
        order(std::move(step));
    }
    wanted_.notify_one();
}

void SceneMaker::edit(SceneEdits edits) {
    {
        std::lock_guard lock(mutex_);
        // A file that is still to be read is read.
        if (order_ && !order_->finer)
            order_->edits = std::move(edits);
        else
            order({.edits = std::move(edits)});
    }
    wanted_.notify_one();
}

// With the lock.
void SceneMaker::order(Order order) {
    overtaken_ = true;
    order_ = std::move(order);
}

std::unique_ptr<MadeScene> SceneMaker::take() {
    std::lock_guard lock(mutex_);
    if (made_.empty()) return nullptr;
    std::unique_ptr<MadeScene> first = std::move(made_.front());
    made_.pop_front();
    return first;
}

MakerCounts SceneMaker::counts() const {
    std::lock_guard lock(mutex_);
    return counts_;
}

bool SceneMaker::idle() const {
    std::lock_guard lock(mutex_);
    return !order_ && !working_ && made_.empty();
}

bool SceneMaker::opening() const {
    std::lock_guard lock(mutex_);
    return (order_ && order_->replaces_camera) || (working_ && replaces_camera_ && !cancelled_) ||
           std::ranges::any_of(made_, [](const auto& made) { return made->replaces_camera; });
}

bool SceneMaker::cancel() {
    std::lock_guard lock(mutex_);
    if (order_ && order_->replaces_camera) {
        order_.reset();
        return true;
    }
    if (!working_ || !replaces_camera_ || cancelled_) return false;
    stop_maps_ = 1;
    return cancelled_ = true;
}

Opening SceneMaker::under_way() const {
    std::lock_guard lock(mutex_);
    const bool seen = replaces_camera_ || step_ == Opening::Step::Dices;
    if (!working_ || !seen || cancelled_) return {};
    return {step_, began_.ms() / 1000};
}

bool SceneMaker::goes_on(Opening::Step step) {
    std::lock_guard lock(mutex_);
    if (step == Opening::Step::Reads || step == Opening::Step::Dices) began_.restart();
    step_ = step;
    return !cancelled_;
}

void SceneMaker::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        wanted_.wait(lock, [&] { return quit_ || order_; });
        if (quit_) return;
        Order order = std::move(*order_);
        order_.reset();
        working_ = true;
        replaces_camera_ = order.replaces_camera;
        cancelled_ = overtaken_ = false;
        stop_maps_ = 0;
        lock.unlock();
        std::unique_ptr<MadeScene> made = make(order);
        lock.lock();
        // Not again where it could not be made.
        const bool built = made && made->shown && !made->swapped;
        if (built || (made && order.finer)) dicing_.coarse_shown = built && dicing_.coarse;
        if (made) put(std::move(made));
        if (dicing_.coarse_shown && !order_) order_ = Order{.edits = built_with_, .finer = true};
        working_ = false;
        step_ = Opening::Step::None;
        lock.unlock();
        done_();
        lock.lock();
    }
}

// With the lock.
void SceneMaker::put(std::unique_ptr<MadeScene> made) {
    if (made->shown && !made->swapped) {
        ++counts_.scenes;
        const auto has_scene = [](const auto& before) { return before->shown && !before->swapped; };
        auto before = std::ranges::find_if(made_, has_scene);
        // A scene opened and not taken yet must not lose its place to the same one edited.
        if (before != made_.end()) made->replaces_camera |= (*before)->replaces_camera;
        if (made->finer && before != made_.end()) {
            made->finer = (*before)->finer;
            *before = std::move(made);
            return;
        }
        if (!made->finer) made_.clear();
    }
    made_.push_back(std::move(made));
}

// Null: cancelled. What was read before is left as it was by another scene that is not shown.
std::unique_ptr<MadeScene> SceneMaker::make(const Order& order) {
    auto made = std::make_unique<MadeScene>();
    made->diagnostics = std::make_unique<Diagnostics>();
    made->edits = order.edits;
    made->replaces_camera = order.replaces_camera;
    made->finer = order.finer;
    made->steps = order.open && !order.counts;
    std::optional<AsRead> before;
    if (order.open && order.replaces_camera && read_.scene) before = std::exchange(read_, AsRead{});
    make(order, *made);
    if (!goes_on(Opening::Step::None) || (order.finer && overtaken_)) made.reset();
    const bool good = made && made->shown;
    if (before && !good) {
        read_ = std::move(*before);
        swapper_.reset();  // the next edit builds
    }
    if (!good) return made;
    ++serial_;
    info_ = made->info;
    last_ = made->shown;
    built_with_ = order.edits;
    return made;
}

void SceneMaker::make(const Order& order, MadeScene& made) {
    std::optional<SerialScope> serial;
    // The frames of the scene shown go first; a film's next frame is what is waited for.
    if (serial_ > 0 && !made.steps) serial.emplace();
    try {
        if (order.open) goes_on(Opening::Step::Reads);
        const bool done = order.open ? !read(order, made) : !order.finer && swap(order, made);
        const auto step = order.finer ? Opening::Step::Dices : Opening::Step::Builds;
        if (!done && goes_on(step)) build(order, made);
    } catch (const std::bad_alloc&) {
        made.shown.reset();
        swapper_.reset();  // it may be that of a scene that is not shown
        made.error = SceneError::Memory;
        made.findings.push_back(plain_finding("MEMORY", "there is not enough memory"));
    } catch (const CheckFailed& mistake) {
        made.shown.reset();
        swapper_.reset();
        made.error = SceneError::Internal;
        made.diagnostics->report(Code::INTERNAL_CHECK, Location{}, mistake.what());
    }
    auto found = take_findings(*made.diagnostics);
    made.findings.insert(made.findings.end(), found.begin(), found.end());
}

// The world block of the frame that is wanted.
int SceneMaker::choose_frame(const FilmFrames& film, const Order& order) const {
    const double rate = order.open->fps.value_or(FrameRate{}).value();
    const size_t frame = order.start ? film.at(order.start->frame(rate)) : film.beginning();
    return film.frames[frame].world;
}

std::optional<ImportedScene> SceneMaker::import_frame(const Order& order,
                                                      Diagnostics& diagnostics) {
    const std::shared_ptr<FilmReader> film = read_.film;
    const int before = film->maps_rendered();
    const int world = choose_frame(*film->film(), order);
    std::optional<ImportedScene> scene = film->read(world, diagnostics, &stop_maps_);
    std::lock_guard lock(mutex_);
    counts_.maps += uint64_t(film->maps_rendered() - before);
    return scene;
}

std::optional<ImportedScene> SceneMaker::import(const Order& order, Diagnostics& diagnostics) {
    const SceneRequest& request = *order.open;
    const bool rib = is_rib(request.scene);
    if (!rib) read_.film.reset();
    if (order.counts && rib)
        if (auto film = std::make_shared<FilmReader>(request); !film->film()->frames.empty())
            read_.film = std::move(film);
    if (read_.film) return import_frame(order, diagnostics);
    return import_requested(request, diagnostics);
}

bool SceneMaker::read(const Order& order, MadeScene& made) {
    Diagnostics& diagnostics = *made.diagnostics;
    const SceneRequest& request = *order.open;
    judge_by(request, diagnostics);
    made.error = SceneError::Unreadable;
    std::optional<ImportedScene> imported = import(order, diagnostics);
    read_.files.clear();
    for (FileId f = 0; f < diagnostics.files.count(); ++f)
        read_.files.push_back(diagnostics.files.name(f));
    made.files = read_.files;
    if (!imported) return false;
    if (!imported->clip_known) {
        made.error = SceneError::Request;
        made.findings.push_back(
            plain_finding("CLIP_UNKNOWN", "the scene has no clip '" + request.clip + "'"));
        return false;
    }
    made.error = forbidding_error(diagnostics);
    read_.broken.clear();
    read_.broken_findings.clear();
    if (shows_broken_ && made.error == SceneError::Shader) {
        for (const Finding& finding : diagnostics.findings())
            if (finding.severity == Severity::Error && finding.where.file != kNoFile)
                add_broken_shaders(diagnostics.files, finding.where, read_.broken);
        read_.broken_findings = take_findings(diagnostics);
    } else if (made.error != SceneError::None) {
        return false;
    }
    read_.scene = std::move(imported);
    read_.texts = diagnostics.files;
    read_.request = read_.film ? read_.film->request() : request;
    return true;
}

namespace {

bool has_text(const SceneEdits& edits, const std::string& material) {
    return std::ranges::find(edits.texts, material, &SceneEdits::Text::material) !=
           edits.texts.end();
}

// Without what no edit of a shader touches.
ImportedScene copy_without_geometry(ImportedScene& from) {
    SceneDescription& description = from.description;
    auto meshes = std::exchange(description.meshes, {});
    auto skins = std::exchange(description.skins, {});
    auto morphs = std::exchange(description.morphs, {});
    auto animation = std::exchange(description.animation, {});
    ImportedScene copy = from;
    description.meshes = std::move(meshes);
    description.skins = std::move(skins);
    description.morphs = std::move(morphs);
    description.animation = std::move(animation);
    return copy;
}

}  // namespace

void SceneMaker::begin(MadeScene& made) const {
    made.files = read_.files;
    made.error = SceneError::Shader;
    made.diagnostics->judge(read_.request.judgement());
    made.diagnostics->files = read_.texts.fork();  // edited texts go when their scene does
}

// A broken text is that of all materials that wear its effect, and so is what it becomes.
SceneEdits SceneMaker::with_shared_texts(SceneEdits edits) const {
    for (const BrokenShader& one : read_.broken)
        for (const BrokenShader& other : read_.broken) {
            auto text = std::ranges::find(edits.texts, one.material, &SceneEdits::Text::material);
            if (text == edits.texts.end() || has_text(edits, other.material)) continue;
            if (one.source.file != other.source.file || one.source.begin != other.source.begin)
                continue;
            SceneEdits::Text shared = *text;
            shared.material = other.material;
            edits.texts.push_back(std::move(shared));
        }
    return edits;
}

// Undo finds the kernels of so many edits; those of older ones, which nobody runs, are freed.
constexpr int kSwapsKept = 32;

// False: the scene is to be built.
bool SceneMaker::swap(const Order& order, MadeScene& made) {
    if (!read_.scene || !swapper_ || order.edits.hidden != built_with_.hidden) return false;
    begin(made);
    Diagnostics& diagnostics = *made.diagnostics;
    Stopwatch watch;
    ImportedScene imported = copy_without_geometry(*read_.scene);
    EditedShaders shaders = shaders_;
    if (!apply_edits(imported, with_shared_texts(order.edits), read_.request, diagnostics,
                     &shaders))
        return true;
    ShaderSwap swap;
    switch (swapper_->swap(imported.description, diagnostics, swap)) {
        case ShaderSwapper::Outcome::Swapped:
            break;
        case ShaderSwapper::Outcome::Failed:
            return true;
        case ShaderSwapper::Outcome::Build:
            diagnostics.clear();
            return false;
    }
    shaders_ = std::move(shaders);
    preload_textures(imported.description, *textures_);  // no frame waits for a file
    preload_named_pictures(imported.description, *textures_);
    // Each text leaves its kernels in the cache.
    if (++swaps_ % kSwapsKept == 0) jit::clear_cache();
    {
        std::lock_guard lock(mutex_);
        counts_.kernels += swap.instances.size();
    }
    auto shown = std::make_shared<ShownScene>(*last_);
    shown->scene = swapped_scene(*last_->scene, std::move(swap));
    shown->texts = diagnostics.files;
    made.shown = std::move(shown);
    made.swapped = true;
    made.error = SceneError::None;
    made.info = swapped_info(*info_, imported.description);
    made.build_ms = watch.ms();
    return true;
}

void SceneMaker::build(const Order& order, MadeScene& made) {
    if (!read_.scene) return;
    begin(made);
    Diagnostics& diagnostics = *made.diagnostics;
    Stopwatch watch;
    SceneEdits edits = with_shared_texts(order.edits);
    bool mended = std::ranges::all_of(
        read_.broken, [&](const BrokenShader& broken) { return has_text(edits, broken.material); });
    if (!mended || read_.broken.empty()) made.findings = read_.broken_findings;
    ImportedScene imported = *read_.scene;
    EditedShaders shaders;
    if (!apply_edits(imported, edits, read_.request, diagnostics, &shaders)) return;
    SceneDescription edited = copy_without_geometry(imported).description;
    dicing_.coarse = begins_coarse(order);
    if (dicing_.coarse) imported.options.quality.dice = kCoarseDice;
    BuildAgain again{{}, textures_, &overtaken_};
    BuiltScene built =
        build_imported(std::move(imported), diagnostics, order.finer ? &again : nullptr);
    made.error = forbidding_error(diagnostics, SceneError::Unreadable);
    if (!built.scene) return;
    made.error = SceneError::None;
    dicing_.coarse = dicing_.coarse && built.redicer;
    // What is diced or exposed by itself depends on its shaders.
    swapper_.reset();
    if (!built.redicer && !read_.request.auto_exposure)
        swapper_.emplace(*built.scene, std::move(edited), read_.scene->description.values.size());
    shaders_ = std::move(shaders);
    const Scene& scene = *built.scene;
    made.pose = std::move(built.pose);
    textures_ = scene.textures;
    preload_named_pictures(*scene.description, *textures_);
    textures_->each_image([&](const StoredImage& image) { made.files.push_back(image.file); });
    made.redicer = std::move(built.redicer);
    const FrameSettings settings = frame_settings(read_.request, scene, *made.pose, diagnostics);
    auto info = scene_info(scene, {read_.scene->description, read_.texts}, read_.request,
                           read_.scene->rate);
    for (MaterialInfo& material : info->materials)
        for (const BrokenShader& broken : read_.broken)
            if (broken.material == material.id && !material.source)
                material.source = std::make_shared<const ShaderSourceText>(broken.source);
    info->serial = serial_ + 1;
    add_film(*info);
    made.info = std::move(info);
    made.build_ms = watch.ms();
    if (!dicing_.coarse) dicing_.is_fast = scene.dice.triangles && scene.dice.ms < kFastDiceMs;
    made.shown = std::make_shared<ShownScene>(
        ShownScene{read_.request, read_.scene->rate, std::move(built.scene), settings,
                   diagnostics.files, encoding_of(read_.request)});
    if (order.finer) pose(made);
}

// The time line has its frames.
void SceneMaker::add_film(SceneInfo& info) const {
    if (!read_.film) return;
    info.film = read_.film->film();
    const std::vector<FilmFrame>& frames = info.film->frames;
    const auto shown = std::ranges::find(frames, read_.request.world, &FilmFrame::world);
    if (shown != frames.end()) info.film_frame = size_t(shown - frames.begin());
    info.first = frames.front().number;
    info.last = frames.back().number;
    if (frames.size() > 1)
        for (const FilmFrame& frame : frames) info.keys.push_back(frame.number);
}

// So that no frame waits for the trees of many triangles.
void SceneMaker::pose(MadeScene& made) const {
    FrameStats stats;
    const Scene& scene = *made.shown->scene;
    pose_frame(scene, *made.pose, scene.options.start_time, made.shown->settings, stats,
               *made.diagnostics);
}

bool SceneMaker::begins_coarse(const Order& order) const {
    const SceneOptions& options = read_.scene->options;
    if (!hurries_ || order.finer || options.quality.dice >= kCoarseDice) return false;
    const bool fast = dicing_.is_fast && !order.open;
    return !fast && may_dice(read_.scene->description, options);
}

}  // namespace kinora
