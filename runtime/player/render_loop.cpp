// runtime/player/render_loop.cpp: passes over the newest order: a quick one, then better ones.
#include "runtime/player/render_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <system_error>
#include <utility>

#include "runtime/base/check.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/player/denoise/denoiser.h"
#include "runtime/player/pace/pacer.h"
#include "runtime/player/pace/patience.h"
#include "runtime/player/picture/guide.h"
#include "runtime/player/show_picture.h"
#include "runtime/scene/build/instances/shader_swap.h"
#include "runtime/scene/camera.h"

namespace kinora {

namespace {

double sum_of(const FrameStats& stats, std::initializer_list<Stage> stages) {
    double ms = 0;
    for (Stage stage : stages) ms += stats.stages[size_t(stage)];
    return ms;
}

constexpr size_t kTimes = 120;
constexpr double kForEver = std::numeric_limits<double>::infinity();
constexpr int kSomeShare = 8;     // a pass of a share of the samples comes before the whole
constexpr int kManySamples = 16;  // where there are at least so many
constexpr int kCostTile = 8;      // pixels a side, that costs are measured in

// Small tiles say where the costs are.
void measure_costs(FrameSettings& settings, PixelCosts& costs) {
    settings.insight.costs = &costs;
    settings.integrator.tile = kCostTile;
    settings.integrator.chunk_rays = size_t(kCostTile) * kCostTile;
}

}  // namespace

struct RenderLoop::Posed {
    std::shared_ptr<const ShownScene> shown;
    std::unique_ptr<Pose> pose;
    std::unique_ptr<Redicer> redicer;  // null where nothing is diced
    std::unique_ptr<Diagnostics> diagnostics;
    // With displaced meshes diced for a nearer view.
    std::shared_ptr<const Scene> closer;
    std::unique_ptr<Pose> closer_pose;
    std::optional<ViewOrder> closer_view;  // the picture that it was diced for; none: a smaller one
    bool shows_closer = false;             // which made the last picture

    // What made the last picture.
    const std::shared_ptr<const Scene>& seen() const {
        return shows_closer ? closer : shown->scene;
    }
    Pose& seen_pose() const { return shows_closer ? *closer_pose : *pose; }
    void swap(std::shared_ptr<const ShownScene> swapped);
};

void RenderLoop::Posed::swap(std::shared_ptr<const ShownScene> swapped) {
    take_swaps(*shown->scene, *swapped->scene, *pose);
    diagnostics->files = swapped->texts;
    shown = std::move(swapped);
}

// Kept from frame to frame.
struct RenderLoop::Memory {
    std::vector<std::shared_ptr<Picture>> pictures;
    uint64_t serial = 0;
    raytrace::Film enlarged;
    Pacer pacer;
    FirstHits first;      // of the picture in work
    PictureGuide hits;    // they, where it is small
    double guide_ms = 0;  // of its rays that say where edges are (Pacer::kNeedsGuide)
    Denoiser denoiser;
    // What the denoiser has seen: of that scene, with those shaders and that light.
    std::shared_ptr<Posed> filtered;
    double exposure = 0;
    uint32_t only_light = kNone;
    bool noisy = true;             // as far as is known
    std::shared_ptr<Posed> paced;  // of whose times something is known
    void follow(const Step& step);
    void pace(const std::shared_ptr<Posed>& posed, bool begins);
    std::optional<ViewOrder>
        dices_for;  // what the redicer was started for; none: a smaller picture
};

// Pictures of anything else say nothing about the next one.
void RenderLoop::Memory::follow(const Step& step) {
    if (filtered == step.posed && exposure == step.order.exposure &&
        only_light == step.order.only_light)
        return;
    filtered = step.posed;
    exposure = step.order.exposure;
    only_light = step.order.only_light;
    denoiser.forget();
    noisy = true;
}

void RenderLoop::Memory::pace(const std::shared_ptr<Posed>& posed, bool begins) {
    if (begins && paced != posed) pacer.begin();
    paced = posed;
}

RenderLoop::RenderLoop(bool real_time, std::function<void()> wake)
    : real_time_(real_time), wake_(std::move(wake)), memory_(std::make_unique<Memory>()) {
    threads_.emplace_back([this] { run(); });
    try {
        threads_.emplace_back([this] { end_late_frames(); });
    } catch (const std::system_error&) {  // as many threads as there may be
        {
            std::lock_guard lock(mutex_);
            quit_ = true;
        }
        wanted_.notify_one();
        threads_.front().join();
        throw;
    }
}

RenderLoop::~RenderLoop() {
    {
        std::lock_guard lock(mutex_);
        quit_ = true;
        stop_ = 1;
    }
    wanted_.notify_one();
    overtaken_.notify_one();
    for (std::thread& thread : threads_) thread.join();
}

void RenderLoop::show(std::unique_ptr<MadeScene> made, const ViewOrder& order,
                      const DisplaySettings& display) {
    auto posed = std::make_shared<Posed>();
    posed->shown = std::move(made->shown);
    posed->pose = std::move(made->pose);
    posed->redicer = std::move(made->redicer);
    posed->diagnostics = std::move(made->diagnostics);
    {
        std::lock_guard lock(mutex_);
        posed_ = std::move(posed);
        if (made->replaces_camera) begins_ = true;
        swapped_.reset();
        take_order(order, display);
        want_picture();
        // A film whose frames come faster than their pictures must have some.
        if (!made->steps || !in_work_ || in_work_->pass != Pass::Quick) stop_ = 1;
    }
    wanted_.notify_one();
}

void RenderLoop::swap(std::shared_ptr<const ShownScene> swapped) {
    {
        std::lock_guard lock(mutex_);
        swapped_ = std::move(swapped);
        want_picture();
        stop_ = 1;
    }
    wanted_.notify_one();
}

// With the lock.
void RenderLoop::want_picture() {
    next_ = Pass::Quick;
    ++count_.ordered;
}

// With the lock.
void RenderLoop::take_order(const ViewOrder& order, const DisplaySettings& display) {
    bool same = order_.same_picture(order);
    bool refines_now = order_.playing && !order.playing && order.refine;
    bool quality_changed = order_.refine != order.refine;
    order_ = order;
    if (!(display == display_)) {
        // The guide or the costs may be missing.
        if (shows_guide(display.aov) && !shows_guide(display_.aov)) same = false;
        if (shows_costs(display.aov) != shows_costs(display_.aov)) same = false;
        display_ = display;
        display_changed_ = true;
    }
    if (!same) {
        want_picture();
        if (in_work_ && in_work_->pass != Pass::Quick) stop_ = 1;
    } else if ((refines_now || quality_changed) && next_ == Pass::Done) {
        want_picture();
    }
}

void RenderLoop::order(const ViewOrder& order, const DisplaySettings& display) {
    {
        std::lock_guard lock(mutex_);
        take_order(order, display);
    }
    wanted_.notify_one();
    overtaken_.notify_one();
}

std::shared_ptr<const Picture> RenderLoop::picture() const {
    std::lock_guard lock(mutex_);
    return shown_.picture;
}

PictureSource RenderLoop::source() const {
    std::lock_guard lock(mutex_);
    return shown_;
}

std::vector<FindingText> RenderLoop::take_findings() {
    std::lock_guard lock(mutex_);
    return std::exchange(findings_, {});
}

std::vector<StageTimes> RenderLoop::times() const {
    std::lock_guard lock(mutex_);
    return {times_.begin(), times_.end()};
}

uint64_t RenderLoop::frames() const {
    std::lock_guard lock(mutex_);
    return count_.begun;
}

bool RenderLoop::idle() const {
    std::lock_guard lock(mutex_);
    return !working_ && (!posed_ || (next_ == Pass::Done && !display_changed_));
}

uint64_t RenderLoop::ordered() const {
    std::lock_guard lock(mutex_);
    return count_.ordered;
}

bool RenderLoop::has_made(uint64_t ordered) const {
    std::lock_guard lock(mutex_);
    return !posed_ || count_.made >= ordered;
}

void RenderLoop::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        std::optional<Step> step;
        wanted_.wait(lock, [&] { return quit_ || (step = next_step()); });
        if (quit_) return;
        stop_ = 0;
        working_ = true;
        if (!step->display_only) {
            ++count_.begun;
            step->first = begins_;
            memory_->pace(step->posed, begins_);
            memory_->pacer.aim_at(1000 / std::max(step->order.hold_rate, 1e-3));
            const bool limited = step->pass == Pass::Quick && real_time_ && step->order.adapt;
            work_.limit = limited ? memory_->pacer.limit(step->order.playing) : kForEver;
            work_.cut = false;
            in_work_ = *step;
            work_.began.restart();
            if (limited) overtaken_.notify_one();
        }
        std::shared_ptr<const ShownScene> swapped = std::exchange(swapped_, nullptr);
        lock.unlock();
        if (swapped) {
            step->posed->swap(std::move(swapped));
            memory_->filtered.reset();
        }
        if (step->display_only) {
            redisplay(*step);
            lock.lock();
        } else {
            plan(*step);
            const Outcome outcome = make(*step);
            lock.lock();
            if (outcome.whole && step->posed == posed_) begins_ = false;
            finish(*step, outcome);
        }
        in_work_.reset();
        working_ = false;
        lock.unlock();
        wake_();
        lock.lock();
    }
}

// With the lock. Does something wait for the end of the quick frame in work? Time that goes by is
// nothing to wait for, and no move ends a scene's first one.
bool RenderLoop::is_overtaken() const {
    if (in_work_->first) return false;
    ViewOrder then = in_work_->order;
    then.frame = order_.frame;
    return !then.same_picture(order_);
}

// With the lock. Milliseconds until the frame in work is let go, if it is not ready by then.
double RenderLoop::time_left() const {
    if (!in_work_ || !real_time_ || stop_) return kForEver;
    double most = work_.limit;
    if (is_overtaken()) {
        auto whole = std::find_if(times_.rbegin(), times_.rend(),
                                  [](const StageTimes& times) { return !times.cancelled; });
        most = std::min(most, patience_ms(order_.hold_rate, size_t(whole - times_.rbegin())));
    }
    return most - work_.began.ms();
}

// A thread of its own: a frame that takes long looks at `stop_` alone.
void RenderLoop::end_late_frames() {
    std::unique_lock lock(mutex_);
    while (!quit_) {
        const double left = time_left();
        if (left <= 0) {
            work_.cut = work_.began.ms() >= work_.limit;
            stop_ = 1;
        } else if (left < kForEver) {
            overtaken_.wait_for(lock, std::chrono::duration<double, std::milli>(left));
        } else {
            overtaken_.wait(lock);
        }
    }
}

// With the lock. What is to be done now, if anything.
std::optional<RenderLoop::Step> RenderLoop::next_step() {
    if (!posed_) return std::nullopt;
    Step step;
    step.order = order_;
    step.display = display_;
    step.posed = posed_;
    if (next_ == Pass::Done) {
        if (!display_changed_) return std::nullopt;
        step.display_only = true;
        display_changed_ = false;
        return step;
    }
    display_changed_ = false;
    step.pass = next_;
    step.ordered = count_.ordered;
    // The order in work: a newer one sets `next_` again.
    next_ = Pass::Done;
    return step;
}

// The pass's size and samples.
void RenderLoop::plan(Step& step) const {
    step.whole_samples = step.posed->shown->settings.integrator.samples_per_pixel;
    switch (step.pass) {
        case Pass::Quick:
            // Without a clock, what is refined is made at once.
            if (!real_time_ && !step.order.playing && step.order.refine) {
                step.pass = Pass::Refined;
                step.samples = step.whole_samples;
            } else if (real_time_ && step.order.adapt) {
                step.scale = memory_->pacer.scale();
            }
            break;
        case Pass::Whole:
            break;
        case Pass::Some:
            step.samples = step.whole_samples / kSomeShare;
            break;
        case Pass::Refined:
        case Pass::Done:
            step.samples = step.whole_samples;
            break;
    }
}

RenderLoop::Pass RenderLoop::after(const Step& step) const {
    if (step.order.playing || !step.order.refine) return Pass::Done;
    bool some = step.whole_samples >= kManySamples;
    switch (step.pass) {
        case Pass::Quick:
            if (step.scale < 1) return Pass::Whole;
            [[fallthrough]];
        case Pass::Whole:
            return some ? Pass::Some : Pass::Refined;
        case Pass::Some:
            return Pass::Refined;
        case Pass::Refined:
        case Pass::Done:
            return Pass::Done;
    }
    return Pass::Done;
}

// With the lock.
void RenderLoop::finish(const Step& step, const Outcome& outcome) {
    times_.push_back(outcome.times);
    if (times_.size() > kTimes) times_.pop_front();
    if (outcome.whole || !stop_) count_.made = step.ordered;
    if (next_ != Pass::Done) return;  // a newer order
    if (outcome.whole)
        next_ = after(step);
    else if (stop_)  // let go for something that is done by now
        next_ = step.pass == Pass::Refined && !real_time_ ? Pass::Quick : step.pass;
    // Else no picture can be made; the findings say why.
}

RenderLoop::Outcome RenderLoop::make(const Step& step) {
    Outcome outcome;
    StageTimes& times = outcome.times;
    Stopwatch watch;
    const Posed& posed = *step.posed;
    std::shared_ptr<Picture> to = free_picture();
    PlacedCamera placed;
    FrameSettings settings =
        refined_settings(*posed.shown, *posed.shown->scene, *posed.pose, step.order, placed);
    settings.width = std::max(1, int(std::lround(step.order.width * step.scale)));
    settings.height = std::max(1, int(std::lround(step.order.height * step.scale)));
    settings.integrator.samples_per_pixel = step.samples;
    settings.stop = &stop_;
    to->costs = {};
    if (shows_costs(step.display.aov)) measure_costs(settings, to->costs);
    memory_->follow(step);
    memory_->guide_ms = 0;
    const bool filters = is_filtered(step);
    if (filters || step.scale < 1) {
        settings.insight.first = &memory_->first;
        memory_->first.places = memory_->noisy || step.scale < 1;
    }
    FrameStats stats;
    double filter = 0;
    try {
        outcome.whole = step.pass == Pass::Refined ? render_refined(step, settings, *to, stats)
                                                   : render_quick(step, settings, *to, stats);
    } catch (const std::bad_alloc&) {
        std::lock_guard lock(mutex_);
        findings_.push_back(plain_finding("MEMORY", "there is not enough memory for the picture"));
    } catch (const CheckFailed& mistake) {
        std::lock_guard lock(mutex_);
        findings_.push_back(plain_finding(
            "INTERNAL_CHECK", std::string("a mistake of Kinora itself: ") + mistake.what()));
    }
    times = {
        stats.animate,
        stats.skin,
        stats.refit,
        sum_of(stats, {Stage::Sample, Stage::Trace, Stage::Points, Stage::Shadows, Stage::Nested}),
        sum_of(stats, {Stage::Gather, Stage::Lights, Stage::Kernels, Stage::Film, Stage::Imager}),
        0,
        0,
        step.scale,
        step.samples,
        !outcome.whole,
        0};
    if (outcome.whole) {
        if (filters) {
            StageTimer timer(filter);
            const bool known = memory_->first.places;
            memory_->noisy = known ? memory_->denoiser.filter(*posed.shown->scene, *posed.pose,
                                                              memory_->first, to->film)
                                   : memory_->first.any_noise();
        }
        Stopwatch present;
        to->scale = step.scale;
        to->samples = step.samples;
        to->refined = step.scale == 1 && step.samples == step.whole_samples &&
                      (step.pass == Pass::Refined || step.whole_samples == 1);
        finish_picture(step, *to);
        times.present = present.ms() + filter;
        to->quick = step.pass == Pass::Quick;
        to->ms = watch.ms();
        publish(std::move(to), step);
    }
    times.total = watch.ms();
    times.at = since_start_.ms();
    if (step.pass == Pass::Quick && real_time_)
        pace(times, outcome.whole,
             times.animate + times.skin + times.refit + times.present - filter - memory_->guide_ms);
    return outcome;
}

// A frame that was ended early for something else says nothing, unless it was late already.
void RenderLoop::pace(const StageTimes& times, bool whole, double fixed) {
    bool cut = false;
    {
        std::lock_guard lock(mutex_);
        cut = work_.cut && !whole;
    }
    Pacer& pacer = memory_->pacer;
    if (cut)
        pacer.cut(times.total, fixed);
    else if (whole || pacer.is_late(times.total))
        pacer.add(times.total, fixed, memory_->guide_ms);
}

bool RenderLoop::render(const Step& step, bool closer, FrameSettings settings, Picture& to,
                        FrameStats& stats) {
    Posed& posed = *step.posed;
    Diagnostics& diagnostics = *posed.diagnostics;
    posed.shows_closer = closer;
    posed.seen_pose().camera = posed.pose->camera;
    const bool whole =
        render_frame(*posed.seen(), posed.seen_pose(), time_of(*posed.shown, step.order), settings,
                     to.film, stats, diagnostics);
    std::vector<FindingText> found = kinora::take_findings(diagnostics);
    if (!found.empty()) {
        std::lock_guard lock(mutex_);
        findings_.insert(findings_.end(), found.begin(), found.end());
    }
    return whole;
}

// Diced for the scene's view as it stands. `exact`: the refined picture's own.
void RenderLoop::dice_closer(const Step& step, const FrameSettings& settings, bool exact) {
    const Posed& posed = *step.posed;
    CloserView view{time_of(*posed.shown, step.order), {}};
    if (settings.camera) view.camera = posed.seen_pose().view;
    posed.redicer->start(view);
    memory_->dices_for.reset();
    if (exact) memory_->dices_for = step.order;
}

void RenderLoop::take_closer(Posed& posed) {
    PosedScene closer = posed.redicer->take(*posed.diagnostics);
    posed.closer_view.reset();
    if (!closer) return;
    posed.shows_closer = false;
    posed.closer = std::move(closer.scene);
    posed.closer_pose = std::move(closer.pose);
    posed.closer_view = memory_->dices_for;
}

// With the finest meshes there are; while the camera comes closer, finer ones are diced meanwhile.
bool RenderLoop::render_quick(const Step& step, const FrameSettings& settings, Picture& to,
                              FrameStats& stats) {
    Posed& posed = *step.posed;
    const bool dices = real_time_ && posed.redicer;
    if (dices && posed.redicer->running() && posed.redicer->ready()) take_closer(posed);
    const bool closer = dices && posed.closer;
    const bool whole = render(step, closer, settings, to, stats);
    // In edges of the scene as loaded: the closer one may have had to be coarser.
    const double error =
        stats.dice_error * posed.seen()->dice.pixels / posed.shown->scene->dice.pixels;
    const bool known = posed.closer_view && posed.closer_view->same_picture(step.order);
    if (dices && whole && error > kMostDiceError && !known && !posed.redicer->running())
        dice_closer(step, settings, step.scale == 1);
    return whole;
}

// As kinora-render makes a frame: where displaced meshes are too coarse for it, by a scene that is
// diced for it too.
bool RenderLoop::render_refined(const Step& step, const FrameSettings& settings, Picture& to,
                                FrameStats& stats) {
    Posed& posed = *step.posed;
    FrameSettings fine = settings;
    fine.most_dice_error = posed.redicer ? kMostDiceError : 0;
    if (render(step, false, fine, to, stats)) return true;
    if (!stats.too_coarse || stop_) return false;
    const double pixels = stats.dice_error * posed.shown->scene->dice.pixels;
    const auto is_this = [&](const std::optional<ViewOrder>& view) {
        return view && view->same_picture(step.order);
    };
    if (!posed.closer || !is_this(posed.closer_view)) {
        if (!posed.redicer->running() || !is_this(memory_->dices_for))
            dice_closer(step, settings, true);
        while (!posed.redicer->ready() && !stop_)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (stop_) return false;  // it goes on; the next start() may give it up
        posed.shows_closer = false;
        posed.closer_pose.reset();
        posed.closer.reset();
        take_closer(posed);
    }
    if (posed.closer) {
        fine.most_dice_error = pixels / posed.closer->dice.pixels;
        if (render(step, true, fine, to, stats)) return true;
        if (stop_) return false;
    }
    fine.most_dice_error = 0;
    return render(step, false, fine, to, stats);
}

// The refined picture never is, nor those that no clock hurries.
bool RenderLoop::is_filtered(const Step& step) const {
    return real_time_ && step.order.filter && !step.first && step.samples < step.whole_samples;
}

// The guide, the picture's own size, and what is displayed.
void RenderLoop::finish_picture(const Step& step, Picture& to) {
    to.width = step.order.width;
    to.height = step.order.height;
    to.frame = step.order.frame;
    const Pose& pose = step.posed->seen_pose();
    to.view = pose.view;
    to.origin = step.posed->seen()->origin;
    const bool small = to.film.width != to.width || to.film.height != to.height;
    if (shows_guide(step.display.aov))
        make_guide(pose, to.width, to.height, to.guide);
    else if (small && (to.film.width >= Pacer::kNeedsGuide * to.width || step.first))
        take_guide(memory_->first, to.view, to.guide);
    else if (small)
        guide_small(pose, to);
    else
        to.guide = {};
    show_picture(step.display, memory_->enlarged, to);
}

// Rays say where the edges are, beside those that the film's own hits show: a quarter as many as
// pixels shown, at most.
void RenderLoop::guide_small(const Pose& pose, Picture& to) {
    StageTimer timer(memory_->guide_ms);
    take_guide(memory_->first, to.view, memory_->hits);
    refine_guide(pose, memory_->hits, (to.width + 1) / 2, (to.height + 1) / 2, to.guide);
}

void RenderLoop::redisplay(const Step& step) {
    const std::shared_ptr<const Picture> last = picture();
    if (!last) return;
    std::shared_ptr<Picture> to = free_picture();
    uint64_t serial = to->serial;
    *to = *last;
    to->serial = serial;
    show_picture(step.display, memory_->enlarged, *to);
    publish(std::move(to));
}

// One that nobody holds any more.
std::shared_ptr<Picture> RenderLoop::free_picture() {
    auto& pictures = memory_->pictures;
    auto found = std::find_if(pictures.begin(), pictures.end(),
                              [](const auto& picture) { return picture.use_count() == 1; });
    std::atomic_thread_fence(std::memory_order_acquire);  // after its last reader
    if (found != pictures.end()) return *found;
    return pictures.emplace_back(std::make_shared<Picture>());
}

void RenderLoop::publish(std::shared_ptr<Picture> picture) {
    picture->serial = ++memory_->serial;
    std::lock_guard lock(mutex_);
    shown_.picture = std::move(picture);
}

void RenderLoop::publish(std::shared_ptr<Picture> picture, const Step& step) {
    picture->serial = ++memory_->serial;
    const Posed& posed = *step.posed;
    PictureSource source{std::move(picture), posed.shown, posed.seen(), step.order};
    std::lock_guard lock(mutex_);
    std::swap(shown_, source);
}

}  // namespace kinora
