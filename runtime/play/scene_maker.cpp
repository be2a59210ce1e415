// runtime/play/scene_maker.cpp: orders to scenes, the last order first.
#include "runtime/play/scene_maker.h"

#include <algorithm>
#include <new>
#include <utility>

#include "jit/compiler.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/description/findings.h"
#include "runtime/images/texture_store.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

SceneMaker::SceneMaker(std::function<void()> done, bool shows_broken)
    : done_(std::move(done)), shows_broken_(shows_broken), thread_([this] { run(); }) {}

SceneMaker::~SceneMaker() {
    {
        std::lock_guard lock(mutex_);
        quit_ = true;
        order_.reset();
    }
    wanted_.notify_one();
    thread_.join();
}

void SceneMaker::open(const SceneRequest& request, SceneEdits edits, bool replaces_camera) {
    {
        std::lock_guard lock(mutex_);
        order_ = Order{request, std::move(edits), replaces_camera};
    }
    wanted_.notify_one();
}

void SceneMaker::edit(SceneEdits edits) {
    {
        std::lock_guard lock(mutex_);
        // A file that is still to be read is read.
        if (order_)
            order_->edits = std::move(edits);
        else
            order_ = Order{std::nullopt, std::move(edits), false};
    }
    wanted_.notify_one();
}

std::unique_ptr<ShownScene> SceneMaker::take() {
    std::lock_guard lock(mutex_);
    if (made_.empty()) return nullptr;
    std::unique_ptr<ShownScene> first = std::move(made_.front());
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
    return (order_ && order_->replaces_camera) || (working_ && replaces_camera_) ||
           std::ranges::any_of(made_, [](const auto& made) { return made->replaces_camera; });
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
        lock.unlock();
        std::unique_ptr<ShownScene> made = make(order);
        lock.lock();
        put(std::move(made));
        working_ = false;
        lock.unlock();
        done_();
        lock.lock();
    }
}

// With the lock.
void SceneMaker::put(std::unique_ptr<ShownScene> made) {
    if (made->swapped) counts_.kernels += made->swapped->swap.instances.size();
    if (made->scene) {
        ++counts_.scenes;
        // A scene opened and not taken yet must not lose its place to the same one edited.
        for (const auto& before : made_)
            if (before->scene && before->replaces_camera) made->replaces_camera = true;
        made_.clear();
    }
    made_.push_back(std::move(made));
}

std::unique_ptr<ShownScene> SceneMaker::make(const Order& order) {
    auto shown = std::make_unique<ShownScene>();
    shown->diagnostics = std::make_unique<Diagnostics>();
    shown->edits = order.edits;
    shown->replaces_camera = order.replaces_camera;
    std::optional<SerialScope> serial;
    if (serial_ > 0) serial.emplace();  // the frames of the scene shown go first
    try {
        bool done = order.open ? !read(*order.open, *shown) : swap(order, *shown);
        if (!done) build(order, *shown);
    } catch (const std::bad_alloc&) {
        shown->scene.reset();
        shown->exit_code = kExitRetry;
        shown->findings.push_back(plain_finding("MEMORY", "there is not enough memory"));
    }
    auto found = take_findings(*shown->diagnostics);
    shown->findings.insert(shown->findings.end(), found.begin(), found.end());
    if (shown->scene || shown->swapped) {
        ++serial_;
        info_ = shown->info;
        built_with_ = order.edits;
    }
    return shown;
}

bool SceneMaker::read(const SceneRequest& request, ShownScene& shown) {
    Diagnostics& diagnostics = *shown.diagnostics;
    diagnostics.judge(request.findings.judgement());
    if (request.findings.strict) diagnostics.set_severity("RSL_SPACE_UNKNOWN", Severity::Error);
    shown.request = request;
    shown.exit_code = kExitUnreadable;
    std::optional<ImportedScene> imported = import_requested(request, diagnostics);
    files_.clear();
    for (FileId f = 0; f < diagnostics.files.count(); ++f)
        files_.push_back(diagnostics.files.name(f));
    shown.files = files_;
    if (!imported) return false;
    if (!imported->clip_known) {
        shown.exit_code = kExitUsage;
        shown.findings.push_back(
            plain_finding("CLIP_UNKNOWN", "the scene has no clip '" + request.clip + "'"));
        return false;
    }
    shown.exit_code = exit_code_of_findings(diagnostics, kExitOk);
    broken_.clear();
    broken_findings_.clear();
    if (shows_broken_ && shown.exit_code == kExitShader) {
        for (const Finding& finding : diagnostics.findings())
            if (finding.severity == Severity::Error && finding.where.file != kNoFile)
                add_broken_shaders(diagnostics.files, finding.where, broken_);
        broken_findings_ = take_findings(diagnostics);
    } else if (shown.exit_code != kExitOk) {
        return false;
    }
    base_ = std::move(imported);
    texts_ = diagnostics.files;
    request_ = request;
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

void SceneMaker::begin(ShownScene& shown) const {
    shown.request = request_;
    shown.files = files_;
    shown.rate = base_->rate;
    shown.exit_code = kExitShader;
    shown.diagnostics->judge(request_.findings.judgement());
    shown.diagnostics->files = texts_.fork();  // edited texts go when their scene does
}

// A broken text is that of all materials that wear its effect, and so is what it becomes.
SceneEdits SceneMaker::with_shared_texts(SceneEdits edits) const {
    for (const BrokenShader& one : broken_)
        for (const BrokenShader& other : broken_) {
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
bool SceneMaker::swap(const Order& order, ShownScene& shown) {
    if (!base_ || !swapper_ || order.edits.hidden != built_with_.hidden) return false;
    begin(shown);
    Diagnostics& diagnostics = *shown.diagnostics;
    Stopwatch watch;
    ImportedScene imported = copy_without_geometry(*base_);
    EditedShaders shaders = shaders_;
    if (!apply_edits(imported, with_shared_texts(order.edits), request_, diagnostics, &shaders))
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
    // Each text leaves its kernels in the cache.
    if (++swaps_ % kSwapsKept == 0) jit::clear_cache();
    shown.exit_code = kExitOk;
    shown.info = swapped_info(*info_, imported.description);
    shown.swapped = {std::move(swap), diagnostics.files};
    shown.build_ms = watch.ms();
    return true;
}

void SceneMaker::build(const Order& order, ShownScene& shown) {
    if (!base_) return;
    begin(shown);
    Diagnostics& diagnostics = *shown.diagnostics;
    Stopwatch watch;
    SceneEdits edits = with_shared_texts(order.edits);
    bool mended = std::ranges::all_of(
        broken_, [&](const BrokenShader& broken) { return has_text(edits, broken.material); });
    if (!mended || broken_.empty()) shown.findings = broken_findings_;
    ImportedScene imported = *base_;
    EditedShaders shaders;
    if (!apply_edits(imported, edits, request_, diagnostics, &shaders)) return;
    SceneDescription edited = copy_without_geometry(imported).description;
    BuiltScene built = build_imported(std::move(imported), diagnostics);
    shown.exit_code = exit_code_of_findings(diagnostics, kExitUnreadable);
    if (!built.scene) return;
    shown.exit_code = kExitOk;
    // What is diced or exposed by itself depends on its shaders.
    swapper_.reset();
    if (!built.redicer && !request_.auto_exposure)
        swapper_.emplace(*built.scene, std::move(edited), base_->description.values.size());
    shaders_ = std::move(shaders);
    shown.scene = std::move(built.scene);
    shown.scene->textures->each_image(
        [&](const StoredImage& image) { shown.files.push_back(image.file); });
    shown.redicer = std::move(built.redicer);
    shown.settings = frame_settings(request_, *shown.scene, diagnostics);
    auto info = scene_info(*shown.scene, {base_->description, texts_}, request_, shown.rate);
    for (MaterialInfo& material : info->materials)
        for (const BrokenShader& broken : broken_)
            if (broken.material == material.id && !material.source)
                material.source = std::make_shared<const ShaderSourceText>(broken.source);
    info->serial = serial_ + 1;
    shown.info = std::move(info);
    shown.build_ms = watch.ms();
}

}  // namespace kinora
