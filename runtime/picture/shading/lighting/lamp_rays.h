// runtime/picture/shading/lighting/lamp_rays.h: rays from lit points to their lights: automatic
// shadows.
#pragma once

#include <span>

#include "raytrace/points/points.h"
#include "runtime/picture/shading/lighting/light_records.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/picture/shading/rays/smooth_surface.h"

namespace kinora {

// Makes the rays sixteen at a time. Those of several grids and lights wait together until they fill
// a batch, which goes through the queue of rays. What is opaque takes all of Cl; what is
// transparent dims it.
class LampRays final : public LightShadows {
  public:
    // `from`: the tag of all grids.
    LampRays(const ShadingFrame& frame, RayQueue& queue, ThreadMemory& memory, const RayTag& from);
    // Grids, points and colours must live until finish().
    void cast(const Grid& grid, const LightPoints& at, const SentLight& light) override;
    void finish();

  private:
    // The colour that a ray may take.
    struct Target {
        float* Cl[3];
        uint32_t point;
    };
    // Up to sixteen rays, in accel space.
    struct Packet {
        raytrace::LeavingRays rays{};
        float N[3][raytrace::kPacket] = {};  // of the smooth surface; what is known of it
        uint32_t normals[raytrace::kPacket] = {};
        uint32_t hit[raytrace::kPacket];
        Target target[raytrace::kPacket];
        int count = 0;

        uint32_t lanes() const { return count == raytrace::kPacket ? 0xffffu : (1u << count) - 1; }
    };

    size_t choose(const LightPoints& at, const SentLight& light);
    void take(const Grid& grid, const LightPoints& at, const SentLight& light,
              std::span<const uint32_t> points);
    using Rows = float[3][raytrace::kPacket];
    void turn_in(const Rows& L, const Rows& N, size_t count);
    void aim_before(const LightSamples& samples, std::span<const uint32_t> points, size_t first);
    uint32_t on_facets() const;
    uint32_t lift(uint32_t lanes);
    void flush();
    void flush_lifted();
    void flush_lowered();
    void flush_all();
    void aim(Packet& packet);
    uint32_t block(uint32_t lanes, uint32_t mask);
    void add(const Packet& packet, uint32_t lanes);
    void send();

    const ShadingFrame& frame_;
    RayQueue& queue_;
    ThreadMemory& memory_;
    const RayTag tag_;
    mat3 accel_from_camera_;
    SmoothSurface smooth_;
    const raytrace::HitBatch* hits_ = nullptr;  // of all rays in packets
    bool of_surface_ = false;
    raytrace::RayPacket16 packet_{};  // Embree looks at lanes that are not active, too
    Packet fresh_;
    Packet lifted_;   // rays that leave a smooth surface, if the way there is free
    Packet lowered_;  // those whose way is not
    uint32_t chosen_[kGridPoints];
    NestedWavefront batch_;
    std::span<Target> targets_;  // of each ray of the batch
};

// The same, of one light at once.
class LampRaysAtOnce final : public LightShadows {
  public:
    LampRaysAtOnce(const ShadingFrame& frame, RayQueue& queue) : frame_(frame), queue_(queue) {}
    void cast(const Grid& grid, const LightPoints& at, const SentLight& light) override;

  private:
    const ShadingFrame& frame_;
    RayQueue& queue_;
};

}  // namespace kinora
