// runtime/shading/smooth_surface.cpp: where rays to lights leave a smooth surface.
//
// P is laid on the planes that the normals of the triangle's corners are perpendicular to, where
// these lie above it, and the three places are mixed by its barycentrics. The result lies on or
// above every smooth surface with those normals that bends one way. The facet is left only as far
// as it looks away from the light: where it sees the light, it shades nothing of itself.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "raytrace/hits.h"
#include "runtime/scene/scene.h"
#include "runtime/shading/nested_rays.h"

namespace kinora {

namespace {

constexpr float kSeesLight = 0.1f;  // cosine between facet and light above which it is not left
constexpr float kFlat = 1e-4f;      // a plane that rises less, a unit of way, is the facet's

vec3 unit(vec3 v) {
    float square = glm::dot(v, v);
    return square > 0 && square < std::numeric_limits<float>::infinity() ? v / std::sqrt(square)
                                                                         : vec3(0.0f);
}

// Whether way_from() surely comes to an amount of 0: the facet sees the light with a cosine beyond
// kSeesLight, and the signs of two products with the mixed normal, of which it takes no more, are
// clear without making the corners' normals exactly unit. True of most points, and without roots.
bool surely_sees_light(const vec3 n[3], const float weight[3], vec3 Ng, vec3 to_light) {
    constexpr float kNearUnit = 2e-3f;  // of squares: lengths are within half of that
    constexpr float kClear = 4e-3f;     // the mixture is off by no more than a quarter of that
    const float square = glm::dot(to_light, to_light), cosine = glm::dot(Ng, to_light);
    if (!(cosine * cosine > 1.02f * kSeesLight * kSeesLight * square)) return false;
    vec3 mixed(0.0f);
    for (int k = 0; k < 3; ++k) {
        if (!(std::abs(glm::dot(n[k], n[k]) - 1) < kNearUnit)) return false;
        mixed += weight[k] * n[k];
    }
    const float of_facet = glm::dot(mixed, Ng), of_light = glm::dot(mixed, to_light);
    if (!(std::abs(of_facet) > kClear && of_light * of_light > kClear * kClear * square))
        return false;
    return (of_facet < 0) == ((of_light < 0) != (cosine < 0));
}

}  // namespace

void SmoothSurface::enter(uint32_t row) {
    row_ = row;
    const Shape& shape = scene_.shapes[scene_.surfaces[row].shape];
    bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
    linear_ = instanced ? mat3(dmat3(shape.world)) : mat3(1.0f);
    normals_ = instanced ? normal_matrix(shape.world, shape.mirrored) : mat3(1.0f);
}

vec3 SmoothSurface::way_from(const raytrace::HitBatch& hits, uint32_t hit, vec3 to_light) {
    uint32_t row = hits.instance[hit];
    if (row == kNone) return vec3(0.0f);
    const Surface& surface = scene_.surfaces[row];
    const Shape& shape = scene_.shapes[surface.shape];
    const MeshGroup& group = scene_.meshes[shape.mesh].groups[surface.group];
    size_t first = 3 * size_t(hits.primitive[hit]);
    if (first + 3 > group.normal_corners.size()) return vec3(0.0f);  // it has no normals
    const uint32_t* corner = &group.normal_corners[first];
    size_t entries = shape.rest_normals.size();
    if (corner[0] >= entries || corner[1] >= entries || corner[2] >= entries) return vec3(0.0f);
    vec3 n[3];
    for (size_t k = 0; k < 3; ++k) n[k] = vec3(shape.rest_normals[corner[k]]);
    if (n[0] == n[1] && n[0] == n[2]) return vec3(0.0f);
    if (row != row_) enter(row);
    float weight[3] = {1 - hits.u[hit] - hits.v[hit], hits.u[hit], hits.v[hit]};
    vec3 Ng = triple(hits.Ng, hit), N(0.0f);
    for (vec3& normal : n) normal = normals_ * normal;
    if (surely_sees_light(n, weight, Ng, to_light)) return vec3(0.0f);
    for (size_t k = 0; k < 3; ++k) N += weight[k] * (n[k] = unit(n[k]));

    // All on the side of the surface that the light is on.
    float side = glm::dot(N, to_light) < 0 ? -1.0f : 1.0f;
    float facing = glm::dot(N, Ng) * side < 0 ? -1.0f : 1.0f;
    float cosine = facing * glm::dot(Ng, to_light) / glm::length(to_light);
    float amount = std::clamp(1 - cosine / kSeesLight, 0.0f, 1.0f);
    if (!(amount > 0)) return vec3(0.0f);
    const uint32_t* vertex = &group.triangles[first];
    vec3 at[3], P(0.0f);  // relative to the first corner
    for (size_t k = 0; k < 3; ++k) {
        at[k] = linear_ *
                (vec3(shape.rest_positions[vertex[k]]) - vec3(shape.rest_positions[vertex[0]]));
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
