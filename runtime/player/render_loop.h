// runtime/player/render_loop.h: the thread that makes pictures of the newest order.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "runtime/base/stats.h"
#include "runtime/player/display.h"
#include "runtime/player/shown_scene.h"
#include "runtime/player/view_order.h"

namespace kinora {

// A picture, and what made it.
struct PictureSource {
    std::shared_ptr<const Picture> picture;
    std::shared_ptr<const ShownScene> shown;
    std::shared_ptr<const Scene> scene;  // of `shown`, or it diced for a nearer view
    ViewOrder order;
};

class RenderLoop {
  public:
    // `wake` is called from the thread after each picture. Without `real_time` every picture has
    // all its pixels, and one that is refined is made at once with all samples.
    RenderLoop(bool real_time, std::function<void()> wake);
    ~RenderLoop();
    RenderLoop(const RenderLoop&) = delete;

    // The scene from now on, with its first order: one made for another scene may name a camera
    // that this one does not choose.
    void show(std::unique_ptr<MadeScene> made, const ViewOrder& order,
              const DisplaySettings& display);
    // The same scene with other shaders, from the next frame on.
    void swap(std::shared_ptr<const ShownScene> swapped);
    void order(const ViewOrder& order, const DisplaySettings& display);

    std::shared_ptr<const Picture> picture() const;
    PictureSource source() const;  // of picture(), or nothing
    std::vector<FindingText> take_findings();
    std::vector<StageTimes> times() const;
    uint64_t frames() const;  // begun
    bool idle() const;        // nothing left to do for the last order
    // Counts what needs another picture: orders, scenes, shaders.
    uint64_t ordered() const;
    // Whether what was ordered by then has a picture, refined or not, or none can be made.
    bool has_made(uint64_t ordered) const;
    bool caught_up() const { return has_made(ordered()); }

  private:
    enum class Pass : uint8_t { Quick, Whole, Some, Refined, Done };
    struct Posed;  // a scene, and what its pictures are made in: of the thread alone
    struct Step {
        Pass pass = Pass::Quick;
        uint64_t ordered = 0;
        ViewOrder order;
        DisplaySettings display;
        std::shared_ptr<Posed> posed;
        bool display_only = false;
        bool first = false;  // of another scene
        double scale = 1;
        int samples = 1;
        int whole_samples = 1;
    };
    struct Outcome {
        bool whole = false;
        StageTimes times;
    };

    void want_picture();
    void take_order(const ViewOrder& order, const DisplaySettings& display);
    void run();
    void end_late_frames();
    bool is_overtaken() const;
    double time_left() const;
    std::optional<Step> next_step();
    void plan(Step& step) const;
    Pass after(const Step& step) const;
    void finish(const Step& step, const Outcome& outcome);
    Outcome make(const Step& step);
    void pace(const StageTimes& times, bool whole, double fixed);
    bool render(const Step& step, bool closer, FrameSettings settings, Picture& to,
                FrameStats& stats);
    bool render_quick(const Step& step, const FrameSettings& settings, Picture& to,
                      FrameStats& stats);
    void dice_closer(const Step& step, const FrameSettings& settings, bool exact);
    void take_closer(Posed& posed);
    bool render_refined(const Step& step, const FrameSettings& settings, Picture& to,
                        FrameStats& stats);
    bool is_filtered(const Step& step) const;
    void finish_picture(const Step& step, Picture& to);
    void guide_small(const Pose& pose, Picture& to);
    void redisplay(const Step& step);
    std::shared_ptr<Picture> free_picture();
    void publish(std::shared_ptr<Picture> picture);
    void publish(std::shared_ptr<Picture> picture, const Step& step);

    const bool real_time_;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_, overtaken_;
    // Guarded by the mutex.
    std::shared_ptr<Posed> posed_;
    std::shared_ptr<const ShownScene> swapped_;  // for it; null: none
    ViewOrder order_;
    DisplaySettings display_;
    PictureSource shown_;
    std::vector<FindingText> findings_;
    std::deque<StageTimes> times_;
    Pass next_ = Pass::Done;
    bool begins_ = false;  // another scene: its first picture is to come soon
    bool display_changed_ = false, working_ = false, quit_ = false;
    std::optional<Step> in_work_;
    struct Work {
        Stopwatch began;
        double limit = 0;  // ms that it may take
        bool cut = false;  // it took longer
    } work_;
    const Stopwatch since_start_;
    struct {
        uint64_t ordered = 0, made = 0;  // see ordered(), has_made()
        uint64_t begun = 0;
    } count_;
    // Of the thread.
    std::atomic<int> stop_{0};
    struct Memory;
    std::unique_ptr<Memory> memory_;
    std::vector<std::thread> threads_;  // run(), end_late_frames()
};

}  // namespace kinora
