// raytrace/accel.h: answers rays on moving geometry. Embree underneath, seen in embree.cpp only.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raytrace/geometry.h"

namespace kinora::raytrace {

// Ray masks. A surface is met by rays whose mask shares a bit with its own: Geometry::seen_by, four
// bits up where it is not opaque. kMaskCamera marks camera rays: they alone obey
// Geometry::hide_backfaces.
inline constexpr uint32_t kMaskOpaque = kSeenByAll;
inline constexpr uint32_t kMaskNotOpaque = kSeenByAll << 4;
inline constexpr uint32_t kMaskAll = kMaskOpaque | kMaskNotOpaque;
inline constexpr uint32_t kMaskCamera = 1u << 31;
inline constexpr uint32_t kMaskLamp = kSeenAsLamp;  // of rays that look for lamps alone
// What the rays of some meet, opaque or not.
constexpr uint32_t mask_of_viewer(uint32_t seen_by) {
    return seen_by | seen_by << 4;
}
inline constexpr uint32_t kMaskEye = mask_of_viewer(kSeenByCamera) | kMaskCamera;

inline constexpr int kPacket = 16;

// Sixteen rays, structure of arrays, accel space. A hit has t > 0 and tnear <= t <= tfar, with t in
// units of the direction's length; directions need not have length 1. Lanes not in `active` are
// ignored. A ray that is not well-formed (NaN, infinite or |x| > 1.8e18 in origin or direction, NaN
// or negative tnear, NaN tfar, direction 0) or is empty (tnear > tfar) is a miss. Instances that
// scale by s < 1 lower the limit on origins to s * 1.7e18.
struct alignas(64) RayPacket16 {
    float org_x[kPacket], org_y[kPacket], org_z[kPacket];
    float dir_x[kPacket], dir_y[kPacket], dir_z[kPacket];
    float tnear[kPacket], tfar[kPacket];
    uint32_t mask[kPacket];
    float time[kPacket];       // 0..1 of the shutter; one motion key is held today, so unused
    uint32_t active = 0xffff;  // bit i = lane i
    // Rays that go on behind a hit (fixed_winner only; see pass_through()): up to t = window they
    // meet bodies in the order of their numbers, and neither passed_first nor those up to
    // passed_last (kNone: no more). Heeded by intersect16 where `passing`.
    bool passing = false;
    float window[kPacket];
    uint32_t passed_first[kPacket], passed_last[kPacket];
    // A hint to intersect16 that the rays are neighbours (camera rays): up to 3 times the rate, the
    // same answers; slower for rays that scatter.
    bool coherent = false;
    bool normals = true;  // false: nobody reads HitPacket16::Ng, and it is not filled
};

// p = (1-u-v) p0 + u p1 + v p2. Lanes that miss have geometry == kNone and the rest undefined.
// Ng: not normalised, in accel space, on the side from which the triangle winds anticlockwise in
// its own space (so a mirroring matrix or Geometry::mirrored does not turn a surface inside out).
struct alignas(64) HitPacket16 {
    uint32_t geometry[kPacket];   // Geometry::id
    uint32_t instance[kPacket];   // index of the row in the span given to update()
    uint32_t primitive[kPacket];  // triangle within that row
    float u[kPacket], v[kPacket], t[kPacket];
    float Ng_x[kPacket], Ng_y[kPacket], Ng_z[kPacket];
};

// Owned by the thread that traces, summed by whoever wants the sum.
struct TraceCounters {
    uint64_t rays = 0;                         // closest-hit rays asked for (active lanes)
    uint64_t shadow_rays = 0;                  // occlusion rays asked for
    uint64_t filtered = 0;                     // of both: not well-formed, answered "miss"
    uint64_t packets = 0, shadow_packets = 0;  // that they came in
    void operator+=(const TraceCounters& o) {
        rays += o.rays;
        shadow_rays += o.shadow_rays;
        filtered += o.filtered;
        packets += o.packets;
        shadow_packets += o.shadow_packets;
    }
};

class KeptTrees;  // raytrace/kept_trees.h

struct AccelPolicy {
    bool robust = true;           // watertight traversal: -6 % trace rate, half the refit cost
    bool always_rebuild = false;  // MEDIUM build of what moved at every update: the reference
    bool background = true;       // false: a rebuild at refit_limit happens inside update()
    float refit_limit = 1.3f;     // rebuild MEDIUM when summed box areas grow past this factor
    float low_limit = 3.0f;       // past this factor rebuild LOW at once
    // Of surfaces hit at the same t the lowest (row, primitive) wins, whatever the shape of the
    // tree: every hit then is the same bits after a refit, a rebuild and a restart. Costs a
    // callback for each candidate hit, 7 % of the trace rate.
    bool fixed_winner = true;
    std::shared_ptr<KeptTrees> kept =
        nullptr;  // of Instanced shapes; null: each accel builds its own
};

enum class GeometryIssue : uint8_t {
    IndexOutOfRange,  // row left out: a triangle names a vertex that is not there
    BadVertices,      // triangles with NaN, infinite or > 1.8e18 vertices are not hit
    SingularMatrix,   // row left out: its matrix has no inverse, or scales beyond 1e-10..1e10
};

// What one update() did. Valid until the next one.
struct AccelUpdate {
    int refits = 0;
    int rebuilds = 0;      // structures built MEDIUM inside this update
    int low_rebuilds = 0;  // structures built LOW
    int kept = 0;          // structures of AccelPolicy::kept
    int background_started = 0;
    int background_finished = 0;  // a tree built in the background is in use from now on
    int matrices = 0;             // instance matrices that changed
    size_t compared = 0;          // rows, with those of the last update
    float largest_growth = 1;     // largest ratio of summed box areas to those at build
    struct Issue {
        GeometryIssue issue;
        uint32_t geometry;  // Geometry::id
        uint32_t count;     // triangles or indices concerned
    };
    std::vector<Issue> issues;  // found when something was built, refitted or moved
};

// A point on a triangle from its barycentrics, with the bound of its rounding error: the true point
// lies within p +- p_error. Accel space. Source: Pharr, Jakob, Humphreys, Physically Based
// Rendering, 4th ed., 6.8 (gamma(n) bounds), plus the matrix for instances.
struct SurfacePoint {
    vec3 p;
    vec3 p_error;
    vec3 Ng;  // length 1, as HitPacket16::Ng; 0 for a triangle without area
};

// The top scene and all structures below it. update() is called by one thread with no rays under
// way; the queries are const and may run on any number of threads.
class Accel {
  public:
    explicit Accel(const AccelPolicy& policy = {});
    ~Accel();
    Accel(Accel&&) noexcept;
    Accel& operator=(Accel&&) noexcept;

    // Another one with the same structures, for rows that never change again: neither is updated
    // from then on.
    Accel shared() const;

    // Brings the structures up to date with the rows. Rows are known by their index and compared
    // with the last update: nothing changed costs some nanoseconds a row and commits nothing.
    const AccelUpdate& update(std::span<const Geometry> geometry);
    // The same where the rows with these indices, in order, are all that can have changed; all
    // rows of a shape whose vertices changed are among them. What it costs depends on them alone,
    // but for Embree's own commit of the top scene.
    const AccelUpdate& update(std::span<const Geometry> geometry, std::span<const uint32_t> rows);

    // What the last update did.
    const AccelUpdate& last_update() const;

    // Closest hits; returns the bit mask of lanes that hit.
    uint32_t intersect16(const RayPacket16& rays, HitPacket16& hits, TraceCounters& counters) const;
    // Any hit; returns the bit mask of lanes that are blocked.
    uint32_t occluded16(const RayPacket16& rays, TraceCounters& counters) const;

    // The point of a hit (of the last update).
    SurfacePoint surface_point(uint32_t instance, uint32_t primitive, float u, float v) const;
    // The same for many, structure of arrays: instance[i], primitive[i], u[i], v[i] -> P, P_error,
    // Ng.
    struct SurfacePoints {
        float* P[3];
        float* P_error[3];
        float* Ng[3];
    };
    void surface_points(size_t count, const uint32_t* instance, const uint32_t* primitive,
                        const float* u, const float* v, const SurfacePoints& out) const;

    // A box about all that is traced since the last update; low above high where nothing is.
    void bounds(vec3& low, vec3& high) const;

    // Geometry::body of a row, its own number where it has none.
    uint32_t body(uint32_t row) const;

    // Blocks until a rebuild under way in the background is done (it is taken up by the next
    // update). For tests and for programs that want each frame to depend on its time alone.
    void wait_for_background();

    const AccelPolicy& policy() const;

    struct State;  // accel_state_p.h

  private:
    std::shared_ptr<State> state_;
};

inline const AccelUpdate& update(Accel& accel, std::span<const Geometry> geometry) {
    return accel.update(geometry);
}

// The origin of a ray that leaves a surface at p (+- p_error, unit normal n) in direction w: just
// outside the error box on w's side, so tnear = 0 finds no hit on the surface itself. Scale-free.
vec3 offset_ray_origin(vec3 p, vec3 p_error, vec3 n, vec3 w);

// Sets flush-to-zero and denormals-are-zero for its scope (Embree expects them) and restores the
// caller's mode; intersect16 and occluded16 use it around Embree, so callers need not.
class DenormalGuard {
  public:
    DenormalGuard();
    ~DenormalGuard();
    DenormalGuard(const DenormalGuard&) = delete;

  private:
    uint64_t saved_;
};

}  // namespace kinora::raytrace
