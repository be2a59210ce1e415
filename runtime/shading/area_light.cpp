// runtime/shading/area_light.cpp: lights on geometry: their shaders run at samples of the mesh.
//
// Each lit point asks n samples, spread evenly over the area: an Owen-scrambled (0,2)-sequence
// seeded by the point and the light, so that the first 2^k are stratified and nothing depends on
// threads or tiles. A sample is a light of its own (P, N, u, v, s, t on the mesh; what the shader
// illuminates is a record) whose Cl counts 1/n: the mean over the surface of what a point light
// with that shader would give, so a light that shrinks to a point becomes that point light. The
// samples follow the mesh of the frame. A surface does not light itself.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/sampling.h"
#include "runtime/shading/shading_p.h"

namespace kinora {

namespace {

constexpr uint32_t kDefaultSamples = 16;

// Uniform over a triangle: u, v of its corners 1 and 2 (P. Shirley and K. Chiu 1997: the square
// folded by a root).
vec2 on_triangle(float x, float y) {
    float root = std::sqrt(x);
    return {root * (1 - y), root * y};
}

}  // namespace

void Shading::bind_area_lights() {
    const SceneOptions& options = scene_.options;
    for (const LightSource& source : scene_.lights) {
        auto& light = area_lights_.emplace_back();
        lights_need_rng_ |= scene_.looks[source.look]->lowered.uses_rng;
        if (source.surface == kNone) continue;
        lights_need_rng_ = true;
        light = std::make_unique<AreaLight>();
        light->surface = source.surface;
        uint32_t own = scene_.description->lights[source.definition].samples;
        light->samples = options.light_samples ? options.light_samples
                         : own                 ? own
                                               : kDefaultSamples;
    }
}

// Areas once, and again in each frame where the mesh may deform or be scaled.
void Shading::update_area_lights() {
    for (auto& light : area_lights_) {
        if (!light) continue;
        const Surface& surface = scene_.surfaces[light->surface];
        const Shape& shape = scene_.shapes[surface.shape];
        if (light->known && shape.kind == raytrace::GeometryKind::Static) continue;
        const auto& triangles = scene_.meshes[shape.mesh].groups[surface.group].triangles;
        bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
        dmat3 linear = instanced ? dmat3(shape.world) : dmat3(1.0);
        light->below.resize(triangles.size() / 3);
        double sum = 0;
        for (size_t t = 0; t < light->below.size(); ++t) {
            auto corner = [&](size_t k) {
                return linear * dvec3(shape.rest_positions[triangles[3 * t + k]]);
            };
            double area =
                0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
            if (std::isfinite(area)) sum += area;
            light->below[t] = float(sum);
        }
        light->known = true;
    }
}

void Shading::choose_samples(const Grid& grid, const LightPoints& at, const AreaLight& light,
                             uint32_t sample, LightSamples& samples) const {
    const std::vector<float>& below = light.below;
    uint32_t number = uint32_t(grid.look->index);  // tells lights on one surface apart
    for (size_t i = 0; i < padded(at.count); ++i) {
        size_t point = std::min(i, at.count - 1);
        uint32_t seed = raytrace::hash(uint32_t(jit::bits_of(at.rng[point])), number, seed_);
        vec2 u(raytrace::stratified_sample(sample, seed));
        float wanted = u.x * below.back();
        size_t t = size_t(std::upper_bound(below.begin(), below.end(), wanted) - below.begin());
        t = std::min(t, below.size() - 1);
        float from = t ? below[t - 1] : 0.0f, area = below[t] - from;
        vec2 place = on_triangle(area > 0 ? std::min((wanted - from) / area, 1.0f) : 0.0f, u.y);
        samples.primitive[i] = uint32_t(t);
        samples.u[i] = place.x;
        samples.v[i] = place.y;
    }
    scene_.accel.surface_points(at.count, samples.instance.data(), samples.primitive.data(),
                                samples.u, samples.v, samples.place);
}

namespace {

// Room for the samples of `count` points; what a light kernel's services may read of a hit is 0.
template <class Samples>
void take_samples(Samples& samples, const Grid& grid, size_t first, size_t count, uint32_t surface,
                  Arena& arena) {
    size_t rows = padded(count);
    auto take = [&] { return arena.allocate_span<float>(rows).data(); };
    float* zeros = take();
    std::fill_n(zeros, rows, 0.0f);
    std::span<uint32_t> none = arena.allocate_span<uint32_t>(rows);
    std::fill(none.begin(), none.end(), 0u);
    samples.instance = arena.allocate_span<uint32_t>(rows);
    std::fill(samples.instance.begin(), samples.instance.end(), surface);
    samples.primitive = arena.allocate_span<uint32_t>(rows);
    samples.u = take();
    samples.v = take();
    raytrace::HitBatch& hits = samples.hits;
    hits = {};
    hits.count = count;
    hits.depth = grid.depth;
    hits.geometry = hits.instance = samples.instance.data();
    hits.primitive = samples.primitive.data();
    hits.u = samples.u;
    hits.v = samples.v;
    hits.t = hits.time = zeros;
    for (size_t k = 0; k < 3; ++k) {
        samples.place.P[k] = take();
        samples.place.P_error[k] = take();
        samples.place.Ng[k] = take();
        hits.P[k] = samples.place.P[k];
        hits.P_error[k] = samples.place.P_error[k];
        hits.Ng[k] = samples.place.Ng[k];
        hits.org[k] = hits.dir[k] = zeros;
        hits.dPdx[k] = hits.dPdy[k] = hits.dDdx[k] = hits.dDdy[k] = zeros;
    }
    auto pick = [&](const uint32_t* from) {
        std::span<uint32_t> to = arena.allocate_span<uint32_t>(rows);
        for (size_t i = 0; i < rows; ++i) to[i] = from[grid.points[first + std::min(i, count - 1)]];
        return to.data();
    };
    hits.pixel_x = pick(grid.hits.pixel_x);
    hits.pixel_y = pick(grid.hits.pixel_y);
    hits.sample = pick(grid.hits.sample);
    hits.layer = pick(grid.hits.layer);
    hits.ray = none.data();
}

}  // namespace

jit::Record* Shading::area_records(Grid& grid, const LightPoints& at, size_t l, jit::Record* next,
                                   const float* zeros) {
    const AreaLight& light = *area_lights_[l];
    const ShaderInstance& look = *scene_.looks[scene_.lights[l].look];
    Arena& arena = *grid.arena;
    std::span<uint32_t> points = arena.allocate_span<uint32_t>(at.count);
    for (uint32_t i = 0; i < at.count; ++i) points[i] = i;
    LightSamples samples;
    take_samples(samples, grid, at.first, at.count, light.surface, arena);
    Grid lit(grid.scene, samples.hits, points, &look);
    prepare_grid(lit, grid.thread);
    lit.depth = grid.depth;
    lit.shadows = grid.shadows;
    lit.surface = grid.look->kind == ShaderInstanceKind::Surface ? grid.look : nullptr;
    if (lit.surface) {
        lit.lit = &grid;
        lit.lit_first = at.first;
    }
    if (look.lowered.gathers.empty()) lit.record_sets = grid.record_sets;
    // The mesh's columns are gathered for each sample; those of the lit points stay.
    auto of_point = [&](uint16_t c) -> const float* {
        if (c >= kColPs && c < kColPs + 3) return at.P[c - kColPs];
        if (c >= kColNs && c < kColNs + 3) return at.N[c - kColNs];
        return c == kColRng ? at.rng : nullptr;
    };
    for (uint16_t column : look.full.columns)
        if (!of_point(column)) want_columns(lit, {&column, 1});
    std::span<float*> mesh = arena.allocate_span<float*>(lit.columns.size());
    std::copy(lit.columns.begin(), lit.columns.end(), mesh.begin());
    bool nothing = light.below.empty() || !(light.below.back() > 0);
    for (uint32_t k = 0; k < light.samples; ++k) {
        choose_samples(lit, at, light, k, samples);
        std::copy(mesh.begin(), mesh.end(), lit.columns.begin());
        gather(lit);
        for (uint16_t column : look.full.columns)
            if (const float* row = of_point(column)) lit.columns[column] = const_cast<float*>(row);
        std::span<float*> out = run_for_colors(look.full, lit);
        thread(grid.thread).counters.light_points += at.count;
        for (const Statement& statement : statements_[l]) {
            for (int output : statement.Cl)
                for (size_t i = 0; output >= 0 && i < padded(at.count); ++i) {
                    bool own = at.surface[std::min(i, at.count - 1)] == light.surface;
                    float& Cl = out[size_t(output)][i];
                    Cl = own || nothing ? 0.0f : Cl / float(light.samples);
                }
            *next++ = make_record(grid, at, statement, bindings_[grid.look->index][l], out, zeros,
                                  &samples);
        }
    }
    return next;
}

}  // namespace kinora
