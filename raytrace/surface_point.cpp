// raytrace/surface_point.cpp: points on triangles, their error bounds, and rays that leave them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "raytrace/accel_state_p.h"

namespace kinora::raytrace {

namespace {

constexpr size_t kBlock = 16;

struct Corners {
    float p[3][3][kBlock];  // corner, component, hit
};

void gather(const std::vector<GeometryState>& rows, size_t count, const uint32_t* instance,
            const uint32_t* primitive, Corners& corners) {
    for (size_t i = 0; i < kBlock; ++i) {
        size_t from = std::min(i, count - 1);  // the tail repeats the last hit
        const Geometry& g = rows[instance[from]].seen;
        const uint32_t* index = &g.triangles[3 * size_t(primitive[from])];
        for (int k = 0; k < 3; ++k) {
            const vec4& p = g.positions[index[k]];
            for (int c = 0; c < 3; ++c) corners.p[k][c][i] = p[c];
        }
    }
}

struct Block {
    float P[3][kBlock], error[3][kBlock], N[3][kBlock];
};

void interpolate(const Corners& corners, const float* u, const float* v, size_t count, Block& out) {
    float b[3][kBlock];
    for (size_t i = 0; i < kBlock; ++i) {
        size_t from = std::min(i, count - 1);
        b[1][i] = u[from];
        b[2][i] = v[from];
        b[0][i] = 1.0f - u[from] - v[from];
    }
    for (int c = 0; c < 3; ++c)
        for (size_t i = 0; i < kBlock; ++i) {
            float x = b[0][i] * corners.p[0][c][i], y = b[1][i] * corners.p[1][c][i],
                  z = b[2][i] * corners.p[2][c][i];
            out.P[c][i] = x + y + z;
            out.error[c][i] = gamma(7) * (std::abs(x) + std::abs(y) + std::abs(z));
        }
    for (size_t i = 0; i < kBlock; ++i) {
        float e[3], f[3];
        for (int c = 0; c < 3; ++c) {
            e[c] = corners.p[1][c][i] - corners.p[0][c][i];
            f[c] = corners.p[2][c][i] - corners.p[0][c][i];
        }
        out.N[0][i] = e[1] * f[2] - e[2] * f[1];
        out.N[1][i] = e[2] * f[0] - e[0] * f[2];
        out.N[2][i] = e[0] * f[1] - e[1] * f[0];
    }
}

// For triangles so small or large that the squared length of their normal leaves the floats.
vec3 careful_normal(const Corners& corners, size_t i) {
    dvec3 p[3];
    for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 3; ++c) p[k][c] = double(corners.p[k][c][i]);
    dvec3 e = p[1] - p[0], f = p[2] - p[0];
    dvec3 n{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
    double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    return largest > 0 ? vec3(n / largest) : vec3(0.0f);
}

void apply_placement(const GeometryState& row, Block& block, size_t i) {
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

float normal_length2(const Block& b, size_t i) {
    return b.N[0][i] * b.N[0][i] + b.N[1][i] * b.N[1][i] + b.N[2][i] * b.N[2][i];
}

void set_normal(Block& block, size_t i, vec3 n) {
    for (int c = 0; c < 3; ++c) block.N[c][i] = n[c];
}

// In local space, before placing: so that neither way the squares overflow or vanish.
void mend_normals(const Corners& corners, Block& block) {
    for (size_t i = 0; i < kBlock; ++i) {
        float length2 = normal_length2(block, i);
        if (!(length2 > kSmallestNormal2 && length2 < kLargestNormal2))
            set_normal(block, i, careful_normal(corners, i));
    }
}

void normalize(Block& block) {
    for (size_t i = 0; i < kBlock; ++i) {
        float length2 = normal_length2(block, i);
        float scale = length2 > 0 ? 1.0f / std::sqrt(length2) : 0.0f;
        for (int c = 0; c < 3; ++c) block.N[c][i] *= scale;
    }
}

// Instances and mirrors are rarer than plain rows: lane by lane.
void apply_rows(const std::vector<GeometryState>& rows, const uint32_t* instance, size_t count,
                Block& block) {
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

}  // namespace

void Accel::surface_points(size_t count, const uint32_t* instance, const uint32_t* primitive,
                           const float* u, const float* v, const SurfacePoints& out) const {
    const std::vector<GeometryState>& rows = state_->rows;
    Corners corners;
    Block block;
    for (size_t first = 0; first < count; first += kBlock) {
        size_t n = std::min(kBlock, count - first);
        gather(rows, n, instance + first, primitive + first, corners);
        interpolate(corners, u + first, v + first, n, block);
        mend_normals(corners, block);
        apply_rows(rows, instance + first, n, block);
        normalize(block);
        for (int c = 0; c < 3; ++c) {
            std::copy_n(block.P[c], n, out.P[c] + first);
            std::copy_n(block.error[c], n, out.P_error[c] + first);
            std::copy_n(block.N[c], n, out.Ng[c] + first);
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

namespace {

// The neighbour of x above or below it; x is finite.
float next_float(float x, bool up) {
    if (x == 0) return up ? 0x1p-149f : -0x1p-149f;
    uint32_t bits = std::bit_cast<uint32_t>(x);
    return std::bit_cast<float>(up == (x > 0) ? bits + 1 : bits - 1);
}

}  // namespace

// Pharr, Jakob, Humphreys, 6.8.6: along n by the box's half width in that direction, then each
// component away from p by one more float.
vec3 offset_ray_origin(vec3 p, vec3 p_error, vec3 n, vec3 w) {
    float d = std::abs(n.x) * p_error.x + std::abs(n.y) * p_error.y + std::abs(n.z) * p_error.z;
    if (n.x * w.x + n.y * w.y + n.z * w.z < 0) d = -d;
    vec3 origin;
    for (int c = 0; c < 3; ++c) {
        float step = d * n[c];
        origin[c] = p[c] + step;
        if (step != 0) origin[c] = next_float(origin[c], step > 0);
    }
    return origin;
}

}  // namespace kinora::raytrace
