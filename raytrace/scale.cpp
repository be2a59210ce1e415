// raytrace/scale.cpp: sizes, the scales for them, and rays at a scale.
#include <algorithm>
#include <bit>
#include <cmath>

#include "raytrace/mesh_watch_p.h"
#include "raytrace/scale_p.h"

namespace kinora::raytrace {

double size_of(std::span<const vec4> positions) {
    float largest = 0;
    for (const vec4& p : positions)
        for (int k = 0; k < 3; ++k)
            if (std::abs(p[k]) <= kLargest) largest = std::max(largest, std::abs(p[k]));
    return 2 * double(largest);
}

namespace {

// Of a mesh of size `local` where the row's matrix puts it.
double placed_size(const Geometry& row, double local) {
    if (row.kind != GeometryKind::Instanced) return local;
    const dmat4& m = row.accel_from_local;
    double size = 0;
    for (int r = 0; r < 3; ++r) {
        const double gain = std::max({std::abs(m[0][r]), std::abs(m[1][r]), std::abs(m[2][r])});
        size = std::max(size, local * gain + 2 * std::abs(m[3][r]));
    }
    return size;
}

}  // namespace

double size_of(std::span<const Geometry> rows) {
    double largest = 0, local = 0;
    const vec4* last = nullptr;
    for (const Geometry& row : rows) {
        if (row.positions.data() != last) local = size_of(row.positions);
        last = row.positions.data();  // rows of one mesh follow each other
        const double size = placed_size(row, local);
        if (size <= double(kLargest)) largest = std::max(largest, size);
    }
    return largest;
}

float scale_within(double size, double least, double most) {
    if (!(size > 0x1p-120) || (size >= least && size <= most)) return 1;
    return float(std::ldexp(1.0, (size < least ? 0 : std::ilogb(most)) - std::ilogb(size)));
}

// Embree takes a hit's barycentrics for 0 where twice the triangle's area, seen along the ray,
// times the ray's length in the mesh's space is below 1e-18 (its min_rcp_input): of a mesh of size
// m that fills a scene of size s, m^3 / s times the square of the triangle's share. m^3 >= 2^-40 s
// leaves room for shares down to a thousandth.
float local_scale(double scene_size, double mesh_size) {
    double least = 1;
    if (scene_size <= 0x1p20)
        least = std::max(0x1p-13, std::exp2((std::log2(scene_size) - 40) / 3));
    return scale_within(mesh_size, least, 0x1p23);
}

RayPacket16 scaled(const RayPacket16& rays, float scale) {
    RayPacket16 out = rays;
    for (int i = 0; i < kPacket; ++i) {
        out.org_x[i] *= scale;
        out.org_y[i] *= scale;
        out.org_z[i] *= scale;
        out.tnear[i] *= scale;
        out.tfar[i] *= scale;
        if (rays.passing) out.window[i] *= scale;
    }
    return out;
}

void unscale(HitPacket16& hits, uint32_t which, float scale) {
    for (; which; which &= which - 1) hits.t[std::countr_zero(which)] /= scale;
}

}  // namespace kinora::raytrace
