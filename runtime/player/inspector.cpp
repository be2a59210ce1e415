// runtime/player/inspector.cpp: one inspection after the other, the pose kept between them.
#include "runtime/player/inspector.h"

#include <new>
#include <utility>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/base/tasks/thread_priority.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/scene/build/instances/shader_swap.h"
#include "runtime/scene/camera.h"

namespace kinora {

namespace {

// A shader may loop for ever: so long an inspection holds up those behind it.
constexpr double kPatienceMs = 10'000;

}  // namespace

struct Inspector::Posed {
    std::shared_ptr<const ShownScene> shown;
    std::shared_ptr<const Scene> scene;  // shown->scene, or it diced for a nearer view
    std::unique_ptr<Pose> pose;
};

Inspector::Inspector(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this] { run(); }) {}

Inspector::~Inspector() {
    {
        std::lock_guard lock(mutex_);
        quit_ = true;
        stop_ = 1;
    }
    wanted_.notify_one();
    thread_.join();
}

void Inspector::add(Inspection inspection) {
    {
        std::lock_guard lock(mutex_);
        inspections_.push_back(std::move(inspection));
        ++asked_;
        overtaken_ = working_;
    }
    wanted_.notify_one();
}

void Inspector::keep(const std::shared_ptr<const ShownScene>& shown) {
    {
        std::lock_guard lock(mutex_);
        other_than_ = shown;
        overtaken_ = working_;
    }
    wanted_.notify_one();
}

std::vector<Answer> Inspector::take() {
    std::lock_guard lock(mutex_);
    if (working_ && overtaken_ && began_.ms() > kPatienceMs) stop_ = 1;
    taken_ = answered_;
    return std::exchange(answers_, {});
}

uint64_t Inspector::asked() const {
    std::lock_guard lock(mutex_);
    return asked_;
}

bool Inspector::has_answered(uint64_t asked) const {
    std::lock_guard lock(mutex_);
    return taken_ >= asked;
}

bool Inspector::idle() const {
    std::lock_guard lock(mutex_);
    return !working_ && inspections_.empty() && answers_.empty();
}

void Inspector::run() {
    SerialScope serial;  // the frames of the scene shown go first
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    while (true) {
        wanted_.wait(lock, [&] { return quit_ || other_than_ || !inspections_.empty(); });
        if (quit_) return;
        if (auto kept = std::exchange(other_than_, nullptr)) {
            std::unique_ptr<Posed> old;
            if (posed_ && !same_besides_swaps(*posed_->shown->scene, *kept->scene))
                old = std::move(posed_);
            lock.unlock();
            old.reset();  // a scene may go with it, and take its time
            lock.lock();
            continue;
        }
        const Inspection inspection = std::move(inspections_.front());
        inspections_.pop_front();
        working_ = true;
        overtaken_ = !inspections_.empty();
        stop_ = 0;
        began_.restart();
        lock.unlock();
        Answer answer;
        try {
            answer = inspect(inspection);
        } catch (const std::bad_alloc&) {  // nothing is found
            posed_.reset();
        } catch (const CheckFailed&) {  // the picture's thread tells of it
            posed_.reset();
        }
        lock.lock();
        working_ = false;
        ++answered_;
        if (answer) answers_.push_back(std::move(answer));
        lock.unlock();
        wake_();
        lock.lock();
    }
}

Inspector::Posed& Inspector::posed_for(const Inspection& inspection) {
    const Scene& scene = *inspection.scene;
    if (posed_ && same_besides_swaps(*posed_->scene, scene)) {
        if (posed_->scene != inspection.scene) take_swaps(*posed_->scene, scene, *posed_->pose);
    } else {
        posed_.reset();
        posed_ = std::make_unique<Posed>();
        posed_->pose = std::make_unique<Pose>(scene);
    }
    posed_->shown = inspection.shown;
    posed_->scene = inspection.scene;
    return *posed_;
}

Answer Inspector::inspect(const Inspection& inspection) {
    const ShownScene& shown = *inspection.shown;
    Pose& pose = *posed_for(inspection).pose;
    PlacedCamera placed;
    FrameSettings settings =
        refined_settings(shown, *inspection.scene, pose, inspection.order, placed);
    settings.stop = &stop_;
    Inspected inspected{shown, *inspection.scene, pose, inspection.order, settings};
    if (inspection.poses) {
        FrameStats stats;
        Diagnostics ignored;  // the frames report them
        inspected.stands = pose_frame(*inspection.scene, pose, time_of(shown, inspection.order),
                                      settings, stats, ignored);
    }
    return inspection.look(inspected);
}

}  // namespace kinora
