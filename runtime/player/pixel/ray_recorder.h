// runtime/player/pixel/ray_recorder.h: the rays of one thread, while one sample of a pixel is
// shaded.
#pragma once

#include <utility>
#include <vector>

#include "raytrace/accel.h"
#include "runtime/player/pixel/pixel_story.h"

namespace kinora {

struct Pose;
struct SceneExtent;

// From its making to its end the packets of its thread are recorded. One at a time a thread.
class RayRecorder {
  public:
    RayRecorder();
    ~RayRecorder() { stop(); }
    RayRecorder(const RayRecorder&) = delete;

    // Ends recording and traces the rays again, to where they end. Those that meet nothing end at
    // the scene's size. World space.
    void tell(const SceneExtent& scene, const Pose& pose, PixelStory& story);

    // `any`: any hit will do.
    void record(const raytrace::RayPacket16& rays, bool any);

  private:
    void stop();

    bool records_ = true;
    std::vector<std::pair<raytrace::RayPacket16, bool>> packets_;  // true: any hit will do
};

}  // namespace kinora
