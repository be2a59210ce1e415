// raytrace/embree.cpp: the one file that knows Embree.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cfloat>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "raytrace/embree_p.h"
#include "raytrace/ray_tracer.h"
#include "raytrace/traceable_p.h"
#include "runtime/base/check.h"
#include "runtime/base/parallel.h"
#include "runtime/base/shared_library.h"

namespace kinora::raytrace {

namespace {

// Set where a call of this thread ended so; Embree's functions themselves return nothing.
thread_local bool t_out_of_memory = false;

// Called on the thread of the call that fails. A thread that cannot be started is memory, too: that
// of its stack.
void report_error(void*, RTCError code, const char* text) {
    if (code == RTC_ERROR_NONE) return;
    if (code == RTC_ERROR_OUT_OF_MEMORY || (text && std::strstr(text, "pthread_create"))) {
        t_out_of_memory = true;
        return;
    }
    std::fprintf(stderr, "kinora: Embree: %s (%d)\n", text ? text : "", int(code));
}

// After calls that make or build something, which is not whole where memory ended.
void require_memory() {
    if (std::exchange(t_out_of_memory, false)) throw std::bad_alloc();
}

// Opened before Embree, whose tasks it bounds.
struct TaskScheduler {
    TaskScheduler() { open_task_scheduler(); }
};

// Embree's functions and the one device of the process, which is kept: making one costs about a
// millisecond.
struct Embree : TaskScheduler, SharedLibrary {
    Embree() : SharedLibrary(KINORA_EMBREE_LIBRARY, "rays are traced", "libembree3-3") {
        if (!error().empty()) return;
        device = rtcNewDevice(nullptr);
        if (device) {
            rtcSetDeviceErrorFunction(device, report_error, nullptr);
            return;
        }
        // Unknown: oneTBB's threads cannot be started.
        const RTCError why = rtcGetDeviceError(nullptr);
        if (why == RTC_ERROR_OUT_OF_MEMORY || why == RTC_ERROR_UNKNOWN) throw std::bad_alloc();
    }

    KINORA_FUNCTION(rtcAttachGeometryByID);
    KINORA_FUNCTION(rtcCommitGeometry);
    KINORA_FUNCTION(rtcCommitScene);
    KINORA_FUNCTION(rtcDetachGeometry);
    KINORA_FUNCTION(rtcGetDeviceError);
    KINORA_FUNCTION(rtcGetSceneBounds);
    KINORA_FUNCTION(rtcIntersect16);
    KINORA_FUNCTION(rtcNewDevice);
    KINORA_FUNCTION(rtcNewGeometry);
    KINORA_FUNCTION(rtcNewScene);
    KINORA_FUNCTION(rtcOccluded16);
    KINORA_FUNCTION(rtcReleaseGeometry);
    KINORA_FUNCTION(rtcReleaseScene);
    KINORA_FUNCTION(rtcSetDeviceErrorFunction);
    KINORA_FUNCTION(rtcSetGeometryBuildQuality);
    KINORA_FUNCTION(rtcSetGeometryInstancedScene);
    KINORA_FUNCTION(rtcSetGeometryIntersectFilterFunction);
    KINORA_FUNCTION(rtcSetGeometryMask);
    KINORA_FUNCTION(rtcSetGeometryTimeStepCount);
    KINORA_FUNCTION(rtcSetGeometryTransform);
    KINORA_FUNCTION(rtcSetSceneBuildQuality);
    KINORA_FUNCTION(rtcSetSceneFlags);
    KINORA_FUNCTION(rtcSetSharedGeometryBuffer);
    KINORA_FUNCTION(rtcUpdateGeometryBuffer);
    RTCDevice device = nullptr;
};

// For those who know that rays can be traced: whoever makes an Accel looks first.
const Embree& embree() {
    const Embree& library = opened<Embree>();
    CHECK(library.device != nullptr);
    return library;
}

RTCGeometry geometry(void* p) {
    return static_cast<RTCGeometry>(p);
}
RTCScene scene(void* p) {
    return static_cast<RTCScene>(p);
}

RTCGeometry new_geometry(RTCGeometryType type) {
    RTCGeometry made = embree().rtcNewGeometry(embree().device, type);
    require_memory();
    return made;
}

constexpr RTCBuildQuality kQualities[] = {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM,
                                          RTC_BUILD_QUALITY_REFIT};

// What the filter needs to know of a query; Embree hands the context through.
struct QueryContext {
    RTCIntersectContext rtc;  // first: Embree's pointer to it is ours
    const HitMap* map;
    const RayPacket16* rays;
    bool fixed_winner;
    alignas(64) float best_t[kPacket];
    uint32_t best_slot[kPacket];
    uint32_t best_primitive[kPacket];
};

uint32_t row_of(const HitMap::Slot& slot, uint32_t primitive) {
    return slot.owner ? slot.owner[primitive] : slot.row;
}

struct Candidate {
    uint32_t slot;
    uint32_t primitive;
    float t;
};

bool is_hidden_backface(const HitMap& map, const Candidate& c, RTCRayN* ray, RTCHitN* hit,
                        unsigned n, unsigned i) {
    const HitMap::Slot& slot = map.slots[c.slot];
    if (!slot.hide_backfaces || !(RTCRayN_mask(ray, n, i) & kMaskCamera)) return false;
    // Both are in the triangle's own space here, where the sign of Ng.dir is the same.
    float facing = RTCHitN_Ng_x(hit, n, i) * RTCRayN_dir_x(ray, n, i) +
                   RTCHitN_Ng_y(hit, n, i) * RTCRayN_dir_y(ray, n, i) +
                   RTCHitN_Ng_z(hit, n, i) * RTCRayN_dir_z(ray, n, i);
    return map.rows[row_of(slot, c.primitive)].mirrored ? facing < 0 : facing > 0;
}

// Whether a hit at t lies where the ray goes on from.
bool in_window(const QueryContext& query, float t, unsigned lane) {
    return query.rays->passing && t <= query.rays->window[lane];
}

uint32_t body_of(const HitMap& map, uint32_t slot, uint32_t primitive) {
    return map.rows[row_of(map.slots[slot], primitive)].body;
}

bool is_passed(const QueryContext& query, const Candidate& c, unsigned lane) {
    if (!in_window(query, c.t, lane)) return false;
    const uint32_t body = body_of(*query.map, c.slot, c.primitive);
    const uint32_t last = query.rays->passed_last[lane];
    return body == query.rays->passed_first[lane] || (last != kNone && body <= last);
}

// Whether `c` comes before the lane's best so far in the order (t, row, primitive); within the
// window in the order (body, row, primitive).
bool comes_first(const QueryContext& query, const Candidate& c, unsigned lane) {
    if (query.best_primitive[lane] == kNone) return true;
    const HitMap& map = *query.map;
    const bool near = in_window(query, c.t, lane);
    if (near != in_window(query, query.best_t[lane], lane)) return near;
    if (near) {
        const uint32_t body = body_of(map, c.slot, c.primitive);
        const uint32_t best = body_of(map, query.best_slot[lane], query.best_primitive[lane]);
        if (body != best) return body < best;
    } else if (c.t != query.best_t[lane]) {
        return c.t < query.best_t[lane];
    }
    uint32_t best_slot = query.best_slot[lane];
    uint32_t row = row_of(map.slots[c.slot], c.primitive);
    uint32_t best_row = row_of(map.slots[best_slot], query.best_primitive[lane]);
    if (row != best_row) return row < best_row;
    return c.primitive < query.best_primitive[lane];
}

// Candidates as near as the accepted one up to rounding must still be offered, or the winner would
// depend on the order of traversal: the ray is left this much longer than the hit. Two roundings
// of t lie between what Embree compares and what it reports.
constexpr float kTieWindow = 1.0f + 0x1p-21f;

// The lanes of sixteen whose bits are not all 0, where each has all of its bits or none.
uint32_t set_lanes(const int* lanes) {
#if defined(__SSE2__)
    uint32_t bits = 0;
    for (int i = 0; i < kPacket; i += 4) {
        const __m128i four = _mm_loadu_si128(reinterpret_cast<const __m128i*>(lanes + i));
        bits |= uint32_t(_mm_movemask_ps(_mm_castsi128_ps(four))) << i;
    }
    return bits;
#else
    uint32_t bits = 0;
    for (int i = 0; i < kPacket; ++i) bits |= uint32_t(lanes[i] != 0) << i;
    return bits;
#endif
}

// `n`: of args, a constant where the compiler is to know it.
__attribute__((always_inline)) inline void choose_lane(const RTCFilterFunctionNArguments* args,
                                                       unsigned n, unsigned i) {
    auto& query = *reinterpret_cast<QueryContext*>(args->context);
    uint32_t instance = RTCHitN_instID(args->hit, n, i, 0);
    Candidate c{instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(args->hit, n, i),
                RTCHitN_primID(args->hit, n, i), RTCRayN_tfar(args->ray, n, i)};
    unsigned lane = RTCRayN_id(args->ray, n, i);
    if (is_hidden_backface(*query.map, c, args->ray, args->hit, n, i) ||
        (query.fixed_winner && (is_passed(query, c, lane) || !comes_first(query, c, lane)))) {
        args->valid[i] = 0;
        return;
    }
    query.best_t[lane] = c.t;
    query.best_slot[lane] = c.slot;
    query.best_primitive[lane] = c.primitive;
    if (!query.fixed_winner) return;
    float& tfar = RTCRayN_tfar(args->ray, n, i);
    tfar = c.t * kTieWindow;
    // Bodies of lower numbers may still lie farther off within the window.
    if (in_window(query, c.t, lane))
        tfar = std::max(tfar, std::min(query.rays->window[lane], query.rays->tfar[lane]));
}

void choose_hit(const RTCFilterFunctionNArguments* args) {
    if (args->N == kPacket) {
        for (uint32_t left = set_lanes(args->valid); left; left &= left - 1)
            choose_lane(args, kPacket, unsigned(std::countr_zero(left)));
        return;
    }
    for (unsigned i = 0; i < args->N; ++i)
        if (args->valid[i] != 0) choose_lane(args, args->N, i);
}

void set_buffers(RTCGeometry g, std::span<const vec4> positions,
                 std::span<const uint32_t> triangles) {
    embree().rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        positions.data(), 0, sizeof(vec4), positions.size());
    embree().rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        triangles.data(), 0, 3 * sizeof(uint32_t),
                                        triangles.size() / 3);
}

void load_rays(const RayPacket16& in, RTCRay16& out) {
    constexpr size_t bytes = sizeof(float) * kPacket;
    std::memcpy(out.org_x, in.org_x, bytes);
    std::memcpy(out.org_y, in.org_y, bytes);
    std::memcpy(out.org_z, in.org_z, bytes);
    std::memcpy(out.dir_x, in.dir_x, bytes);
    std::memcpy(out.dir_y, in.dir_y, bytes);
    std::memcpy(out.dir_z, in.dir_z, bytes);
    // Embree takes tnear <= t; a ray that starts in an axis-parallel surface at 0 has no rounding
    // error to be offset by, and must not meet that surface at t = 0.
    for (int i = 0; i < kPacket; ++i) out.tnear[i] = std::max(in.tnear[i], FLT_MIN);
    std::memcpy(out.tfar, in.tfar, bytes);
    std::memcpy(out.mask, in.mask, bytes);
    std::memset(out.time, 0, bytes);
    std::memset(out.flags, 0, bytes);
    for (int i = 0; i < kPacket; ++i) out.id[i] = uint32_t(i);
    // Debian's Embree has its assertions, and rtcOccluded16 may look at lanes that nobody asks for.
    for (uint32_t off = ~in.active & 0xffffu; off; off &= off - 1) {
        const int i = std::countr_zero(off);
        out.org_x[i] = out.org_y[i] = out.org_z[i] = 0;
        out.dir_x[i] = out.dir_y[i] = 0;
        out.dir_z[i] = 1;
        out.tnear[i] = FLT_MIN;
        out.tfar[i] = -1;
    }
}

// The lanes of sixteen that hold the number.
uint32_t equal_lanes(const unsigned* lanes, unsigned number) {
    alignas(64) int equal[kPacket];
    for (int i = 0; i < kPacket; ++i) equal[i] = lanes[i] == number ? -1 : 0;
    return set_lanes(equal);
}

struct alignas(64) LaneMask {
    int valid[kPacket];
    explicit LaneMask(uint32_t bits) {
        for (int i = 0; i < kPacket; ++i) valid[i] = bits >> i & 1 ? -1 : 0;
    }
};

// Accel-space normal of a hit, turned to the side the triangle winds on in its own space.
void set_normal(const HitMap::Row& row, const RTCHit16& hit, int i, HitPacket16& out) {
    float n[3] = {hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]};
    float m[3] = {n[0], n[1], n[2]};
    if (row.instanced)
        for (int k = 0; k < 3; ++k)
            m[k] = row.normal[3 * k] * n[0] + row.normal[3 * k + 1] * n[1] +
                   row.normal[3 * k + 2] * n[2];
    float sign = row.mirrored ? -1.0f : 1.0f;
    out.Ng_x[i] = sign * m[0];
    out.Ng_y[i] = sign * m[1];
    out.Ng_z[i] = sign * m[2];
}

}  // namespace

const std::string& ray_tracer_error() {
    static const std::string no_device =
        "rays are traced by Embree, which makes no device on this machine";
    const Embree& library = opened<Embree>();
    return library.error().empty() && !library.device ? no_device : library.error();
}

std::jthread open_ray_tracer_early() {
    try {
        return std::jthread([] {
            try {
                opened<Embree>();
            } catch (const std::exception&) {  // the first Accel meets it again
            }
        });
    } catch (const std::system_error&) {  // the caller opens it when it needs it
        return {};
    }
}

EmbreeMesh::EmbreeMesh(std::span<const vec4> positions, std::span<const uint32_t> triangles,
                       BuildQuality quality, uint32_t mask, bool filtered, float scale)
    : positions_(positions), scale_(scale) {
    RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
    geometry_ = g;
    set_buffers(g, traced(), triangles);
    embree().rtcSetGeometryBuildQuality(
        g, kQualities[int(quality)]);  // only heard before the first commit
    embree().rtcSetGeometryMask(g, mask);
    if (filtered) embree().rtcSetGeometryIntersectFilterFunction(g, choose_hit);
    embree().rtcCommitGeometry(g);
}

EmbreeMesh::~EmbreeMesh() {
    if (geometry_) embree().rtcReleaseGeometry(geometry(geometry_));
}

std::span<const vec4> EmbreeMesh::traced() {
    if (scale_ == 1) return positions_;
    scaled_.resize(positions_.size());
    std::ranges::transform(positions_, scaled_.begin(), [&](const vec4& p) { return p * scale_; });
    return scaled_;
}

void EmbreeMesh::vertices_moved() {
    traced();
    embree().rtcUpdateGeometryBuffer(geometry(geometry_), RTC_BUFFER_TYPE_VERTEX, 0);
    embree().rtcCommitGeometry(geometry(geometry_));
}

void EmbreeMesh::vertices_moved_to(std::span<const vec4> positions) {
    positions_ = positions;
    const std::span<const vec4> seen = traced();
    embree().rtcSetSharedGeometryBuffer(geometry(geometry_), RTC_BUFFER_TYPE_VERTEX, 0,
                                        RTC_FORMAT_FLOAT3, seen.data(), 0, sizeof(vec4),
                                        seen.size());
    embree().rtcCommitGeometry(geometry(geometry_));
}

EmbreeInstance::EmbreeInstance(const EmbreeScene& of, uint32_t mask) {
    RTCGeometry g = new_geometry(RTC_GEOMETRY_TYPE_INSTANCE);
    geometry_ = g;
    embree().rtcSetGeometryInstancedScene(g, scene(of.scene_));
    embree().rtcSetGeometryTimeStepCount(g, 1);
    embree().rtcSetGeometryMask(g, mask);
}

EmbreeInstance::~EmbreeInstance() {
    if (geometry_) embree().rtcReleaseGeometry(geometry(geometry_));
}

void EmbreeInstance::set_matrix(const float columns[12]) {
    embree().rtcSetGeometryTransform(geometry(geometry_), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                                     columns);
    embree().rtcCommitGeometry(geometry(geometry_));
}

bool EmbreeInstance::has_extent() const {
    EmbreeScene alone(true, true);
    alone.attach(*this, 0);
    alone.commit();
    vec3 low, high;
    alone.bounds(low, high);
    return raytrace::has_extent(low, high);
}

EmbreeScene::EmbreeScene(bool dynamic, bool robust) {
    RTCScene s = embree().rtcNewScene(embree().device);
    require_memory();
    scene_ = s;
    // Never HIGH: it aborts on extreme meshes in Debian's build (docs/numerics.md#geometry).
    embree().rtcSetSceneBuildQuality(s, dynamic ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
    unsigned flags = RTC_SCENE_FLAG_NONE;
    if (dynamic) flags |= RTC_SCENE_FLAG_DYNAMIC;
    if (robust) flags |= RTC_SCENE_FLAG_ROBUST;
    embree().rtcSetSceneFlags(s, RTCSceneFlags(flags));
}

EmbreeScene::~EmbreeScene() {
    if (scene_) embree().rtcReleaseScene(scene(scene_));
}

void EmbreeScene::attach(const EmbreeMesh& mesh, uint32_t slot) {
    embree().rtcAttachGeometryByID(scene(scene_), geometry(mesh.geometry_), slot);
}

void EmbreeScene::attach(const EmbreeInstance& instance, uint32_t slot) {
    embree().rtcAttachGeometryByID(scene(scene_), geometry(instance.geometry_), slot);
}

void EmbreeScene::detach(uint32_t slot) {
    embree().rtcDetachGeometry(scene(scene_), slot);
}

void EmbreeScene::commit() {
    DenormalGuard guard;
    embree().rtcCommitScene(scene(scene_));
    require_memory();
}

void EmbreeScene::bounds(vec3& low, vec3& high) const {
    RTCBounds box;
    embree().rtcGetSceneBounds(scene(scene_), &box);
    low = {box.lower_x, box.lower_y, box.lower_z};
    high = {box.upper_x, box.upper_y, box.upper_z};
}

uint32_t EmbreeScene::intersect16(const RayPacket16& rays, const HitMap& map, bool fixed_winner,
                                  HitPacket16& hits) const {
    LaneMask lanes(rays.active);
    RTCRayHit16 rayhit;
    load_rays(rays, rayhit.ray);
    QueryContext query;
    rtcInitIntersectContext(&query.rtc);
    if (rays.coherent) query.rtc.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    query.map = &map;
    query.rays = &rays;
    query.fixed_winner = fixed_winner;
    for (int i = 0; i < kPacket; ++i) {
        rayhit.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        rayhit.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        query.best_t[i] = rays.tfar[i];
        query.best_slot[i] = 0;
        query.best_primitive[i] = kNone;
    }
    {
        DenormalGuard guard;
        embree().rtcIntersect16(lanes.valid, scene(scene_), &query.rtc, &rayhit);
    }
    const RTCHit16& hit = rayhit.hit;
    std::memcpy(hits.u, hit.u, sizeof(hits.u));
    std::memcpy(hits.v, hit.v, sizeof(hits.v));
    std::memcpy(hits.t, fixed_winner ? query.best_t : rayhit.ray.tfar, sizeof(hits.t));
    std::fill_n(hits.geometry, kPacket, kNone);
    const uint32_t met = rays.active & ~equal_lanes(hit.geomID, RTC_INVALID_GEOMETRY_ID);
    for (uint32_t left = met; left; left &= left - 1) {
        const int i = std::countr_zero(left);
        const uint32_t instance = hit.instID[0][i];
        const HitMap::Slot& slot =
            map.slots[instance != RTC_INVALID_GEOMETRY_ID ? instance : hit.geomID[i]];
        const uint32_t row_index = row_of(slot, hit.primID[i]);
        const HitMap::Row& row = map.rows[row_index];
        hits.geometry[i] = row.id;
        hits.instance[i] = row_index;
        hits.primitive[i] = hit.primID[i] - row.first_primitive;
        if (rays.normals) set_normal(row, hit, i, hits);
    }
    return met;
}

uint32_t EmbreeScene::occluded16(const RayPacket16& rays) const {
    LaneMask lanes(rays.active);
    RTCRay16 ray;
    load_rays(rays, ray);
    RTCIntersectContext context;
    // Never COHERENT here: rtcOccluded16 of Embree 3.13.5 then loops for ever on some packets
    // (seen on a few hundred of mixed direction, and on some of one octant in court.dae).
    rtcInitIntersectContext(&context);
    {
        DenormalGuard guard;
        embree().rtcOccluded16(lanes.valid, scene(scene_), &context, &ray);
    }
    uint32_t mask = 0;
    for (int i = 0; i < kPacket; ++i)
        if (rays.active >> i & 1 && ray.tfar[i] < 0) mask |= 1u << i;  // Embree sets -inf
    return mask;
}

}  // namespace kinora::raytrace
