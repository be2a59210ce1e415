// runtime/player/inspector.h: what is looked up in the scene that is shown, on a thread of its own
// and in a pose of its own: no picture in work is waited for.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "runtime/base/stats.h"
#include "runtime/player/picture/picture.h"
#include "runtime/player/shown_scene.h"
#include "runtime/player/state.h"
#include "runtime/player/view_order.h"

namespace kinora {

// A scene at the time and with the camera of an order, in the inspector's pose.
struct Inspected {
    const ShownScene& shown;
    const Scene& scene;  // shown.scene, or it diced for a nearer view
    Pose& pose;
    const ViewOrder& order;
    const FrameSettings& settings;  // of the refined picture
    bool stands = false;            // the pose is there; else Inspection::poses, or no camera
};

// What was found, put where it belongs by the thread that calls Inspector::take().
using Answer = std::function<void()>;

struct Inspection {
    std::shared_ptr<const ShownScene> shown;
    std::shared_ptr<const Scene> scene;
    ViewOrder order;
    bool poses = false;  // the vertices are brought to the order before `look`
    std::function<Answer(Inspected&)> look;
};

// By a ray through the pixel's center of the order's picture; its color is to come.
PickedPixel pick_pixel(const Inspected& inspected, int x, int y);
// The color that the pixel has in a picture of that order.
vec4 color_at(const Picture& picture, int x, int y);
// How the first sample of the pixel in the refined picture came by its color.
std::shared_ptr<const PixelStory> story_of(const Inspected& inspected, int x, int y);

class Inspector {
  public:
    // `wake` is called from the thread after each inspection.
    explicit Inspector(std::function<void()> wake);
    ~Inspector();  // ends the one in work
    Inspector(const Inspector&) = delete;

    void add(Inspection inspection);
    // The pose of another scene is given up.
    void keep(const std::shared_ptr<const ShownScene>& shown);

    std::vector<Answer> take();               // those found since, in the order of add()
    uint64_t asked() const;                   // so many inspections were added
    bool has_answered(uint64_t asked) const;  // the first so many, and the answers were taken
    bool has_answered() const { return has_answered(asked()); }
    bool idle() const;

  private:
    struct Posed;  // the pose, and whose it is
    void run();
    Answer inspect(const Inspection& inspection);
    Posed& posed_for(const Inspection& inspection);

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable wanted_;
    // Guarded by the mutex.
    std::deque<Inspection> inspections_;
    std::vector<Answer> answers_;
    uint64_t asked_ = 0, answered_ = 0, taken_ = 0;
    bool working_ = false, quit_ = false;
    bool overtaken_ = false;                        // something waits for the one in work
    std::shared_ptr<const ShownScene> other_than_;  // the posed of any other one is given up
    Stopwatch began_;
    // Of the thread.
    std::atomic<int> stop_{0};
    std::unique_ptr<Posed> posed_;
    std::thread thread_;
};

}  // namespace kinora
