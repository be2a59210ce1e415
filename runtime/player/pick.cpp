// runtime/player/pick.cpp: a ray through a pixel, and the names of what it meets.
#include "runtime/player/inspector.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/player/shown_scene.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

struct Hit {
    uint32_t row, primitive;
    float u, v;
};

// The surface's normal at the hit, in world space: of its corners where it has such.
dvec3 normal_at(const Scene& scene, const Pose& pose, const Hit& hit, dvec3 Ng) {
    const Surface& surface = scene.surfaces[hit.row];
    const Shape& shape = scene.shapes[surface.shape];
    const ShapePose& stands = pose.shapes[surface.shape];
    const MeshGroup& group = scene.meshes[shape.mesh].groups[surface.group];
    size_t first = 3 * size_t(hit.primitive);
    if (first + 3 > group.normal_corners.size()) return Ng;
    double weight[3] = {1.0 - hit.u - hit.v, hit.u, hit.v};
    dvec3 N(0.0);
    for (size_t k = 0; k < 3; ++k) {
        uint32_t corner = group.normal_corners[first + k];
        if (corner >= stands.shown_normals.size()) return Ng;
        N += weight[k] * dvec3(vec3(stands.shown_normals[corner]));
    }
    if (shape.kind == raytrace::GeometryKind::Instanced)
        N = glm::transpose(glm::inverse(dmat3(stands.world))) * N;
    double length = glm::length(N);
    if (!(length > 0)) return Ng;
    return glm::dot(N, Ng) < 0 ? -N / length : N / length;
}

// Texture coordinates, else the barycentrics.
dvec2 uv_at(const Scene& scene, const Hit& hit) {
    const VertexAttribute* st = scene.surfaces[hit.row].st;
    size_t first = 3 * size_t(hit.primitive);
    if (!st || st->stride < 2 || first + 3 > st->corners.size()) return {hit.u, hit.v};
    double weight[3] = {1.0 - hit.u - hit.v, hit.u, hit.v};
    dvec2 uv(0.0);
    for (size_t k = 0; k < 3; ++k) {
        size_t at = size_t(st->corners[first + k]) * st->stride;
        if (at + 1 >= st->values.size()) return {hit.u, hit.v};
        uv += weight[k] * dvec2(st->values[at], st->values[at + 1]);
    }
    return uv;
}

void name(const Scene& scene, uint32_t row, PickedPixel& picked) {
    const Surface& surface = scene.surfaces[row];
    const Shape& shape = scene.shapes[surface.shape];
    picked.node = node_path(scene, shape.node);
    uint32_t mesh = scene.meshes[shape.mesh].definition;
    if (mesh != kNone) picked.mesh = scene.description->meshes[mesh].id;
    if (surface.material != kNone)
        picked.material = scene.description->materials[surface.material].id;
    if (surface.look < scene.shader_instances.size() &&
        !scene.shader_instances[surface.look]->layers.empty())
        picked.shader = scene.shader_instances[surface.look]->shader().name;
}

}  // namespace

vec4 color_at(const Picture& picture, int x, int y) {
    const raytrace::Film& film = picture.film;
    const bool inside = x >= 0 && y >= 0 && x < picture.width && y < picture.height;
    if (!inside || film.width < 1) return vec4(0.0f);
    int fx = std::min(int((x + 0.5) * film.width / picture.width), film.width - 1);
    int fy = std::min(int((y + 0.5) * film.height / picture.height), film.height - 1);
    return film.at(fx, fy);
}

PickedPixel pick_pixel(const Inspected& inspected, int x, int y) {
    const Scene& scene = inspected.scene;
    const Pose& pose = inspected.pose;
    const int width = inspected.order.width, height = inspected.order.height;
    PickedPixel picked;
    picked.x = x;
    picked.y = y;
    if (!inspected.stands || x < 0 || y < 0 || x >= width || y >= height) return picked;
    const raytrace::Camera& camera = pose.view;
    if (camera.width < 1 || camera.height < 1) return picked;
    raytrace::CameraRay ray = raytrace::camera_ray(camera, (x + 0.5) * camera.width / width,
                                                   (y + 0.5) * camera.height / height);
    raytrace::RayPacket16 rays{};
    raytrace::HitPacket16 hits;
    raytrace::TraceCounters counters;
    rays.active = 1;
    rays.org_x[0] = ray.org.x, rays.org_y[0] = ray.org.y, rays.org_z[0] = ray.org.z;
    rays.dir_x[0] = ray.dir.x, rays.dir_y[0] = ray.dir.y, rays.dir_z[0] = ray.dir.z;
    rays.tnear[0] = ray.tnear;
    rays.tfar[0] = ray.tfar;
    rays.mask[0] = raytrace::kMaskEye;
    if ((pose.accel.intersect16(rays, hits, counters) & 1) == 0) return picked;
    picked.hit = true;
    Hit hit{hits.instance[0], hits.primitive[0], hits.u[0], hits.v[0]};
    raytrace::SurfacePoint point = pose.accel.surface_point(hit.row, hit.primitive, hit.u, hit.v);
    dvec3 Ng(point.Ng), direction(ray.dir);
    if (glm::dot(Ng, direction) > 0) Ng = -Ng;
    picked.P = scene.origin + dvec3(point.p);
    picked.N = normal_at(scene, pose, hit, Ng);
    picked.distance = double(hits.t[0]);
    dvec2 uv = uv_at(scene, hit);
    picked.u = uv.x;
    picked.v = uv.y;
    name(scene, hit.row, picked);
    return picked;
}

}  // namespace kinora
