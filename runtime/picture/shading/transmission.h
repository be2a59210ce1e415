// runtime/picture/shading/transmission.h: what light is left behind transparent surfaces and
// objects.
#pragma once

#include <span>

#include "runtime/picture/shading/lane_rays.h"
#include "runtime/picture/shading/light_records.h"
#include "runtime/picture/shading/rays/smooth_surface.h"
#include "runtime/picture/shading/volumes.h"

namespace kinora {

// Each wavefront runs on the calling thread; no task is started.
class Transmission {
  public:
    Transmission(const ShadingFrame& frame, KernelRunner& kernels, LightRecords& lights,
                 Volumes& volumes)
        : frame_(frame), kernels_(kernels), lights_(lights), volumes_(volumes) {}

    // What passes of each ray; consumes the rays. Their slots are 0, 1, 2, ... `tag`: theirs.
    void pass(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
              std::span<vec3> through);
    // The same of rays that are known to meet something; `through` is 1 before.
    void pass_blocked(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
                      std::span<vec3> through);
    // The same of rays that meet nothing opaque.
    void pass_transparent(raytrace::RayBatch& rays, const RayTag& tag, ThreadMemory& memory,
                          vec3* through);

  private:
    // The same of the rays of these numbers, which ascend; the others pass.
    void pass_blocked(raytrace::RayBatch& rays, std::span<const uint32_t> which, const RayTag& tag,
                      ThreadMemory& memory, std::span<vec3> through);
    void pass_ends(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                   const RayTag& ray, ThreadMemory& memory, vec3* through);
    void opacity(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory, vec3* Oi);
    void run_opacity(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                     const ShaderInstance& look, const RayTag& ray, ThreadMemory& memory, vec3* Oi);

    const ShadingFrame& frame_;
    KernelRunner& kernels_;
    LightRecords& lights_;
    Volumes& volumes_;
};

// Rays from lit points to their light, a whole packet at a time: those of several grids and lights
// go together. What is opaque takes all of Cl; what is transparent dims it.
class ShadowQueue final : public LightShadows {
  public:
    // `from`: the tag of all grids.
    ShadowQueue(const ShadingFrame& frame, Transmission& transmission, ThreadMemory& memory,
                const RayTag& from);
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
    void aim(Packet& packet);
    uint32_t block(uint32_t lanes, uint32_t mask);
    void move(const Packet& from, int lane, Packet& to);
    void settle(const Packet& packet, uint32_t lanes, uint32_t blocked);
    uint32_t lift(uint32_t lanes);
    void flush();
    void flush_lifted();
    void flush_lowered();
    void flush_all();
    void keep(const Packet& packet, int lane);
    void pass_rest();

    const ShadingFrame& frame_;
    Transmission& transmission_;
    ThreadMemory& memory_;
    const RayTag tag_;
    const bool dims_;      // what is transparent may dim a ray
    const bool straight_;  // rays that meet nothing lose nothing
    const uint32_t mask_;  // what a ray is first traced against
    mat3 accel_from_camera_;
    SmoothSurface smooth_;
    const raytrace::HitBatch* hits_ = nullptr;  // of all rays that wait
    bool of_surface_ = false;
    raytrace::RayPacket16 packet_{};  // Embree looks at lanes that are not active, too
    Packet fresh_;
    Packet lifted_;     // rays that leave a smooth surface, if the way there is free
    uint32_t met_ = 0;  // bit j: something blocks lifted ray j
    Packet lowered_;    // rays that leave their facets after all
    uint32_t chosen_[kGridPoints];
    // Rays that what is transparent may dim, and the point of each.
    NestedWavefront rest_;
    std::span<Target> rest_targets_;
};

// The same, of one light at once.
class ShadowRays final : public LightShadows {
  public:
    ShadowRays(const ShadingFrame& frame, Transmission& transmission)
        : frame_(frame), transmission_(transmission) {}
    void cast(const Grid& grid, const LightPoints& at, const SentLight& light) override;

  private:
    const ShadingFrame& frame_;
    Transmission& transmission_;
};

}  // namespace kinora
