// runtime/picture/shading/lane_rays.h: rays that shaders send: where they begin and how they
// spread, one by one and sixteen at a time.
#pragma once

#include "raytrace/points/points.h"
#include "raytrace/random/series.h"
#include "runtime/picture/rays/ray_kernels.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/rays/lanes.h"

namespace kinora {

inline constexpr float kMiss = 1e30f;  // distance of a ray that met nothing

// Where the rays of one lane begin, in accel space.
struct RayStart {
    vec3 P, error;     // with the bound of its rounding error
    vec3 Ng;           // of the surface that P is on, length 1; 0: on none that is known
    uint32_t hit = 0;  // of `hits`: the point that asks
    const raytrace::HitBatch* hits =
        nullptr;  // the grid's, or those that a light on geometry lights
};

// An unmodified P is the hit itself (docs/decisions.md#precision), as is Ps in a light's shader;
// any other carries the error of coming from current space.
RayStart ray_start(const Grid& grid, size_t point, vec3 P);

// A ray of a batch from there in a direction of any length but 0; `bias` >= 0 leaves out what is
// nearer. Its length counts in units of the scene.
void add_ray(raytrace::RayBatch& rays, const Grid& grid, const RayStart& start, vec3 dir,
             float tfar, float bias, uint32_t path, uint32_t slot);

// Gives the ray added last the spread of the ray that saw `hit`, as far as directions go, and what
// a curved mirror adds: without it the footprint stays as wide as it is at `hit`.
void spread_ray(raytrace::RayBatch& rays, const Grid& grid, const raytrace::HitBatch& from,
                uint32_t hit);

// Gives the rays of a batch from `first` on what they have from the hits that they leave, one each.
// Their footprint stays as wide as it is there.
void inherit(raytrace::RayBatch& rays, size_t first, const raytrace::HitBatch& from,
             std::span<const uint32_t> hits);

// Whether a grid's points are hits of its surface: lights read those of the points they light.
inline bool on_surface(const Grid& grid) {
    return (grid.lit ? *grid.lit : grid).look->kind == ShaderInstanceKind::Surface;
}

// What the samples of a call are drawn from at one lane, whose point is that hit.
raytrace::SampleSeries series_of(const Grid& grid, const Lanes& lanes, int lane,
                                 const raytrace::HitBatch& hits, uint32_t hit);

// The rays of the lanes of a call, made sixteen at a time: each is what add_ray() and spread_ray()
// would make. All lanes that ask must be told their way before the first ray is made.
class LaneRays {
  public:
    // Rays leave from the argument rows from `P` on. `way`: rows of a direction in current space,
    // of any length but 0.
    LaneRays(const Grid& grid, const Lanes& lanes, int P, int way, bool by_cosine);
    // Along the way alone, at its unit vector that the caller finds.
    vec3 way(int lane) const;
    void set_straight(int lane, vec3 unit);
    // In a cone about the way, of half the opening angle, so many samples.
    void set_cone(int lane, float angle, int samples);
    void set_reach(int lane, float tfar, float bias);
    // RayBatch::share and allowance.
    void set_budget(int lane, float share, float allowance);
    void set_weight(int lane, float weight);

    // The direction of a sample; the cone that it is in.
    vec3 direction(int lane, uint32_t k);
    Cone cone(int lane);
    // Slots count up from `slot`.
    void add(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot);

  private:
    bool of_light() const;
    void find_hits(int P);
    void enter_hits();
    void enter_bends();
    void enter_starts(int P);
    const float* arguments(int row) const;
    void aim();
    void put(raytrace::RayBatch& rays, const RaySamples& samples, size_t count, uint32_t slot);

    const Grid& grid_;
    const Lanes& lanes_;
    const raytrace::HitBatch* hits_[kSixteen];
    uint32_t hit_[kSixteen];
    uint32_t part_[kSixteen];   // SampleSeries
    uint32_t first_[kSixteen];  // sample of the lane's
    bool dense_ = false;        // one behind the other
    RayWants wants_;
    RayLanes lane_;
    bool aimed_ = false;
    float angle_ = 0, cosine_ = 1;  // of the cone set last
    // What direction() made last.
    float made_[3][kSixteen];
    int lane_made_ = -1;
    uint32_t block_made_ = 0;
};

}  // namespace kinora
