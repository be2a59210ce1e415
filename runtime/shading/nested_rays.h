// runtime/shading/nested_rays.h: rays that shaders shoot: where they begin, how they spread, and
// what they see.
#pragma once

#include <algorithm>
#include <bit>
#include <span>

#include "runtime/shading/grid.h"

namespace kinora {

class HitShader;

inline constexpr float kMiss = 1e30f;       // distance of a ray that met nothing
inline constexpr int kMostSamples = 65536;  // of one call at one point

// Where the rays of one lane begin, in accel space.
struct RayStart {
    vec3 P, error;     // with the bound of its rounding error
    vec3 Ng;           // of the surface that P is on, length 1; 0: on none that is known
    uint32_t hit = 0;  // of the grid's batch: the point that asks
};

// An unmodified P is the hit itself (docs/decisions.md#precision); any other carries the error of
// coming from current space.
RayStart ray_start(const Grid& grid, size_t point, vec3 P);

// A ray of a batch from there in a direction of any length but 0; `bias` >= 0 leaves out what is
// nearer. Its length counts in units of the scene.
void add_ray(raytrace::RayBatch& rays, const Grid& grid, const RayStart& start, vec3 dir,
             float tfar, float bias, uint32_t path, uint32_t slot, float share = 1);

// Gives the ray added last the spread of the ray that saw `hit`, as far as directions go: without
// it the footprint stays as wide as it is at `hit`.
void spread_ray(raytrace::RayBatch& rays, const raytrace::HitBatch& from, uint32_t hit);

// The share of the eye's ray that each ray of a point's next call of so many samples has, which
// keeps shaders that shoot several rays a hit from multiplying them without end (BMRT and PRMan
// stop such shaders at a depth of 2 to 4). 0: too little, no ray is shot.
float ray_share(Grid& grid, size_t point, int samples);

// The same for rays whose depth is counted apart (bounces): too little takes samples away, down to
// one, which leaves the mean what it is. Never 0.
float fit_samples(Grid& grid, size_t point, int& samples);

// Budgets (docs/rays.md#budgets). Whether a point may shoot the n rays of its next call: it may
// until its budget is spent, so the last call is answered whole.
bool spend_rays(Grid& grid, size_t point, int n);
// The same for samples of what may take fewer: at hits of nested rays no more than the budget has
// left. 0: none.
int spend_samples(Grid& grid, size_t point, int n);
// A call of n rays that depth or share forbid. False once there were too many of them.
bool refuse_rays(Grid& grid, size_t point, int n);
// The service raylimit.
void end_loops(Grid& grid, const jit::ServiceCall& call);

// How a ray goes on at a point that reflects `weight` of what a traced ray sees and lets `through`
// pass: both ways at its first hits, at later ones either, at random by its share. What the traced
// ray sees counts `factor` times (0: it is not shot). Below 0: not known; the way is followed.
struct TracedRay {
    float factor = 1;
    float weight = 1;  // RayBatch::weight
};
TracedRay choose_way(Grid& grid, size_t point, float weight, float through);

// The smooth surface that the normals of triangles describe, for rays to lights: a facet that looks
// away from a light which that surface sees would shade itself, in black blocks (J. Hanika, Hacking
// the Shadow Terminator, Ray Tracing Gems II, 2021).
class SmoothSurface {
  public:
    explicit SmoothSurface(const Scene& scene) : scene_(scene) {}
    // From a hit to that surface; accel space. 0 where the facet sees the light or is shaded on
    // both accounts, where it is flat, and where the surface is hollow.
    vec3 way_from(const raytrace::HitBatch& hits, uint32_t hit, vec3 to_light);

  private:
    void enter(uint32_t row);

    const Scene& scene_;
    uint32_t row_ = kNone;
    mat3 linear_{1.0f}, normals_{1.0f};  // of that row
};

// Whether a grid's points are hits of its surface: lights read those of the points they light.
inline bool on_surface(const Grid& grid) {
    return (grid.lit ? *grid.lit : grid).look->kind == ShaderInstanceKind::Surface;
}

// Whether nothing stands on that way from a facet to its smooth surface.
bool is_way_free(const raytrace::Accel& accel, vec3 P, vec3 error, vec3 Ng, vec3 way,
                 raytrace::TraceCounters& counters);

// The axes of a cone and the direction of sample k of n stratified ones in it.
struct Cone {
    vec3 x, y, z;  // orthonormal, z the axis
    float cosine;  // of the angle between axis and side
    bool by_cosine;
    Cone(vec3 axis, float angle, bool cosine_weighted);
    vec3 direction(uint32_t k, uint32_t seed) const;
};

// Rays that see something: `type` and `label` are interned texts.
RayTag deeper(const Grid& grid, RayKind kind, int32_t label);

// What a ray saw.
struct SeenByRay {
    vec3 color{0.0f};
    vec3 open{1.0f};         // share of what lies behind that is let through
    float distance = 1e30f;  // of the nearest surface
};

class NestedRays {
  public:
    NestedRays(const ShadingFrame& frame, HitShader& hits) : frame_(frame), hits_(hits) {}
    // Colour along each ray through what is not opaque, what of it is still open behind, and the
    // distance of the nearest surface, by slot. Consumes the rays.
    void see(raytrace::RayBatch& rays, uint32_t depth, const RayTag& tag, ThreadMemory& memory,
             std::span<SeenByRay> seen);

  private:
    void see_beyond(const raytrace::RayBatch& rays, const raytrace::HitBatch& hits,
                    const RayTag& tag, ThreadMemory& memory, std::span<SeenByRay> seen);

    const ShadingFrame& frame_;
    HitShader& hits_;
};

// Lanes of a service call, by name of the argument row.
class Lanes {
  public:
    explicit Lanes(const jit::ServiceCall& call) : call_(call), mask_(call.mask) {}
    bool asks(int lane) const { return mask_ >> lane & 1; }
    float number(int row, int lane) const { return call_.args[row * jit::kMaxLanes + lane]; }
    int32_t integer(int row, int lane) const { return jit::bits_of(number(row, lane)); }
    vec3 triple(int row, int lane) const {
        return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
    }
    void set(int row, int lane, float value) const {
        call_.results[row * jit::kMaxLanes + lane] = value;
    }
    void set(int row, int lane, vec3 v) const {
        for (int k = 0; k < 3; ++k) set(row + k, lane, v[k]);
    }
    size_t point(int lane) const { return size_t(call_.first + lane); }
    // These lanes only, where they ask.
    Lanes(const Lanes& all, uint32_t lanes) : call_(all.call_), mask_(all.mask_ & lanes) {}
    // Calls f(lanes) for the lanes of each text that argument `row` has, one text after the other:
    // rays that go together share their label.
    template <class F>
    void for_each_text(int row, F&& f) const {
        for (uint32_t left = mask_; left;) {
            int32_t text = integer(row, std::countr_zero(left));
            uint32_t same = 0;
            for (uint32_t rest = left; rest; rest &= rest - 1)
                if (int lane = std::countr_zero(rest); integer(row, lane) == text)
                    same |= 1u << lane;
            f(Lanes(*this, same));
            left &= ~same;
        }
    }
    int first() const { return std::countr_zero(mask_); }
    int samples(int row, int lane) const {
        float n = number(row, lane);
        return n >= 1 ? int(std::min(n + 0.5f, float(kMostSamples))) : 1;
    }
    // Of all samples of the call at this lane: the point, the call in the source, its loops.
    uint32_t seed(int lane) const;

  private:
    const jit::ServiceCall& call_;
    uint32_t mask_;
};

}  // namespace kinora
