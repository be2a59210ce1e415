// runtime/picture/shading/lighting/area_light.cpp: lights on geometry: their shaders run at samples
// of the mesh.
//
// Each lit point asks n samples (lamp_sampler.cpp). A sample is a light of its own (P, N, u, v, s,
// t on the mesh; what the shader illuminates is a record) whose Cl counts 1/n where samples are
// even in area: the mean over the surface of what a point light with that shader would give, so a
// light that shrinks to a point becomes that point light. The samples follow the mesh of the frame.
// A surface does not light itself.
#include "runtime/picture/shading/lighting/area_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace kinora {

namespace {

constexpr uint32_t kUsualSamples = 16, kSamplesBesideIndirect = 2;

// Uniform over a triangle: u, v of its corners 1 and 2 (P. Shirley and K. Chiu 1997: the square
// folded by a root).
vec2 on_triangle(float x, float y) {
    float root = std::sqrt(x);
    return {root * (1 - y), root * y};
}

}  // namespace

uint32_t light_samples(const ShadingFrame& frame, size_t light, bool beside_indirect) {
    const LightSource& source = frame.lights.lights[light];
    const uint32_t own = frame.resources.description->lights[source.definition].samples;
    if (frame.quality.light_samples) return frame.quality.light_samples;
    return own ? own : beside_indirect ? kSamplesBesideIndirect : kUsualSamples;
}

AreaLights::AreaLights(const ShadingFrame& frame, const LightBindings& bindings)
    : frame_(frame), bindings_(bindings) {
    for (size_t l = 0; l < frame.lights.lights.size(); ++l) {
        const LightSource& source = frame.lights.lights[l];
        auto& light = lights_.emplace_back();
        if (source.surface == kNone) continue;
        light = std::make_unique<AreaLight>();
        all_.push_back(l);
        light->surfaces = source.emitting;
        light->emits = !source.emitting.empty();
        if (!light->emits) light->surfaces = {source.surface};
        light->directed = bindings.directed(l);
    }
}

void AreaLights::begin_frame() {
    const SceneShapes& shapes = frame_.shapes;
    for (size_t l = 0; l < lights_.size(); ++l) {
        if (!lights_[l]) continue;
        AreaLight& light = *lights_[l];
        const bool still = std::ranges::all_of(light.surfaces, [&](uint32_t surface) {
            const Shape& shape = shapes.shapes[shapes.surfaces[surface].shape];
            return shape.kind == raytrace::GeometryKind::Static;
        });
        if (light.known && still) continue;
        find_areas(light);
        find_shape(light);
        light.hides_far = hides_far(l);
        light.known = true;
    }
}

void AreaLights::find_areas(AreaLight& light) {
    light.areas.clear();
    light.first.clear();
    light.power.clear();
    for (uint32_t surface : light.surfaces) add_areas(light, surface);
    light.first.push_back(uint32_t(light.areas.size()));
    sum_up(light);
}

void AreaLights::sum_up(AreaLight& light) {
    light.below.resize(light.areas.size());
    double sum = 0;
    for (size_t t = 0; t < light.areas.size(); ++t) {
        sum += light.areas[t] * (light.power.empty() ? 1.0 : double(light.power[t]));
        light.below[t] = float(sum);
    }
}

void AreaLights::add_areas(AreaLight& light, uint32_t number) {
    const SceneShapes& shapes = frame_.shapes;
    const Surface& surface = shapes.surfaces[number];
    const Shape& shape = shapes.shapes[surface.shape];
    const ShapePose& stands = frame_.pose.shapes[surface.shape];
    const auto& triangles = shapes.meshes[shape.mesh].groups[surface.group].triangles;
    bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
    dmat3 linear = instanced ? dmat3(stands.world) : dmat3(1.0);
    light.first.push_back(uint32_t(light.areas.size()));
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        auto corner = [&](size_t k) {
            return linear * dvec3(stands.shown_positions[triangles[t + k]]);
        };
        const double area =
            0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        light.areas.push_back(std::isfinite(area) ? area : 0.0);
    }
}

void AreaLights::weigh(size_t number, std::span<const float> power) {
    AreaLight& light = *lights_[number];
    light.power.assign(power.begin(), power.end());
    sum_up(light);
}

float AreaLight::area_at(uint32_t surface, uint32_t triangle) const {
    if (power.empty()) return below.back();
    const auto part = std::ranges::lower_bound(surfaces, surface) - surfaces.begin();
    return below.back() / power[first[size_t(part)] + triangle];
}

void AreaLights::find_shape(AreaLight& light) {
    light.shape = {};
    light.facets = {};
    if (!light.has_area() || light.surfaces.size() > 1) return;
    corners_.clear();
    numbers_.clear();
    float before = 0;
    for (uint32_t t = 0; t < light.below.size(); ++t) {
        if (!(light.below[t] > std::exchange(before, light.below[t]))) continue;
        numbers_.push_back(t);
        for (int k = 0; k < 3; ++k) {
            const float u = k == 1 ? 1.0f : 0.0f, v = k == 2 ? 1.0f : 0.0f;
            corners_.push_back(
                dvec3(frame_.pose.accel.surface_point(light.surfaces[0], t, u, v).p));
        }
    }
    light.shape = find_lamp_shape(corners_);
    if (light.shape.kind == LampShape::Kind::Rectangle)
        light.facets = facets_of(light.shape, corners_, numbers_);
}

bool AreaLights::hides_far(size_t light) const {
    auto blocks = [&](uint32_t surface) {
        const raytrace::Geometry& row = frame_.pose.rows[surface];
        return row.opaque && (row.seen_by & raytrace::kSeenByShadows) != 0;
    };
    return std::ranges::all_of(lights_[light]->surfaces, blocks) &&
           std::ranges::all_of(bindings_.statements(light), &LightOutputs::casts_shadow);
}

LampPlace place_on(const AreaLight& light, vec2 u) {
    const std::vector<float>& below = light.below;
    const float wanted = u.x * below.back();
    size_t t = size_t(std::upper_bound(below.begin(), below.end(), wanted) - below.begin());
    t = std::min(t, below.size() - 1);
    const float from = t ? below[t - 1] : 0.0f, area = below[t] - from;
    const auto part = std::ranges::upper_bound(light.first, uint32_t(t)) - light.first.begin() - 1;
    return {light.surfaces[size_t(part)], uint32_t(t) - light.first[size_t(part)],
            on_triangle(area > 0 ? std::min((wanted - from) / area, 1.0f) : 0.0f, u.y)};
}

LightSamples::LightSamples(Arena& arena, size_t count, uint32_t surface) {
    size_t rows = padded(count);
    auto take = [&] { return arena.allocate_span<float>(rows).data(); };
    float* zeros = take();
    std::fill_n(zeros, rows, 0.0f);
    std::span<uint32_t> none = arena.allocate_span<uint32_t>(rows);
    std::fill(none.begin(), none.end(), 0u);
    instance = arena.allocate_span<uint32_t>(rows);
    std::fill(instance.begin(), instance.end(), surface);
    primitive = arena.allocate_span<uint32_t>(rows);
    u = take();
    v = take();
    density = take();
    share = take();
    std::fill_n(share, rows, 1.0f);
    hits = {};
    hits.count = count;
    hits.geometry = hits.instance = instance.data();
    hits.primitive = primitive.data();
    hits.u = u;
    hits.v = v;
    hits.t = zeros;
    hits.ray = none.data();
    hits.time = zeros;
    hits.pixel_x = hits.pixel_y = hits.sample = hits.layer = none.data();
    for (size_t k = 0; k < 3; ++k) {
        on_surface.P[k] = take();
        on_surface.P_error[k] = take();
        on_surface.Ng[k] = take();
        hits.P[k] = on_surface.P[k];
        hits.P_error[k] = on_surface.P_error[k];
        hits.Ng[k] = on_surface.Ng[k];
        hits.org[k] = hits.dir[k] = zeros;
        hits.dPdx[k] = hits.dPdy[k] = hits.dDdx[k] = hits.dDdy[k] = zeros;
    }
}

void LightSamples::find_points(const raytrace::Accel& accel) const {
    accel.surface_points(hits.count, instance.data(), primitive.data(), u, v, on_surface);
}

LightSamples::LightSamples(const Grid& grid, size_t first, size_t count, uint32_t surface)
    : LightSamples(grid.memory.arena, count, surface) {
    Arena& arena = grid.memory.arena;
    const size_t rows = padded(count);
    hits.depth = grid.depth;
    auto pick = [&]<class T>(const T* from) {
        std::span<T> to = arena.allocate_span<T>(rows);
        for (size_t i = 0; i < rows; ++i) to[i] = from[grid.points[first + std::min(i, count - 1)]];
        return to.data();
    };
    hits.time = pick(grid.hits.time);
    hits.pixel_x = pick(grid.hits.pixel_x);
    hits.pixel_y = pick(grid.hits.pixel_y);
    hits.sample = pick(grid.hits.sample);
    hits.layer = pick(grid.hits.layer);
}

}  // namespace kinora
