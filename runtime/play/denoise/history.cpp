// runtime/play/denoise/history.cpp: each pixel's place taken back to the picture before: by the
// camera, by the matrix of its mesh, or by the vertices of its triangle.
//
// C. Schied and others, Spatiotemporal Variance-Guided Filtering, 2017.
#include "runtime/play/denoise/history.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "runtime/base/parallel.h"

namespace kinora {

namespace {

constexpr float kSamePlane = 0.05f;  // share of the depth
constexpr float kSameWay = 0.8f;     // cosine between normals
constexpr float kMostCount = 64;

float brightness(float r, float g, float b) {
    return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}

// The place on a triangle between three vertices.
vec3 mixed(std::span<const vec4> vertices, std::span<const uint32_t> triangles, uint32_t primitive,
           float u, float v) {
    const uint32_t* corner = &triangles[3 * size_t(primitive)];
    return (1 - u - v) * vec3(vertices[corner[0]]) + u * vec3(vertices[corner[1]]) +
           v * vec3(vertices[corner[2]]);
}

}  // namespace

// Where the point of the surface was at the picture before, accel space.
vec3 History::place_before(const Scene& scene, const FirstHits& hits, size_t hit) const {
    const uint32_t row = hits.surface[hit];
    const raytrace::Geometry& geometry = scene.geometry[row];
    if (geometry.kind == raytrace::GeometryKind::Static) return hits.P[hit];
    const bool instanced = geometry.kind == raytrace::GeometryKind::Instanced;
    std::span<const vec4> vertices = geometry.positions;
    if (!instanced && vertices_of_[row] && vertices_of_[row]->size() == vertices.size())
        vertices = *vertices_of_[row];
    const vec3 place =
        mixed(vertices, geometry.triangles, hits.primitive[hit], hits.u[hit], hits.v[hit]);
    return instanced ? vec3(dvec3(accel_from_local_[row] * dvec4(dvec3(place), 1.0))) : place;
}

// What the picture before has at a place, between its pixels; nothing where it shows others there.
std::optional<History::Seen> History::find(vec3 P, vec3 N, uint32_t surface) const {
    const dvec3 from = dvec3(P) - camera_.eye;
    const double z = glm::dot(from, camera_.forward);
    if (!(z > 0) && !camera_.orthographic) return std::nullopt;
    const dvec3 across = camera_.orthographic ? from : from / z;
    const double x = glm::dot(across, camera_.raster_dx) /
                         glm::dot(camera_.raster_dx, camera_.raster_dx) +
                     0.5 * camera_.width - 0.5,
                 y = glm::dot(across, camera_.raster_dy) /
                         glm::dot(camera_.raster_dy, camera_.raster_dy) +
                     0.5 * camera_.height - 0.5;
    if (!(x > -1 && y > -1 && x < before_.width && y < before_.height)) return std::nullopt;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const float depth = float(camera_.orthographic ? z : 1 / z);
    Seen sum;
    float weights = 0;
    for (int k = 0; k < 4; ++k) {
        const int column = left + (k & 1), row = top + (k >> 1);
        const size_t at = before_.at(column, row);  // the border is of no surface
        if (before_.surface[at] != surface) continue;
        const float right = float(x - column), below = float(y - row);
        const float expected =
            before_.depth[at] + before_.slope[0][at] * right + before_.slope[1][at] * below;
        if (std::abs(expected - depth) > kSamePlane * std::abs(depth)) continue;
        const vec3 other(before_.N[0][at], before_.N[1][at], before_.N[2][at]);
        if (glm::dot(other, N) < kSameWay) continue;
        const float weight = (1 - std::abs(right)) * (1 - std::abs(below));
        for (int c = 0; c < 4; ++c) sum.c[c] += weight * before_.c[c][at];
        sum.first += weight * moments_before_.first[at];
        sum.second += weight * moments_before_.second[at];
        sum.count += weight * moments_before_.count[at];
        weights += weight;
    }
    if (weights < 0.05f) return std::nullopt;
    for (float& c : sum.c) c /= weights;
    sum.first /= weights;
    sum.second /= weights;
    sum.count /= weights;
    return sum;
}

// What mirrors show, and shadows, does not move with the surface: a color from before lies within
// what the surface shows about the pixel now, as temporal anti-aliasing has it (Salvi 2016,
// variance clipping).
void History::clip(Seen& before, size_t at, const Planes& planes) const {
    constexpr float kDeviations = 1.0f;
    float sum[4] = {}, squares[4] = {}, count = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const size_t near = size_t(ptrdiff_t(at) + dy * ptrdiff_t(planes.stride) + dx);
            if (planes.surface[near] != planes.surface[at]) continue;
            for (int k = 0; k < 4; ++k) {
                sum[k] += fresh_[k][near];
                squares[k] += fresh_[k][near] * fresh_[k][near];
            }
            count += 1;
        }
    for (int k = 0; k < 4; ++k) {
        const float mean = sum[k] / count;
        const float about =
            kDeviations * std::sqrt(std::max(squares[k] / count - mean * mean, 0.0f));
        before.c[k] = std::clamp(before.c[k], mean - about, mean + about);
    }
    const float spread = before.second - before.first * before.first;
    before.first = brightness(before.c[0], before.c[1], before.c[2]);
    before.second = spread + before.first * before.first;
}

// The share that the new picture's color is to have for what has changed: a shadow that glides over
// a surface leaves no trail. The nine pixels' differences from what was seen there have a mean, the
// change, and a spread, the noise. The share makes the error least that both leave together. A mean
// that noise alone may have says nothing.
float History::share_of_change(size_t at, const Planes& planes) const {
    constexpr float kByChance = 2;  // times the variance of a mean
    float sum = 0, squares = 0, count = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const size_t near = size_t(ptrdiff_t(at) + dy * ptrdiff_t(planes.stride) + dx);
            if (planes.surface[near] != planes.surface[at] || !(seen_[near].count >= 1)) continue;
            const float change = brightness(fresh_[0][near], fresh_[1][near], fresh_[2][near]) -
                                 brightness(seen_[near].c[0], seen_[near].c[1], seen_[near].c[2]);
            sum += change;
            squares += change * change;
            count += 1;
        }
    if (count < 3) return 0;
    const float mean = sum / count, noise = std::max(squares / count - mean * mean, 1e-12f);
    const float change = mean * mean - kByChance * noise / count;
    return change > 0 ? change / (change + noise) : 0;
}

void History::blend_pixel(Seen before, size_t at, Planes& planes) {
    const float bright = brightness(planes.c[0][at], planes.c[1][at], planes.c[2][at]);
    float count = 1, first = bright, second = bright * bright;
    if (before.count >= 1) {
        const float changed = share_of_change(at, planes);
        clip(before, at, planes);
        count = std::min({before.count + 1, kMostCount, 1 / std::max(changed, 1e-6f)});
        const float share = std::max(1 / count, kNewest);
        for (int k = 0; k < 4; ++k)
            planes.c[k][at] = before.c[k] + share * (planes.c[k][at] - before.c[k]);
        first = before.first + share * (first - before.first);
        second = before.second + share * (second - before.second);
    }
    moments_.count[at] = count;
    moments_.first[at] = first;
    moments_.second[at] = second;
}

// Variance of the brightness of the pixels of its surface around one, before they are mixed: the
// least of four squares it is the corner of, since one of them does not cross the edge of a shadow.
float History::spread_around(const Planes& planes, int x, int y) const {
    constexpr float kLeastOfFour = 1.6f;  // what the least of four estimates is short of their mean
    const uint32_t surface = planes.surface[planes.at(x, y)];
    float least = std::numeric_limits<float>::infinity();
    for (int way = 0; way < 4; ++way) {
        float sum = 0, squares = 0, count = 0;
        for (int dy = 0; dy <= 2; ++dy)
            for (int dx = 0; dx <= 2; ++dx) {
                const size_t at = planes.at(x + (way & 1 ? dx : -dx), y + (way & 2 ? dy : -dy));
                if (planes.surface[at] != surface) continue;
                sum += moments_.first[at];
                squares += moments_.second[at];
                count += 1;
            }
        const float mean = sum / count;
        if (count > 3) least = std::min(least, std::max(squares / count - mean * mean, 0.0f));
    }
    return std::isfinite(least) ? kLeastOfFour * least : 0;
}

void History::blend(const Scene& scene, const FirstHits& hits, Planes& planes) {
    for (auto* plane : {&moments_.first, &moments_.second, &moments_.count})
        plane->resize(planes.surface.size());
    const bool known = known_ && accel_from_local_.size() == scene.geometry.size();
    if (known)
        for (int k = 0; k < 4; ++k) fresh_[k] = planes.c[k];
    seen_.assign(planes.surface.size(), {});
    const auto each_noisy = [&](auto&& see) {
        parallel_for(0, size_t(planes.height), kRowsOfTask, [&](size_t begin, size_t end) {
            for (size_t y = begin; y < end; ++y)
                for (int x = 0; x < planes.width; ++x) {
                    const size_t at = planes.at(x, int(y));
                    if (planes.variance[at] > 0) see(x, int(y), at);
                }
        });
    };
    if (known)
        each_noisy([&](int x, int y, size_t at) {
            const vec3 N(planes.N[0][at], planes.N[1][at], planes.N[2][at]);
            const size_t hit = size_t(y) * size_t(planes.width) + size_t(x);
            if (auto seen = find(place_before(scene, hits, hit), N, planes.surface[at]))
                seen_[at] = *seen;
        });
    std::fill(moments_.count.begin(), moments_.count.end(), 0.0f);
    each_noisy([&](int, int, size_t at) { blend_pixel(seen_[at], at, planes); });
    each_noisy([&](int x, int y, size_t at) {
        const float count = moments_.count[at], first = moments_.first[at];
        float spread = spread_around(planes, x, y);
        if (count >= kFew)
            spread = std::min(spread, std::max(moments_.second[at] - first * first, 0.0f));
        // Of the mixture: of so many samples of equal share, or of ever smaller ones.
        const float of_mixture = std::max(1 / count, kNewest / (2 - kNewest));
        planes.variance[at] = std::max(spread * of_mixture, 1e-12f);
    });
}

void History::keep(const Scene& scene, Planes& planes) {
    std::swap(before_, planes);
    std::swap(moments_before_, moments_);
    camera_ = scene.view;
    keep_places(scene);
    known_ = true;
}

void History::keep_places(const Scene& scene) {
    accel_from_local_.resize(scene.geometry.size());
    vertices_of_.assign(scene.geometry.size(), nullptr);
    std::map<const vec4*, size_t> kept;  // by where they lie now: rows of one mesh share them
    size_t count = 0;
    for (const raytrace::Geometry& geometry : scene.geometry)
        if (geometry.kind == raytrace::GeometryKind::Deforming &&
            kept.emplace(geometry.positions.data(), count).second)
            ++count;
    vertices_.resize(count);
    std::vector<bool> copied(count);
    for (size_t row = 0; row < scene.geometry.size(); ++row) {
        const raytrace::Geometry& geometry = scene.geometry[row];
        accel_from_local_[row] = geometry.accel_from_local;
        if (geometry.kind != raytrace::GeometryKind::Deforming) continue;
        const size_t at = kept[geometry.positions.data()];
        if (!copied[at]) vertices_[at].assign(geometry.positions.begin(), geometry.positions.end());
        copied[at] = true;
        vertices_of_[row] = &vertices_[at];
    }
}

}  // namespace kinora
