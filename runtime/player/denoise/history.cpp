// runtime/player/denoise/history.cpp: each pixel's place taken back to the picture before: by the
// camera, by the matrix of its mesh, or by the vertices of its triangle.
//
// C. Schied and others, Spatiotemporal Variance-Guided Filtering, 2017.
#include "runtime/player/denoise/history.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "runtime/base/parallel.h"
#include "runtime/player/denoise/history_kernels.h"
#include "runtime/scene/pose.h"

namespace kinora {

namespace {

// The place on a triangle between three vertices.
vec3 mixed(std::span<const vec4> vertices, std::span<const uint32_t> triangles, uint32_t primitive,
           float u, float v) {
    const uint32_t* corner = &triangles[3 * size_t(primitive)];
    return (1 - u - v) * vec3(vertices[corner[0]]) + u * vec3(vertices[corner[1]]) +
           v * vec3(vertices[corner[2]]);
}

bool is_noisy(const Planes& planes, size_t at) {
    return filter_kernels().exceeds(&planes.variance[at], 0);
}

void forget_stretch(Moments& moments, size_t at) {
    std::fill_n(&moments.count[at], kFilterRun, 0.0f);
}

SeenRows rows_of(const std::vector<float> (&c)[4], const Moments& moments, size_t at) {
    return {{&c[0][at], &c[1][at], &c[2][at], &c[3][at]},
            &moments.first[at],
            &moments.second[at],
            &moments.count[at]};
}

}  // namespace

void Moments::resize(size_t size) {
    for (auto* plane : {&first, &second, &count}) plane->resize(size);
}

// Where the point of the surface was at the picture before, accel space.
vec3 History::place_before(const Pose& pose, const FirstHits& hits, size_t hit) const {
    const uint32_t row = hits.surface[hit];
    const raytrace::Geometry& geometry = pose.rows[row];
    if (geometry.kind == raytrace::GeometryKind::Static) return hits.P[hit];
    const bool instanced = geometry.kind == raytrace::GeometryKind::Instanced;
    std::span<const vec4> vertices = geometry.positions;
    if (!instanced && vertices_of_[row] && vertices_of_[row]->size() == vertices.size())
        vertices = *vertices_of_[row];
    const vec3 place =
        mixed(vertices, geometry.triangles, hits.primitive[hit], hits.u[hit], hits.v[hit]);
    return instanced ? vec3(dvec3(accel_from_local_[row] * dvec4(dvec3(place), 1.0))) : place;
}

// Where a place is in the picture before.
void History::find(vec3 P, Places& places, size_t i) const {
    const dvec3 from = dvec3(P) - view_.eye;
    const double z = glm::dot(from, view_.forward), inverse = view_.parallel ? 1 : 1 / z;
    if (!(z > 0) && !view_.parallel) return;
    places.x[i] = float(glm::dot(from, view_.right) * inverse + view_.center.x);
    places.y[i] = float(glm::dot(from, view_.down) * inverse + view_.center.y);
    places.depth[i] = float(view_.parallel ? z : inverse);
}

void History::look_back(const Pose& pose, const FirstHits& hits, size_t at, const Planes& planes) {
    const size_t y = at / size_t(planes.stride) - Planes::kBorder,
                 x = at % size_t(planes.stride) - Planes::kBorder;
    const size_t hit = y * size_t(planes.width) + x;
    Places places;
    for (size_t i = 0; i < kFilterRun; ++i) {
        places.x[i] = places.y[i] = -1;
        places.depth[i] = 0;
        if (planes.variance[at + i] > 0) find(place_before(pose, hits, hit + i), places, i);
    }
    const ptrdiff_t border = Planes::kBorder;
    history_kernels().look_back(
        {width_, height_, stride_, before_.data() + border * stride_ + border},
        {places.x,
         places.y,
         places.depth,
         &planes.surface[at],
         {&planes.N[0][at], &planes.N[1][at], &planes.N[2][at]}},
        {{&seen_[0][at], &seen_[1][at], &seen_[2][at], &seen_[3][at]},
         &seen_moments_.first[at],
         &seen_moments_.second[at],
         &seen_moments_.count[at]});
}

// Pixels without a variance have seen nothing, and say nothing.
void History::mix(Planes& planes) {
    const HistoryKernels& kernels = history_kernels();
    each_stretch(planes, [&](size_t at) {
        if (!is_noisy(planes, at)) return forget_stretch(moments_, at);
        kernels.blend({&planes.surface[at],
                       &planes.variance[at],
                       {&fresh_[0][at], &fresh_[1][at], &fresh_[2][at], &fresh_[3][at]},
                       rows_of(seen_, seen_moments_, at),
                       {&planes.c[0][at], &planes.c[1][at], &planes.c[2][at], &planes.c[3][at]},
                       &moments_.first[at],
                       &moments_.second[at],
                       &moments_.count[at]},
                      planes.stride);
    });
    each_stretch(planes, [&](size_t at) {
        if (is_noisy(planes, at))
            kernels.find_variance(&planes.surface[at], rows_of(fresh_, moments_, at), planes.stride,
                                  &planes.variance[at]);
    });
}

void History::blend(const Pose& pose, const FirstHits& hits, Planes& planes) {
    const size_t size = planes.surface.size();
    for (Moments* moments : {&moments_, &seen_moments_}) moments->resize(size);
    for (auto& plane : seen_) plane.resize(size);
    const bool known = known_ && accel_from_local_.size() == pose.rows.size();
    for (int k = 0; k < 4; ++k) {
        fresh_[k].resize(size);
        fresh_[k].swap(planes.c[k]);  // stretches without noise are not asked for again
    }
    each_stretch(planes, [&](size_t at) {
        known&& is_noisy(planes, at) ? look_back(pose, hits, at, planes)
                                     : forget_stretch(seen_moments_, at);
    });
    mix(planes);
}

// The border, too, which is of no surface.
void History::keep_pixels(const Planes& p) {
    before_.resize(p.surface.size());
    parallel_for(0, before_.size(), size_t(stride_) * kRowsOfTask, [&](size_t begin, size_t end) {
        for (size_t at = begin; at < end; ++at)
            before_[at] = {{p.c[0][at], p.c[1][at], p.c[2][at], p.c[3][at]},
                           moments_.first[at],
                           moments_.second[at],
                           moments_.count[at],
                           p.depth[at],
                           {p.N[0][at], p.N[1][at], p.N[2][at]},
                           {p.slope[0][at], p.slope[1][at]},
                           p.surface[at]};
    });
}

void History::keep(const Pose& pose, const Planes& planes) {
    width_ = planes.width;
    height_ = planes.height;
    stride_ = planes.stride;
    keep_pixels(planes);
    const raytrace::Camera& camera = pose.view;
    view_ = {camera.eye,
             camera.forward,
             camera.raster_dx / glm::dot(camera.raster_dx, camera.raster_dx),
             camera.raster_dy / glm::dot(camera.raster_dy, camera.raster_dy),
             camera.axis - 0.5,
             camera.orthographic};
    keep_places(pose);
    known_ = true;
}

void History::keep_places(const Pose& pose) {
    accel_from_local_.resize(pose.rows.size());
    vertices_of_.assign(pose.rows.size(), nullptr);
    std::map<const vec4*, size_t> kept;  // by where they lie now: rows of one mesh share them
    size_t count = 0;
    for (const raytrace::Geometry& geometry : pose.rows)
        if (geometry.kind == raytrace::GeometryKind::Deforming &&
            kept.emplace(geometry.positions.data(), count).second)
            ++count;
    vertices_.resize(count);
    std::vector<bool> copied(count);
    for (size_t row = 0; row < pose.rows.size(); ++row) {
        const raytrace::Geometry& geometry = pose.rows[row];
        accel_from_local_[row] = geometry.accel_from_local;
        if (geometry.kind != raytrace::GeometryKind::Deforming) continue;
        const size_t at = kept[geometry.positions.data()];
        if (!copied[at]) vertices_[at].assign(geometry.positions.begin(), geometry.positions.end());
        copied[at] = true;
        vertices_of_[row] = &vertices_[at];
    }
}

}  // namespace kinora
