// raytrace/brute_force.cpp: nearest hit by trying every triangle in double precision.
#include "raytrace/brute_force.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace kinora::raytrace {

namespace {

struct Crossing {
    double t, u, v;
};

bool meets(const ReferenceRay& ray, const dvec3 p[3], Crossing& out) {
    const dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const dvec3 q = cross(ray.dir, e2);
    const double det = dot(e1, q);
    if (!(det != 0)) return false;
    const dvec3 s = ray.org - p[0];
    out.u = dot(s, q) / det;
    if (!(out.u >= 0 && out.u <= 1)) return false;
    const dvec3 r = cross(s, e1);
    out.v = dot(ray.dir, r) / det;
    if (!(out.v >= 0 && out.u + out.v <= 1)) return false;
    out.t = dot(e2, r) / det;
    return out.t >= ray.tnear && out.t <= ray.tfar;
}

// Ng in accel space; mirrors do not turn it inside out.
dvec3 side(const Geometry& g, const dvec3 p[3]) {
    const dvec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const dvec3 x{g.accel_from_local[0]}, y{g.accel_from_local[1]}, z{g.accel_from_local[2]};
    const bool turned = g.kind == GeometryKind::Instanced ? dot(x, cross(y, z)) < 0 : g.mirrored;
    const bool both = g.kind == GeometryKind::Instanced && g.mirrored;
    return turned != both ? -n : n;
}

void corners(const Geometry& g, size_t triangle, dvec3 p[3]) {
    for (size_t k = 0; k < 3; ++k) {
        const vec4& q = g.positions[g.triangles[3 * triangle + k]];
        p[k] = dvec3(q.x, q.y, q.z);
        if (g.kind == GeometryKind::Instanced) p[k] = dvec3(g.accel_from_local * dvec4(p[k], 1.0));
    }
}

}  // namespace

ReferenceHit brute_force(std::span<const Geometry> geometry, const ReferenceRay& ray) {
    ReferenceHit best;
    best.t = ray.tfar;
    for (uint32_t row = 0; row < geometry.size(); ++row) {
        const Geometry& g = geometry[row];
        const uint32_t kind = g.opaque ? kMaskOpaque : kMaskNotOpaque;
        const uint32_t mask = (mask_of_viewer(g.seen_by) & kind) | (g.seen_by & kMaskLamp);
        if (!(ray.mask & mask)) continue;
        for (uint32_t triangle = 0; triangle < g.triangles.size() / 3; ++triangle) {
            dvec3 p[3];
            corners(g, triangle, p);
            Crossing c;
            if (!meets(ray, p, c) || (best.geometry != kNone && c.t >= best.t)) continue;
            const dvec3 n = side(g, p);
            if (g.hide_backfaces && (ray.mask & kMaskCamera) && dot(n, ray.dir) > 0) continue;
            best = {g.id, row, triangle, c.u, c.v, c.t, n};
        }
    }
    return best;
}

}  // namespace kinora::raytrace
