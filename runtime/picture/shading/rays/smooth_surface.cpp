// runtime/picture/shading/rays/smooth_surface.cpp: the surface that vertex normals describe: where
// rays to lights leave it, and how it bends.
//
// P is laid on the planes that the normals of the triangle's corners are perpendicular to, where
// these lie above it, and the three places are mixed by its barycentrics. The result lies on or
// above every smooth surface with those normals that bends one way. The facet is left only as far
// as it looks away from the light: where it sees the light, it shades nothing of itself.
#include "runtime/picture/shading/rays/smooth_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr float kFlat = 1e-4f;  // a plane that rises less, a unit of way, is the facet's

vec3 unit(vec3 v) {
    float square = glm::dot(v, v);
    return square > 0 && square < std::numeric_limits<float>::infinity() ? v / std::sqrt(square)
                                                                         : vec3(0.0f);
}

}  // namespace

void SmoothSurface::enter(uint32_t row) {
    const Surface& surface = shapes_.surfaces[row];
    const Shape& shape = shapes_.shapes[surface.shape];
    const ShapePose& stands = pose_.shapes[surface.shape];
    const MeshGroup& group = shapes_.meshes[shape.mesh].groups[surface.group];
    row_ = {row,
            group.normal_corners,
            group.triangles,
            stands.shown_normals,
            stands.shown_positions,
            mat3(1.0f),
            mat3(1.0f)};
    if (shape.kind != raytrace::GeometryKind::Instanced) return;
    row_.from_rest = mat3(dmat3(stands.world));
    row_.normals_from_rest = normal_matrix(stands.world, stands.mirrored);
}

// Indices of its three normals; null where it has none.
inline const uint32_t* SmoothSurface::corners(uint32_t primitive) const {
    const size_t first = 3 * size_t(primitive), entries = row_.normals.size();
    if (first + 3 > row_.normal_corners.size()) return nullptr;
    const uint32_t* corner = &row_.normal_corners[first];
    const bool good = corner[0] < entries && corner[1] < entries && corner[2] < entries;
    return good ? corner : nullptr;
}

vec3 SmoothSurface::way_from(const raytrace::HitBatch& hits, uint32_t hit, vec3 to_light) {
    uint32_t row = hits.instance[hit];
    if (row == kNone) return vec3(0.0f);
    if (row != row_.number) enter(row);
    const uint32_t* corner = corners(hits.primitive[hit]);
    if (!corner) return vec3(0.0f);
    vec3 n[3];
    for (size_t k = 0; k < 3; ++k) n[k] = vec3(row_.normals[corner[k]]);
    if (n[0] == n[1] && n[0] == n[2]) return vec3(0.0f);
    float weight[3] = {1 - hits.u[hit] - hits.v[hit], hits.u[hit], hits.v[hit]};
    vec3 Ng = triple(hits.Ng, hit), N(0.0f);
    for (size_t k = 0; k < 3; ++k) N += weight[k] * (n[k] = unit(row_.normals_from_rest * n[k]));

    // All on the side of the surface that the light is on.
    float side = glm::dot(N, to_light) < 0 ? -1.0f : 1.0f;
    float facing = glm::dot(N, Ng) * side < 0 ? -1.0f : 1.0f;
    float cosine = facing * glm::dot(Ng, to_light) / glm::length(to_light);
    float amount = std::clamp(1 - cosine / kSeesLight, 0.0f, 1.0f);
    if (!(amount > 0)) return vec3(0.0f);
    const uint32_t* vertex = &row_.triangles[3 * size_t(hits.primitive[hit])];
    vec3 at[3], P(0.0f);  // relative to the first corner
    for (size_t k = 0; k < 3; ++k) {
        at[k] =
            row_.from_rest * (vec3(row_.positions[vertex[k]]) - vec3(row_.positions[vertex[0]]));
        P += weight[k] * at[k];
    }
    vec3 way(0.0f);
    for (size_t k = 0; k < 3; ++k) {
        vec3 up = side * n[k], to_corner = at[k] - P;
        // Normals through which no one surface runs say nothing.
        if (!(glm::dot(up, Ng) * facing > 0)) return vec3(0.0f);
        float height = glm::dot(to_corner, up);
        if (height > kFlat * glm::length(to_corner)) way += (weight[k] * height) * up;
    }
    return way * amount;
}

bool SmoothSurface::bend_at(const raytrace::HitBatch& hits, uint32_t hit, vec3& dNdx, vec3& dNdy) {
    const uint32_t row = hits.instance[hit];
    if (row == kNone) return false;
    if (row != row_.number) enter(row);
    const uint32_t primitive = hits.primitive[hit];
    const uint32_t* corner = corners(primitive);
    if (!corner) return false;
    vec3 n[3], at[3];
    for (size_t k = 0; k < 3; ++k) n[k] = vec3(row_.normals[corner[k]]);
    if (n[0] == n[1] && n[0] == n[2]) return false;
    const uint32_t* vertex = &row_.triangles[3 * size_t(primitive)];
    for (size_t k = 0; k < 3; ++k) {
        n[k] = row_.normals_from_rest * n[k];
        at[k] =
            row_.from_rest * (vec3(row_.positions[vertex[k]]) - vec3(row_.positions[vertex[0]]));
    }
    const float u = hits.u[hit], v = hits.v[hit];
    const vec3 N = (1 - u - v) * n[0] + u * n[1] + v * n[2], Ng = triple(hits.Ng, hit);
    const float length = glm::length(N);
    // In double: squares of areas are no floats in scenes of micrometres.
    const dvec3 e(at[1]), f(at[2]);
    const double ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f);
    const double area = ee * ff - ef * ef;
    if (!(length > 0 && area > 0)) return false;
    const float side = (glm::dot(N, Ng) < 0) == (glm::dot(triple(hits.dir, hit), Ng) < 0) ? -1 : 1;
    // Of the mixture over its length, with the share along N taken off.
    auto along = [&](vec3 dP) {
        const double pe = glm::dot(dvec3(dP), e), pf = glm::dot(dvec3(dP), f);
        const float du = float((pe * ff - pf * ef) / area), dv = float((pf * ee - pe * ef) / area);
        const vec3 d = du * (n[1] - n[0]) + dv * (n[2] - n[0]);
        const vec3 turned = (d - N * (glm::dot(d, N) / (length * length))) * (side / length);
        return glm::dot(turned, turned) < std::numeric_limits<float>::max() ? turned : vec3(0.0f);
    };
    dNdx = along(triple(hits.dPdx, hit));
    dNdy = along(triple(hits.dPdy, hit));
    return true;
}

bool is_way_free(const raytrace::Accel& accel, vec3 P, vec3 error, vec3 Ng, vec3 way,
                 raytrace::TraceCounters& counters) {
    vec3 org = raytrace::offset_ray_origin(P, error, Ng, way), dir = P + way - org;
    if (!(glm::dot(dir, way) > 0)) return true;  // within the error of P
    raytrace::RayPacket16 rays{};
    rays.active = 1;
    rays.org_x[0] = org.x, rays.org_y[0] = org.y, rays.org_z[0] = org.z;
    rays.dir_x[0] = dir.x, rays.dir_y[0] = dir.y, rays.dir_z[0] = dir.z;
    rays.tnear[0] = 0;
    rays.tfar[0] = 1;
    rays.mask[0] = raytrace::kMaskAll;
    rays.time[0] = 0;
    return accel.occluded16(rays, counters) == 0;
}

}  // namespace kinora
