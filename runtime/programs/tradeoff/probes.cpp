// runtime/programs/tradeoff/probes.cpp: vertices, hits at pixels' centres, units in the last place.
#include "runtime/programs/tradeoff/probes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/parallel.h"
#include "runtime/picture/compare/errors.h"
#include "runtime/picture/compare/ulp.h"

namespace kinora {

namespace {

constexpr float kNoHit = std::numeric_limits<float>::infinity();

std::vector<dvec3> shape_positions(const SceneShapes& scene, const Shape& shape,
                                   const ShapePose& stands, size_t most) {
    std::vector<dvec3> positions;
    std::span<const vec4> shown = stands.shown_positions;
    size_t step = std::max<size_t>(1, (shown.size() + most - 1) / most);
    bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
    for (size_t i = 0; i < shown.size(); i += step) {
        dvec3 p(shown[i]);
        positions.push_back(
            instanced ? dvec3(stands.world * dvec4(p + scene.meshes[shape.mesh].anchor, 1))
                      : p + scene.origin);
    }
    return positions;
}

void put_ray(const raytrace::Camera& camera, size_t pixel, raytrace::RayPacket16& rays, int lane) {
    size_t width = size_t(camera.width);
    raytrace::CameraRay ray =
        raytrace::camera_ray(camera, double(pixel % width) + 0.5, double(pixel / width) + 0.5);
    rays.org_x[lane] = ray.org.x;
    rays.org_y[lane] = ray.org.y;
    rays.org_z[lane] = ray.org.z;
    rays.dir_x[lane] = ray.dir.x;
    rays.dir_y[lane] = ray.dir.y;
    rays.dir_z[lane] = ray.dir.z;
    rays.tnear[lane] = ray.tnear;
    rays.tfar[lane] = ray.tfar;
    rays.mask[lane] = raytrace::kMaskEye;
    rays.time[lane] = 0;
}

// Raster position of a world point; nothing behind the camera.
std::optional<dvec2> raster(const SceneExtent& scene, const Pose& pose, const dvec3& world) {
    const raytrace::Camera& camera = pose.view;
    dvec3 d = world - scene.origin - camera.eye;
    double depth = camera.orthographic ? 1.0 : glm::dot(d, camera.forward);
    if (!(depth > 0)) return std::nullopt;
    double x = glm::dot(d, camera.right) / (depth * camera.half_width);
    double y = glm::dot(d, camera.up) / (depth * camera.half_height);
    return dvec2(0.5 * camera.width * x, 0.5 * camera.height * y);
}

// f(p, q) of all pairs; false where the numbers differ.
template <class F>
bool for_each_pair(std::span<const std::vector<dvec3>> a, std::span<const std::vector<dvec3>> b,
                   F&& f) {
    if (a.size() != b.size()) return false;
    for (size_t s = 0; s < a.size(); ++s) {
        if (a[s].size() != b[s].size()) return false;
        for (size_t i = 0; i < a[s].size(); ++i) f(a[s][i], b[s][i]);
    }
    return true;
}

}  // namespace

std::vector<std::vector<dvec3>> vertex_positions(const SceneShapes& scene, const Pose& pose,
                                                 size_t most) {
    std::vector<std::vector<dvec3>> positions;
    for (size_t s = 0; s < scene.shapes.size(); ++s)
        positions.push_back(shape_positions(scene, scene.shapes[s], pose.shapes[s], most));
    return positions;
}

std::vector<float> hit_distances(const Pose& pose) {
    const raytrace::Camera& camera = pose.view;
    const size_t count = size_t(camera.width) * size_t(camera.height);
    std::vector<float> distances(count, kNoHit);
    parallel_for(0, (count + raytrace::kPacket - 1) / raytrace::kPacket, 64,
                 [&](size_t begin, size_t end) {
                     raytrace::TraceCounters counters;
                     for (size_t packet = begin; packet < end; ++packet) {
                         raytrace::RayPacket16 rays{};
                         raytrace::HitPacket16 hits{};
                         size_t first = packet * raytrace::kPacket;
                         int lanes = int(std::min<size_t>(raytrace::kPacket, count - first));
                         for (int k = 0; k < lanes; ++k)
                             put_ray(camera, first + size_t(k), rays, k);
                         rays.active = (1u << lanes) - 1;
                         uint32_t hit = pose.accel.intersect16(rays, hits, counters);
                         for (int k = 0; k < lanes; ++k)
                             if (hit >> k & 1) distances[first + size_t(k)] = hits.t[k];
                     }
                 });
    return distances;
}

std::optional<double> largest_step(std::span<const std::vector<dvec3>> a,
                                   std::span<const std::vector<dvec3>> b) {
    double largest = 0;
    bool same = for_each_pair(a, b, [&](const dvec3& p, const dvec3& q) {
        largest = std::max(largest, glm::length(p - q));
    });
    return same ? std::optional(largest) : std::nullopt;
}

std::optional<double> largest_step_pixels(const SceneExtent& scene, const Pose& pose,
                                          std::span<const std::vector<dvec3>> a,
                                          std::span<const std::vector<dvec3>> b) {
    double largest = 0;
    bool same = for_each_pair(a, b, [&](const dvec3& p, const dvec3& q) {
        std::optional<dvec2> at_p = raster(scene, pose, p), at_q = raster(scene, pose, q);
        if (at_p && at_q) largest = std::max(largest, glm::length(*at_p - *at_q));
    });
    return same ? std::optional(largest) : std::nullopt;
}

HitErrors hit_errors(std::span<const float> a, std::span<const float> b) {
    HitErrors errors;
    size_t alone = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        alone += (a[i] == kNoHit) != (b[i] == kNoHit);
        if (a[i] != kNoHit && b[i] != kNoHit)
            errors.distance = std::max(errors.distance, std::abs(double(a[i]) - double(b[i])));
    }
    errors.mismatch = a.empty() ? 0 : double(alone) / double(a.size());
    return errors;
}

UlpErrors ulp_errors(const PictureView& a, const PictureView& b, std::span<const float> hits_a,
                     std::span<const float> hits_b) {
    std::vector<double> ulps;
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        if (hits_a[i] != hits_b[i] || hits_a[i] == kNoHit) continue;
        for (int k = 0; k < 3; ++k) ulps.push_back(ulps_between(a.rgba[i][k], b.rgba[i][k]));
    }
    if (ulps.empty()) return {};
    return {*std::ranges::max_element(ulps), percentile(ulps, 0.99)};
}

}  // namespace kinora
