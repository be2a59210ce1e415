// runtime/player/denoise/planes.cpp: from a film and its first hits to planes, and back.
#include "runtime/player/denoise/planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/base/parallel.h"
#include "runtime/player/denoise/kernels.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

size_t whole_runs(int pixels) {
    return (size_t(pixels) + kFilterRun - 1) / kFilterRun * kFilterRun;
}

// Normals of a row of Scene::surfaces between the corners of its triangles.
class SmoothNormals {
  public:
    SmoothNormals(const SceneShapes& scene, const Pose& pose) : scene_(scene), pose_(pose) {}

    // Ng where the mesh has no normals.
    vec3 at(uint32_t row, uint32_t primitive, float u, float v, vec3 Ng) {
        if (row != row_) enter(row);
        const size_t first = 3 * size_t(primitive);
        if (group_->flat() || first + 3 > group_->normal_corners.size()) return Ng;
        const uint32_t* corner = &group_->normal_corners[first];
        for (int k = 0; k < 3; ++k)
            if (corner[k] >= normals_.size()) return Ng;
        const vec3 N = turn_ * ((1 - u - v) * vec3(normals_[corner[0]]) +
                                u * vec3(normals_[corner[1]]) + v * vec3(normals_[corner[2]]));
        const float length = glm::length(N);
        return length > 0 && std::isfinite(length) ? N / length : Ng;
    }

  private:
    void enter(uint32_t row) {
        row_ = row;
        const Surface& surface = scene_.surfaces[row];
        const Shape& shape = scene_.shapes[surface.shape];
        group_ = &scene_.meshes[shape.mesh].groups[surface.group];
        const ShapePose& stands = pose_.shapes[surface.shape];
        normals_ = stands.shown_normals;
        turn_ = shape.kind == raytrace::GeometryKind::Instanced
                    ? normal_matrix(stands.world, stands.mirrored)
                    : mat3(1.0f);
    }

    const SceneShapes& scene_;
    const Pose& pose_;
    uint32_t row_ = kNone;
    const MeshGroup* group_ = nullptr;
    std::span<const vec4> normals_;
    mat3 turn_{1.0f};
};

// Places along the view, by the picture's camera.
class Depths {
  public:
    explicit Depths(const raytrace::Camera& camera)
        : camera_(camera),
          eye_(camera.eye),
          forward_(camera.forward),
          dx_(camera.raster_dx),
          dy_(camera.raster_dy) {}

    // Depth and slopes (Planes) of the plane through P that N is perpendicular to.
    void put(vec3 P, vec3 N, size_t at, Planes& planes) const {
        const float z = glm::dot(P - eye_, forward_);
        const float facing = glm::dot(N, forward_);
        if (camera_.orthographic) {
            // (P + q dx + s forward) lies on the plane: s = -q N.dx / N.forward.
            planes.depth[at] = z;
            planes.slope[0][at] = slope(-glm::dot(N, dx_), facing);
            planes.slope[1][at] = slope(-glm::dot(N, dy_), facing);
            return;
        }
        // z (forward + x dx + y dy) lies on the plane: 1/z = (N.forward + x N.dx + y N.dy) / d.
        const float d = glm::dot(N, P - eye_);
        planes.depth[at] = z != 0 ? 1 / z : 0.0f;
        planes.slope[0][at] = slope(glm::dot(N, dx_), d);
        planes.slope[1][at] = slope(glm::dot(N, dy_), d);
    }

  private:
    static float slope(float rise, float run) { return run != 0 ? rise / run : 0.0f; }

    const raytrace::Camera& camera_;
    vec3 eye_, forward_, dx_, dy_;
};

}  // namespace

void Planes::resize(int w, int h) {
    if (w == width && h == height) return;
    width = w;
    height = h;
    stride = ptrdiff_t(whole_runs(w)) + 2 * kBorder;
    const size_t size = size_t(stride) * size_t(h + 2 * kBorder);
    for (auto* plane : {&c[0], &c[1], &c[2], &c[3], &variance, &N[0], &N[1], &N[2], &depth,
                        &slope[0], &slope[1], &albedo})
        plane->assign(size, 0.0f);
    surface.assign(size, kOutside);
}

bool fill_planes(const SceneShapes& scene, const Pose& pose, const FirstHits& hits,
                 const raytrace::Film& film, Planes& planes) {
    if (!hits.any_noise()) return false;
    planes.resize(film.width, film.height);
    const Depths depths(pose.view);
    const vec3 eye(pose.view.eye), forward(pose.view.forward);
    const bool parallel = pose.view.orthographic;
    parallel_for(0, size_t(film.height), kRowsOfTask, [&](size_t begin, size_t end) {
        SmoothNormals normals(scene, pose);
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < film.width; ++x) {
                const size_t from = y * size_t(film.width) + size_t(x);
                const size_t to = planes.at(x, int(y));
                for (int k = 0; k < 4; ++k) planes.c[k][to] = film.rgba[from][k];
                const uint32_t row = hits.surface[from];
                planes.surface[to] = row;
                const bool noisy = row != kNone && hits.noisy[scene.surfaces[row].look];
                planes.variance[to] = noisy ? 1.0f : 0.0f;
                if (!noisy) continue;
                const vec3 P = hits.P[from], Ng = hits.Ng[from];
                vec3 N = normals.at(row, hits.primitive[from], hits.u[from], hits.v[from], Ng);
                if (glm::dot(N, parallel ? forward : P - eye) > 0) N = -N;
                for (int k = 0; k < 3; ++k) planes.N[k][to] = N[k];
                depths.put(P, Ng, to, planes);
            }
    });
    return true;
}

void take_colors(const Planes& planes, raytrace::Film& film) {
    parallel_for(0, size_t(film.height), kRowsOfTask, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < film.width; ++x) {
                const size_t from = planes.at(x, int(y));
                if (!(planes.variance[from] > 0)) continue;
                vec4& to = film.at(x, int(y));
                for (int k = 0; k < 4; ++k) to[k] = planes.c[k][from];
            }
    });
}

}  // namespace kinora
