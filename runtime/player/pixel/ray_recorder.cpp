// runtime/player/pixel/ray_recorder.cpp: packets kept, and traced again.
#include "runtime/player/pixel/ray_recorder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "raytrace/packet_recorder.h"
#include "runtime/scene/extent.h"
#include "runtime/scene/pose.h"

namespace kinora {

namespace {

constexpr size_t kMostPackets = 4096, kMostRays = 10'000;

StoryRay::Kind kind_of(uint32_t mask, bool any) {
    if (mask & raytrace::kMaskCamera) return StoryRay::Kind::Eye;
    // What an opaque surface does not block is looked for among the others.
    return any || !(mask & raytrace::kMaskOpaque) ? StoryRay::Kind::Shadow : StoryRay::Kind::Traced;
}

bool has_place(dvec3 v) {
    return std::isfinite(v.x + v.y + v.z);
}

thread_local RayRecorder* t_rays = nullptr;

// Sees the packets of all threads while one of them records. It is there for good, since a thread
// may be about to call it when the last recorder ends.
class Packets final : public raytrace::PacketRecorder {
  public:
    void closest(const raytrace::RayPacket16& rays) override {
        if (t_rays) t_rays->record(rays, false);
    }
    void any(const raytrace::RayPacket16& rays) override {
        if (t_rays) t_rays->record(rays, true);
    }
    void count(int recorders) {
        std::lock_guard lock(mutex_);
        recorders_ += recorders;
        raytrace::record_packets(recorders_ > 0 ? this : nullptr);
    }

  private:
    std::mutex mutex_;
    int recorders_ = 0;
} g_packets;

}  // namespace

RayRecorder::RayRecorder() {
    t_rays = this;
    g_packets.count(1);
}

void RayRecorder::stop() {
    if (!std::exchange(records_, false)) return;
    g_packets.count(-1);
    t_rays = nullptr;
}

void RayRecorder::record(const raytrace::RayPacket16& rays, bool any) {
    // One more than is kept says that there were more.
    if (packets_.size() <= kMostPackets) packets_.emplace_back(rays, any);
}

void RayRecorder::tell(const SceneExtent& scene, const Pose& pose, PixelStory& story) {
    stop();
    story.rays_cut = packets_.size() > kMostPackets;
    for (const auto& [rays, any] : packets_) {
        raytrace::HitPacket16 hits;
        raytrace::TraceCounters ignored;
        const uint32_t met = pose.accel.intersect16(rays, hits, ignored);
        for (uint32_t left = rays.active & 0xffffu; left; left &= left - 1) {
            const int k = std::countr_zero(left);
            const bool hit = met >> k & 1;
            const dvec3 org(rays.org_x[k], rays.org_y[k], rays.org_z[k]);
            const dvec3 dir(rays.dir_x[k], rays.dir_y[k], rays.dir_z[k]);
            const double far =
                scene.size /
                std::max(std::sqrt(dir.x * dir.x + dir.y * dir.y + dir.z * dir.z), 1e-30);
            const double t = hit ? double(hits.t[k]) : std::min(double(rays.tfar[k]), far);
            const dvec3 to = org + t * dir;
            if (!has_place(org) || !has_place(to) || t < 0) continue;
            if (story.rays.size() == kMostRays) return void(story.rays_cut = true);
            story.rays.push_back(
                {kind_of(rays.mask[k], any), scene.origin + org, scene.origin + to, hit});
        }
    }
}

}  // namespace kinora
