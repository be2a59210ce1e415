// runtime/play/scene_maker.cpp: orders to scenes, the last order first.
#include "runtime/play/scene_maker.h"

#include <algorithm>
#include <new>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/description/findings.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

SceneMaker::SceneMaker(std::function<void()> done)
    : done_(std::move(done)), thread_([this] { run(); }) {}

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
    return std::move(made_);
}

bool SceneMaker::idle() const {
    std::lock_guard lock(mutex_);
    return !order_ && !working_ && !made_;
}

bool SceneMaker::opening() const {
    std::lock_guard lock(mutex_);
    return (order_ && order_->replaces_camera) || (working_ && replaces_camera_) ||
           (made_ && made_->replaces_camera);
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
        // A scene opened and not taken yet must not lose its place to the same one edited.
        if (made_ && made_->replaces_camera && made_->scene) made->replaces_camera = true;
        made_ = std::move(made);
        working_ = false;
        lock.unlock();
        done_();
        lock.lock();
    }
}

std::unique_ptr<ShownScene> SceneMaker::make(const Order& order) {
    auto shown = std::make_unique<ShownScene>();
    shown->diagnostics = std::make_unique<Diagnostics>();
    shown->edits = order.edits;
    shown->replaces_camera = order.replaces_camera;
    std::optional<SerialScope> serial;
    if (serial_ > 0) serial.emplace();  // the frames of the scene shown go first
    try {
        if (!order.open || read(*order.open, *shown)) build(order, *shown);
    } catch (const std::bad_alloc&) {
        shown->scene.reset();
        shown->exit_code = kExitRetry;
        shown->findings.push_back(plain_finding("MEMORY", "there is not enough memory"));
    }
    auto found = take_findings(*shown->diagnostics);
    shown->findings.insert(shown->findings.end(), found.begin(), found.end());
    if (shown->scene) ++serial_;
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
    if (shown.exit_code != kExitOk) return false;
    base_ = std::move(imported);
    texts_ = diagnostics.files;
    request_ = request;
    return true;
}

void SceneMaker::build(const Order& order, ShownScene& shown) {
    if (!base_) return;
    Diagnostics& diagnostics = *shown.diagnostics;
    shown.request = request_;
    shown.files = files_;
    diagnostics.judge(request_.findings.judgement());
    diagnostics.files = texts_;
    Stopwatch watch;
    ImportedScene imported = *base_;
    shown.rate = imported.rate;
    shown.exit_code = kExitShader;
    if (!apply_edits(imported, order.edits, request_, diagnostics)) return;
    BuiltScene built = build_imported(std::move(imported), diagnostics);
    shown.exit_code = exit_code_of_findings(diagnostics, kExitUnreadable);
    if (!built.scene) return;
    shown.exit_code = kExitOk;
    shown.scene = std::move(built.scene);
    shown.redicer = std::move(built.redicer);
    shown.settings = frame_settings(request_, *shown.scene, diagnostics);
    auto info = scene_info(*shown.scene, {base_->description, texts_}, request_, shown.rate);
    info->serial = serial_ + 1;
    shown.info = std::move(info);
    shown.build_ms = watch.ms();
}

}  // namespace kinora
