// raytrace/wavefront.h: batches of rays and of hits, structure of arrays; and from one to the
// other.
#pragma once

#include <cstdint>
#include <span>

#include "raytrace/accel.h"
#include "raytrace/zeroed_vector.h"

namespace kinora::raytrace {

struct RayBatch;

// Hits to be shaded. Arrays are 64-byte aligned and readable up to `count` rounded up to 16.
// Space: accel. Everything belongs to the ray tracer and lives until the call returns.
struct HitBatch {
    size_t count = 0;
    uint32_t depth = 0;  // 0 for camera rays

    const uint32_t* geometry;   // Geometry::id
    const uint32_t* instance;   // row in the span given to Accel::update
    const uint32_t* primitive;  // triangle within the row
    const float* u;
    const float* v;
    const float* t;           // distance along dir from org, over all layers passed
    const float* org[3];      // the ray's first origin (the eye)
    const float* dir[3];      // length 1
    const float* P[3];        // the hit by its barycentrics
    const float* P_error[3];  // bound of its rounding error, for offset_ray_origin
    const float* Ng[3];       // length 1; 0 for a triangle without area
    // Footprint, where RayBatch::spreads: change of P and of dir per pixel in raster x and y (ray
    // differentials, H. Igehy 1999), met with the plane of Ng; at grazing angles capped at 100
    // times the face-on width.
    const float* dPdx[3];
    const float* dPdy[3];
    const float* dDdx[3];
    const float* dDdy[3];
    const float* time;
    const uint32_t* pixel_x;
    const uint32_t* pixel_y;
    const uint32_t* sample;
    const uint32_t* layer;           // surfaces already passed by this ray
    const uint32_t* ray;             // index of the ray in the batch that was traced
    const uint32_t* beside;          // 1: at the point of the surface that the ray went on from
    const RayBatch* rays = nullptr;  // that batch; rays->medium[ray[k]] is what hit k came through
};

// How a ray goes on behind a hit.
struct Passage {
    float onward = 1;    // what it sees there counts so many times
    uint32_t turns = 0;  // added to RayBatch::turns and spent
    uint32_t spent = 0;
    float kept = 1;  // of RayBatch::allowance
};

// To be filled for all hits of the batch; the arrays have room for `count` rounded up to 16.
// Ci is what the surface sends to the eye, associated with (not multiplied again by) Oi.
struct ShadeResult {
    float* Ci[3];
    float* Oi[3];
    std::span<float* const> aov;  // one array for each Film::aovs plane, preset to 0
    Passage* passages = nullptr;  // one a hit; null: the rays end here
};

// Rays to be traced, structure of arrays with room for `capacity`.
struct RayBatch {
    explicit RayBatch(size_t capacity = 0) { reserve(capacity); }
    RayBatch(RayBatch&&) = default;  // the arrays point into memory_, which moves along
    RayBatch& operator=(RayBatch&&) = default;
    void reserve(size_t capacity);
    size_t capacity() const { return capacity_; }

    size_t count = 0;
    float* org[3] = {};
    float* dir[3] = {};
    float* tnear = nullptr;
    float* tfar = nullptr;
    float* time = nullptr;
    uint32_t* sees = nullptr;  // a ray mask each: geometry outside it lets the ray pass, whatever
                               // the batch is traced for. All bits from the start
    bool spreads = true;       // the next four count; else hits have no footprints
    float* dOdx[3] = {};
    float* dOdy[3] = {};
    float* dDdx[3] = {};
    float* dDdy[3] = {};
    bool passing = false;  // rays of pass_through(): the three columns count (RayPacket16)
    float* window = nullptr;
    uint32_t* passed_first = nullptr;
    uint32_t* passed_last = nullptr;
    float* t_passed = nullptr;  // length already gone before org
    float* first_org[3] = {};   // where the ray began
    uint32_t* pixel_x = nullptr;
    uint32_t* pixel_y = nullptr;
    uint32_t* sample = nullptr;
    uint32_t* layer = nullptr;
    float* share = nullptr;      // of a camera ray's work that this one may make; 1 at the eye
    float* allowance = nullptr;  // of the rays that may follow a camera ray, those after this one;
                                 // 1 at the eye
    float* weight = nullptr;     // what the ray sees counts so much in the picture; 1 at the eye
    uint32_t* turns = nullptr;   // hits on its way that reflected some of it
    uint32_t* spent = nullptr;   // rays that the points it has passed have shot
    uint32_t* medium = nullptr;  // what the ray runs through; the shading's to define, 0 at the eye
    uint32_t* slot = nullptr;    // the caller's index (the integrator's sample)

  private:
    size_t capacity_ = 0;
    ZeroedVector<std::byte> memory_;
};

// The memory behind a HitBatch.
class HitStore {
  public:
    explicit HitStore(size_t capacity = 0) { reserve(capacity); }
    HitStore(HitStore&&) = default;
    HitStore& operator=(HitStore&&) = default;
    void reserve(size_t capacity);
    const HitBatch& batch() const { return batch_; }

  private:
    friend const HitBatch& trace(const Accel&, const RayBatch&, uint32_t, uint32_t, HitStore&,
                                 TraceCounters&);
    friend const HitBatch& missed(const RayBatch&, const HitBatch&, float, HitStore&);
    HitBatch batch_{};
    size_t capacity_ = 0;
    ZeroedVector<std::byte> memory_;
};

// Traces all rays with `mask`, as far as each sees that, in packets of 16 and gathers the hits,
// densely and in the order of the rays. `depth` goes into the batch. Allocates only if the store is
// smaller than the rays.
const HitBatch& trace(const Accel& accel, const RayBatch& rays, uint32_t mask, uint32_t depth,
                      HitStore& store, TraceCounters& counters);

// The rays of the batch that `hits` (of trace()) has no hit of, as hits at their far end: at tfar,
// or at `distance` from org where that is nearer (a camera's ray, of depth 0, ends at its tfar
// where that is finite). geometry, instance and primitive are kNone, Ng is 0; the footprint is as
// wide as a surface across the ray would have it.
const HitBatch& missed(const RayBatch& rays, const HitBatch& hits, float distance, HitStore& store);

// Ray `to` of the batch becomes what ray `from` is.
void move_ray(RayBatch& rays, size_t to, size_t from);

// Ray `to` of the batch becomes the ray of hit k as it goes on behind it, its footprint, slot and
// all; it meets what other bodies have at the very point of the hit before what lies behind, each
// body once. `to` must not lie behind the ray's old index (hits come in the order of rays); the
// layer counts on, the medium is the caller's to set. Afterwards RayBatch::passing must be set,
// and all rays of the batch be such.
void pass_through(const Accel& accel, RayBatch& rays, size_t to, const HitBatch& hits, size_t k);

// For each ray: blocked[i] = 1 if geometry of the mask that it sees lies in (tnear, tfar], else 0.
// With kMaskOpaque the first step of transmission; the caller goes on with trace(kMaskNotOpaque)
// for the rest. Uses org, dir, tnear, tfar, time, sees of the batch only.
void occluded(const Accel& accel, const RayBatch& rays, uint32_t mask, uint8_t* blocked,
              TraceCounters& counters);
// The same for the rays of these numbers, which ascend: blocked[i] is of ray which[i].
void occluded(const Accel& accel, const RayBatch& rays, std::span<const uint32_t> which,
              uint32_t mask, uint8_t* blocked, TraceCounters& counters);

}  // namespace kinora::raytrace
