// runtime/picture/shading/lighting/lit_points.cpp: points where light is wanted.
#include "runtime/picture/shading/lighting/lit_points.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "raytrace/hits.h"
#include "runtime/scene/kernels/columns.h"

namespace kinora {

namespace {

uint32_t bits(float x) {
    return uint32_t(jit::bits_of(x));
}

// Rows of lanes.
template <class T>
T* lane_row(Arena& arena) {
    return arena.allocate_span<T>(jit::kMaxLanes).data();
}

}  // namespace

std::span<PointRays> accounts_of(const Grid& grid, const LightPoints& at) {
    return grid.rays.empty() ? grid.rays : grid.rays.subspan(at.first, at.count);
}

// While LIGHTS_DARK counts what arrives on the side that the eye sees, that side is not dropped.
SeenPoints seen_points(const Grid& grid) {
    constexpr uint8_t kSeen = rsl::kLitFacing | rsl::kLitFacingByN;
    SeenPoints points;
    points.count = grid.count();
    points.sides = grid.look->lowered.lit_sides;
    const bool counts = grid.pose.watch_dark > 0 && grid.depth == 0;
    if (counts && (points.sides == 0 || points.sides & ~kSeen)) points.sides = rsl::kLitAround;
    for (size_t k = 0; k < 3; ++k) {
        points.N[k] = grid.columns[kColN + k];
        points.Ng[k] = grid.columns[kColNg + k];
        points.I[k] = grid.columns[kColI + k];
    }
    return points;
}

LightPoints points_of(const Grid& grid, const jit::ServiceCall& call) {
    Arena& arena = grid.memory.arena;
    const ShadingFrame& frame = grid.frame;
    const mat3 accel_from_camera = glm::transpose(frame.camera_from_accel);
    float* rows[13];
    for (float*& row : rows) row = lane_row<float>(arena);
    raytrace::SampleSeries* series = lane_row<raytrace::SampleSeries>(arena);
    uint32_t* surface = lane_row<uint32_t>(arena);
    for (size_t i = 0; i < jit::kMaxLanes; ++i) {
        vec3 P(call.args[i], call.args[jit::kMaxLanes + i], call.args[2 * jit::kMaxLanes + i]);
        if (!(call.mask >> i & 1)) P = vec3(0);
        vec3 accel = accel_from_camera * P + frame.eye;
        // The point went through a rotation and a sum: gamma(4) of the magnitudes bounds that.
        vec3 error =
            (std::abs(P.x) + std::abs(P.y) + std::abs(P.z) + glm::abs(frame.eye)) * 2.4e-7f;
        for (int k = 0; k < 3; ++k) {
            rows[k][i] = P[k];
            rows[3 + k][i] = accel[k];
            rows[6 + k][i] = error[k];
            rows[9 + k][i] = 0;
        }
        // Each step of a march has numbers of its own.
        uint32_t h = grid.points[std::min(size_t(call.first) + i, grid.count() - 1)];
        const uint32_t own = raytrace::hash(random_of(grid.hits, h, frame.seed),
                                            raytrace::hash(bits(P.x), bits(P.y), bits(P.z)));
        rows[12][i] = jit::float_of(int32_t(own));
        series[i] = {own};
        surface[i] = kNone;
    }
    LightPoints at;
    at.count = size_t(std::min<int32_t>(call.lanes, int32_t(grid.count()) - call.first));
    at.first = size_t(call.first);
    at.rng = rows[12];
    at.series = series;
    at.surface = surface;
    float* const zeros = lane_row<float>(arena);
    std::fill_n(zeros, jit::kMaxLanes, 0.0f);
    at.zeros = zeros;
    for (size_t k = 0; k < 3; ++k) {
        at.P[k] = rows[k];
        at.accel[k] = rows[3 + k];
        at.error[k] = rows[6 + k];
        at.N[k] = at.Ng[k] = rows[9 + k];
    }
    return at;
}

bool asks_at(const LightPoints& points, const jit::ServiceCall& call) {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (!(call.mask >> lane & 1)) continue;
        for (int k = 0; k < 3; ++k)
            if (call.args[k * jit::kMaxLanes + lane] != points.P[k][call.first + lane])
                return false;
    }
    return true;
}

LightPoints part_of(const LightPoints& points, const jit::ServiceCall& call) {
    LightPoints at = points;
    const size_t first = size_t(call.first);
    for (auto* rows : {&at.P, &at.N, &at.accel, &at.error, &at.Ng})
        for (const float*& row : *rows) row += first;
    at.count = std::min(size_t(call.lanes), at.count - first);
    at.normals += first;
    at.surface += first;
    if (at.rng) at.rng += first;
    if (at.series) at.series += first;
    at.first = first;
    at.own = false;
    return at;
}

}  // namespace kinora
