// runtime/play/pixel/ray_recorder.h: the rays of one thread, while one sample of a pixel is shaded.
#pragma once

#include <thread>
#include <utility>
#include <vector>

#include "raytrace/packet_recorder.h"
#include "runtime/play/pixel/pixel_story.h"

namespace kinora {

// From its making to its end all packets are recorded. One at a time, as PointRecorder.
class RayRecorder final : public raytrace::PacketRecorder {
  public:
    RayRecorder() { raytrace::record_packets(this); }
    ~RayRecorder() override { stop(); }
    RayRecorder(const RayRecorder&) = delete;

    void closest(const raytrace::RayPacket16& rays) override { record(rays, false); }
    void any(const raytrace::RayPacket16& rays) override { record(rays, true); }

    // Ends recording and traces the rays again, to where they end. Those that meet nothing end at
    // the scene's size. World space.
    void tell(const Scene& scene, const Pose& pose, PixelStory& story);

  private:
    void record(const raytrace::RayPacket16& rays, bool any);
    void stop() { raytrace::record_packets(nullptr); }

    const std::thread::id thread_ = std::this_thread::get_id();
    std::vector<std::pair<raytrace::RayPacket16, bool>> packets_;  // true: any hit will do
};

}  // namespace kinora
