// raytrace/surface_point.cpp: points on triangles, their error bounds, and rays that leave them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "raytrace/accel_state_p.h"
#include "raytrace/points/points.h"
#include "runtime/base/kernel_math.h"

namespace kinora::raytrace {

namespace {

// Whether any of the rows is an instance or mirrored.
bool gather(const std::vector<GeometryState>& rows, size_t count, const uint32_t* instance,
            const uint32_t* primitive, const float* u, const float* v, TrianglePoints& at) {
    bool any_placed = false;
    for (size_t i = 0; i < kPoints; ++i) {
        const size_t from = std::min(i, count - 1);  // the tail repeats the last hit
        const Geometry& g = rows[instance[from]].seen;
        const uint32_t* index = &g.triangles[3 * size_t(primitive[from])];
        for (int k = 0; k < 3; ++k)
            std::memcpy(at.corner[k][i], &g.positions[index[k]], sizeof(vec4));
        at.u[i] = u[from];
        at.v[i] = v[from];
        any_placed |= (g.kind == GeometryKind::Instanced) | g.mirrored;
    }
    return any_placed;
}

// For triangles so small or large that the squared length of their normal leaves the floats.
vec3 careful_normal(const TrianglePoints& at, size_t i) {
    dvec3 p[3];
    for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 3; ++c) p[k][c] = double(at.corner[k][i][c]);
    dvec3 e = p[1] - p[0], f = p[2] - p[0];
    dvec3 n{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
    double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    return largest > 0 ? vec3(n / largest) : vec3(0.0f);
}

void apply_placement(const GeometryState& row, PointBlock& block, size_t i) {
    vec3 p{block.P[0][i], block.P[1][i], block.P[2][i]};
    vec3 error{block.error[0][i], block.error[1][i], block.error[2][i]};
    place_point(row.placement, p, error);
    vec3 n = place_normal(row.placement, {block.N[0][i], block.N[1][i], block.N[2][i]});
    for (int c = 0; c < 3; ++c) {
        block.P[c][i] = p[c];
        block.error[c][i] = error[c];
        block.N[c][i] = n[c];
    }
}

constexpr float kSmallestNormal2 = 1e-30f, kLargestNormal2 = 1e30f;

// In local space, before placing: so that neither way the squares overflow or vanish.
void mend_normals(const TrianglePoints& at, uint32_t lanes, PointBlock& block) {
    for (; lanes; lanes &= lanes - 1) {
        const size_t i = size_t(std::countr_zero(lanes));
        const vec3 n = careful_normal(at, i);
        for (int c = 0; c < 3; ++c) block.N[c][i] = n[c];
    }
}

// Instances and mirrors are rarer than plain rows: lane by lane.
void apply_rows(const std::vector<GeometryState>& rows, const uint32_t* instance, size_t count,
                PointBlock& block) {
    for (size_t i = 0; i < count; ++i) {
        const GeometryState& row = rows[instance[i]];
        if (row.seen.kind == GeometryKind::Instanced) {
            float largest = std::max(
                {std::abs(block.N[0][i]), std::abs(block.N[1][i]), std::abs(block.N[2][i])});
            if (largest > 0)
                for (int c = 0; c < 3; ++c) block.N[c][i] /= largest;
            apply_placement(row, block, i);
        }
        if (row.seen.mirrored)
            for (int c = 0; c < 3; ++c) block.N[c][i] = -block.N[c][i];
    }
}

// Up to sixteen numbers, nearly always all.
void copy_block(const float (&block)[kPoints], size_t count, float* to) {
    if (count == kPoints)
        std::memcpy(to, block, sizeof(block));
    else
        std::copy_n(block, count, to);
}

}  // namespace

void Accel::surface_points(size_t count, const uint32_t* instance, const uint32_t* primitive,
                           const float* u, const float* v, const SurfacePoints& out) const {
    const std::vector<GeometryState>& rows = state_->rows;
    const PointKernels& kernels = point_kernels();
    TrianglePoints at;
    PointBlock block;
    for (size_t first = 0; first < count; first += kPoints) {
        const size_t n = std::min(kPoints, count - first);
        const bool any_placed =
            gather(rows, n, instance + first, primitive + first, u + first, v + first, at);
        const uint32_t careful =
            kernels.interpolate(at, gamma(7), kSmallestNormal2, kLargestNormal2, block);
        mend_normals(at, careful, block);
        if (any_placed) apply_rows(rows, instance + first, n, block);
        kernels.normalize(block);
        for (int c = 0; c < 3; ++c) {
            copy_block(block.P[c], n, out.P[c] + first);
            copy_block(block.error[c], n, out.P_error[c] + first);
            copy_block(block.N[c], n, out.Ng[c] + first);
        }
    }
}

SurfacePoint Accel::surface_point(uint32_t instance, uint32_t primitive, float u, float v) const {
    SurfacePoint s;
    surface_points(1, &instance, &primitive, &u, &v,
                   {{&s.p.x, &s.p.y, &s.p.z},
                    {&s.p_error.x, &s.p_error.y, &s.p_error.z},
                    {&s.Ng.x, &s.Ng.y, &s.Ng.z}});
    return s;
}

// Pharr, Jakob, Humphreys, 6.8.6: along n by the box's half width in that direction, then each
// component away from p by one more float.
vec3 offset_ray_origin(vec3 p, vec3 p_error, vec3 n, vec3 w) {
    float d = std::abs(n.x) * p_error.x + std::abs(n.y) * p_error.y + std::abs(n.z) * p_error.z;
    if (n.x * w.x + n.y * w.y + n.z * w.z < 0) d = -d;
    vec3 origin;
    for (int c = 0; c < 3; ++c) {
        float step = d * n[c];
        origin[c] = p[c] + step;
        if (step != 0) origin[c] = neighbour(origin[c], step > 0);
    }
    return origin;
}

}  // namespace kinora::raytrace
