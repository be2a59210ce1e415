// runtime/picture/shading/nested_rays.h: rays that shaders shoot: where they begin, how they
// spread, and what they see.
#pragma once

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>
#include <span>

#include "raytrace/points/points.h"
#include "raytrace/random/series.h"
#include "runtime/base/parallel.h"
#include "runtime/picture/rays/ray_kernels.h"
#include "runtime/picture/shading/grid.h"

namespace kinora {

class HitShader;

inline constexpr float kMiss = 1e30f;       // distance of a ray that met nothing
inline constexpr int kMostSamples = 65536;  // of one call at one point

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
             float tfar, float bias, uint32_t path, uint32_t slot, float share = 1);

// Gives the ray added last the spread of the ray that saw `hit`, as far as directions go, and what
// a curved mirror adds: without it the footprint stays as wide as it is at `hit`.
void spread_ray(raytrace::RayBatch& rays, const Grid& grid, const raytrace::HitBatch& from,
                uint32_t hit);

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

// The cosine between facet and light above which a facet is not left.
inline constexpr float kSeesLight = 0.1f;

// The smooth surface that the normals of triangles describe, for rays to lights: a facet that looks
// away from a light which that surface sees would shade itself, in black blocks (J. Hanika, Hacking
// the Shadow Terminator, Ray Tracing Gems II, 2021).
class SmoothSurface {
  public:
    SmoothSurface(const Scene& scene, const Pose& pose) : scene_(scene), pose_(pose) {}
    // From a hit to that surface; accel space. 0 where the facet sees the light or is shaded on
    // both accounts, where it is flat, and where the surface is hollow.
    vec3 way_from(const raytrace::HitBatch& hits, uint32_t hit, vec3 to_light);
    // How its unit normal on the side that the hit's ray came from turns over the hit's footprint,
    // a pixel in x and in y. False where it is flat.
    bool bend_at(const raytrace::HitBatch& hits, uint32_t hit, vec3& dNdx, vec3& dNdy);

  private:
    // What a row of the scene has for its normals.
    struct Row {
        uint32_t number = kNone;
        std::span<const uint32_t> normal_corners, triangles;
        std::span<const vec4> normals, positions;
        mat3 from_rest{1.0f}, normals_from_rest{1.0f};
    };
    void enter(uint32_t row);
    const uint32_t* corners(uint32_t primitive) const;

    const Scene& scene_;
    const Pose& pose_;
    Row row_;
};

// Whether a grid's points are hits of its surface: lights read those of the points they light.
inline bool on_surface(const Grid& grid) {
    return (grid.lit ? *grid.lit : grid).look->kind == ShaderInstanceKind::Surface;
}

// Whether nothing stands on that way from a facet to its smooth surface.
bool is_way_free(const raytrace::Accel& accel, vec3 P, vec3 error, vec3 Ng, vec3 way,
                 raytrace::TraceCounters& counters);

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
    const jit::ServiceCall& call() const { return call_; }
    uint32_t mask() const { return mask_; }
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
    // What tells the point apart; the call in the source, with its loops.
    uint32_t own(int lane) const { return uint32_t(integer(0, lane)); }
    uint32_t site(int lane) const { return uint32_t(integer(1, lane)); }
    // Of all samples of the call at this lane.
    uint32_t seed(int lane) const { return raytrace::hash(own(lane), site(lane)); }

  private:
    const jit::ServiceCall& call_;
    uint32_t mask_;
};

// The samples of some lanes: of which lane each is, and its number there.
struct SampleSpan {
    std::span<const uint8_t> lane;
    std::span<const uint32_t> number;

    size_t size() const { return lane.size(); }
    SampleSpan subspan(size_t first, size_t count) const {
        return {lane.subspan(first, count), number.subspan(first, count)};
    }
};

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
    void set_reach(int lane, float tfar, float bias, float share);
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

// The rays that a call sends from each lane.
struct RayPlan {
    int count[jit::kMaxLanes] = {};
    float share[jit::kMaxLanes] = {};
    TracedRay way[jit::kMaxLanes];

    bool any() const {
        return std::any_of(std::begin(count), std::end(count), [](int n) { return n > 0; });
    }
};

// Rays of many points in full batches (docs/rays.md#full-packets). A kernel that shoots rays runs
// twice: first its calls only say which rays they send, and see nothing; these rays are traced
// together; then the calls get what was seen. A call whose arguments depend on what an earlier one
// saw asks for other rays the second time, which are traced for it alone.
class RayCollector {
  public:
    // Of grids whose hits rays of `depth` see.
    RayCollector(NestedRays& nested, uint32_t depth, ThreadMemory& memory)
        : nested_(nested), depth_(depth), memory_(memory), batch_(memory) {}

    // Between these two, calls are noted.
    void start();
    void finish();
    bool collecting() const { return collecting_; }
    // Before the second run of a grid.
    void answer(const Grid& grid);
    // Forgets all calls, whose memory is the arena's.
    void reset();

    // How many more rays fit into the batch.
    size_t room() const { return kGridPoints - batch_->rays.count; }
    // Notes a call; what its rays see comes to stand there, a ray after the other.
    std::span<SeenByRay> note(const Grid& grid, const Lanes& lanes, int rows, const RayPlan& plan);
    // Where the next ray with that tag is to be added.
    raytrace::RayBatch& batch(const RayTag& tag);
    // Of the rays that were added last, from `first` on: ray r shows what the sample of its slot,
    // from `first` on, sees.
    void expect(size_t first, SeenByRay* seen);
    // What the rays of the same call saw; nothing where it was not noted.
    std::optional<std::span<const SeenByRay>> find(const Grid& grid, const Lanes& lanes, int rows,
                                                   const RayPlan& plan);

  private:
    struct Call;
    void flush();

    NestedRays& nested_;
    uint32_t depth_;
    ThreadMemory& memory_;
    NestedWavefront batch_;
    RayTag tag_;
    std::span<SeenByRay*> targets_;
    Call *first_ = nullptr, *last_ = nullptr;
    Call* next_ = nullptr;  // of the grid that is answered
    bool collecting_ = false;
};

// Whether calls of ray services are noted now (RayCollector).
inline bool is_noting(const Grid& grid) {
    return grid.collector && grid.collector->collecting();
}

// Adds the rays of samples, whose slots count up from `slot`; none for those that see
// nothing.
using AddSamples =
    FunctionRef<void(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot)>;
using SumSamples = FunctionRef<void(const SampleSpan& samples, std::span<const SeenByRay> seen)>;

// Sees along all rays of a plan; `sum` gets the samples in the order of lanes and numbers. It is
// not called where rays are only noted: all that is seen is then unknown, and black.
void see_samples(Grid& grid, const Lanes& lanes, int rows, const RayPlan& plan, const RayTag& tag,
                 NestedRays& nested, const AddSamples& add, const SumSamples& sum);

}  // namespace kinora
