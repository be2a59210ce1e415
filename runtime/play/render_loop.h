// runtime/play/render_loop.h: the thread that makes pictures of the newest order.
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
#include "runtime/play/display.h"
#include "runtime/play/pacer.h"
#include "runtime/play/session/free_camera.h"
#include "runtime/play/shown_scene.h"

namespace kinora {

struct PlacedCamera;  // runtime/scene/camera.h

// What a picture is to show.
struct ViewOrder {
    double frame = 0;
    std::optional<FreeCamera> camera;  // none: the scene's camera `camera_index`
    // The free camera moves with a node that was there when it began to.
    std::optional<std::pair<std::string, dvec3>> follow;
    uint32_t camera_index = 0;
    uint32_t only_light = kNone;  // of Scene::lights
    int width = 640, height = 360;
    double exposure = 0;   // stops above the request's
    bool playing = false;  // the next one comes soon: not refined, and not cancelled for it
    bool refine = true;
    bool adapt = true;  // fewer pixels while it moves
    double hold_rate = 30;

    // The same picture, however it is displayed and refined.
    bool same_picture(const ViewOrder& other) const;
};

// Done between two frames, on the thread of the pictures; what it gives is run by who takes it.
using Answer = std::function<void()>;
struct Question {
    std::function<Answer(ShownScene&)> ask;
    bool posed = false;  // only once the scene stands as the last order wants it
};

// The view of an order, without a picture of it. For questions. Nothing where there is none.
std::optional<raytrace::Camera> view_of(ShownScene& scene, const ViewOrder& order);

// What the refined picture of an order is made with, and its time in seconds. `placed` keeps the
// camera that is moved by hand.
FrameSettings refined_settings(ShownScene& scene, const ViewOrder& order, PlacedCamera& placed);
double time_of(const ShownScene& scene, const ViewOrder& order);

// Where a node stands at a frame; nothing where there is none of that name. Likewise.
std::optional<dvec3> place_of(ShownScene& scene, const std::string& node, double frame);

class RenderLoop {
  public:
    // `wake` is called from the thread after each picture. Without `real_time` every picture has
    // all its pixels, and one that is refined is made at once with all samples.
    RenderLoop(bool real_time, std::function<void()> wake);
    ~RenderLoop();
    RenderLoop(const RenderLoop&) = delete;

    // The scene from now on; its pictures follow the next order.
    void show(std::shared_ptr<ShownScene> scene);
    // Other kernels in that scene, between two frames.
    void swap(SwappedShaders shaders);
    void order(const ViewOrder& order, const DisplaySettings& display);
    void ask(Question question);

    std::shared_ptr<const Picture> picture() const;
    std::vector<Answer> take_answers();
    bool answered() const;  // all that was asked
    std::vector<FindingText> take_findings();
    std::vector<StageTimes> times() const;
    uint64_t frames() const;  // begun
    bool idle() const;        // nothing left to do for the last order
    bool caught_up() const;   // the last order has a picture, refined or not

  private:
    enum class Pass : uint8_t { Quick, Whole, Some, Refined, Done };
    struct Step {
        Pass pass = Pass::Quick;
        ViewOrder order;
        DisplaySettings display;
        std::shared_ptr<ShownScene> scene;
        std::optional<Question> question;
        bool display_only = false;
        double scale = 1;
        int samples = 1;
        int whole_samples = 1;
    };
    struct Outcome {
        bool whole = false;
        StageTimes times;
    };

    void run();
    std::optional<Step> next_step();
    void plan(Step& step) const;
    Pass after(const Step& step) const;
    void finish(const Step& step, const Outcome& outcome);
    Outcome make(const Step& step);
    bool render(const Step& step, Scene& scene, FrameSettings settings, Picture& to,
                FrameStats& stats);
    bool render_refined(const Step& step, const FrameSettings& settings, Picture& to,
                        FrameStats& stats);
    void finish_picture(const Step& step, Picture& to);
    void redisplay(const Step& step);
    void answer(const Step& step);
    std::shared_ptr<Picture> free_picture();
    void publish(std::shared_ptr<Picture> picture);

    const bool real_time_;
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_;
    // Guarded by the mutex.
    std::shared_ptr<ShownScene> scene_;
    ViewOrder order_;
    DisplaySettings display_;
    std::vector<SwappedShaders> swaps_;
    std::deque<Question> questions_;
    std::vector<Answer> answers_;
    std::shared_ptr<Picture> shown_;
    std::vector<FindingText> findings_;
    std::deque<StageTimes> times_;
    Pass next_ = Pass::Done;
    bool display_changed_ = false, working_ = false, quit_ = false;
    std::optional<Step> in_work_;
    Stopwatch work_began_;
    const Stopwatch since_start_;
    uint64_t frames_ = 0;
    // Of the thread.
    std::atomic<int> stop_{0};
    struct Memory;
    std::unique_ptr<Memory> memory_;
    std::thread thread_;
};

}  // namespace kinora
