// runtime/picture/shading/lighting/area_records.cpp: records of lights on geometry: of samples of
// their meshes, and of what they send from directions that a material has chosen.
//
// A sample that is even in area is d^2 / (area cos') dense by solid angle, and its radiance is pi
// Cl times that: so Cl / n is the Cl of a record (sampled_records.cpp). Where samples have another
// density, Cl counts by the ratio of the two.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "runtime/picture/shading/lane_rays.h"
#include "runtime/picture/shading/lighting/chosen_directions.h"
#include "runtime/picture/shading/lighting/emission.h"
#include "runtime/picture/shading/lighting/lamp_sampler.h"
#include "runtime/picture/shading/lighting/light_records.h"
#include "runtime/scene/kernels/columns.h"

namespace kinora {

// The light's kernel at a sample of its mesh for each lit point.
class LightRecords::AreaKernel {
  public:
    AreaKernel(LightRecords& all, const Making& making, size_t light);
    AreaKernel(const AreaKernel&) = delete;
    // The outputs for the samples as they are chosen.
    std::span<float*> run();
    // d^2 / (area cos') of the light that a statement sends.
    std::span<float> by_area(const LightOutputs& statement, std::span<float* const> out) const;
    // The share of Cl that counts of each sample.
    std::span<float> shares() const;
    // Of the samples, by solid angle, all samples of a point together.
    std::span<float> densities(const LightOutputs& statement, std::span<float* const> out) const;
    // Whether the light may reach a point: a surface does not light itself, but for emission.
    bool may_light(size_t i) const {
        return light.has_area() &&
               (light.emits || at.surface[std::min(i, at.count - 1)] != light.surfaces[0]);
    }

    const AreaLight& light;
    const LightPoints& at;
    LightSamples samples;
    LampSampler sampler;
    Grid lit;
    const uint32_t count;  // samples of a point

  private:
    // What the kernel reads of the lit point; the rest is the mesh's.
    const float* of_point(uint16_t column) const;
    void put_emission(std::span<float*> out) const;
    float area_at(size_t point) const {
        return light.has_area() ? light.area_at(samples.instance[point], samples.primitive[point])
                                : 0.0f;
    }

    LightRecords& all_;
    const size_t number_;  // of the light
    Arena& arena_;
    std::span<float*> mesh_;  // columns
};

namespace {

std::span<uint32_t> numbers_up_to(size_t count, Arena& arena) {
    std::span<uint32_t> numbers = arena.allocate_span<uint32_t>(count);
    for (uint32_t i = 0; i < count; ++i) numbers[i] = i;
    return numbers;
}

}  // namespace

LightRecords::AreaKernel::AreaKernel(LightRecords& all, const Making& making, size_t l)
    : light(*all.area_lights_.find(l)),
      at(making.at),
      samples(making.grid, at.first, at.count, light.surfaces[0]),
      sampler(light, at, making.grid.memory),
      lit(all.frame_, making.grid.memory, samples.hits,
          numbers_up_to(at.count, making.grid.memory.arena),
          all.frame_.shaders.shader_instances[all.frame_.lights.lights[l].look].get()),
      count(uint32_t(all.samples_of(l, all.bindings_.statements(l)[0], making.grid))),
      all_(all),
      number_(l),
      arena_(making.grid.memory.arena) {
    Grid& grid = making.grid;
    all.kernels_.prepare(lit, grid.ray);
    lit.rays = accounts_of(grid, at);
    lit.shadows = grid.shadows;
    lit.lamp_samples = count;
    if (grid.look->kind == ShaderInstanceKind::Surface) {
        lit.surface = grid.look;
        lit.lit = &grid;
        lit.lit_first = at.first;
    }
    if (lit.look->lowered.gathers.empty()) lit.record_sets = grid.record_sets;
    for (uint16_t column : lit.look->full.columns)
        if (!of_point(column)) kinora::want_columns(lit, {&column, 1});
    mesh_ = arena_.allocate_span<float*>(lit.columns.size());
    std::copy(lit.columns.begin(), lit.columns.end(), mesh_.begin());
}

const float* LightRecords::AreaKernel::of_point(uint16_t c) const {
    if (c >= kColPs && c < kColPs + 3) return at.P[c - kColPs];
    if (c >= kColNs && c < kColNs + 3) return at.N[c - kColNs];
    if (c >= kColSentL && c < kColSentL + 3) return at.zeros;
    return c == kColRng ? at.rng : nullptr;
}

// The mesh's columns are gathered for each sample; those of the lit points stay.
std::span<float*> LightRecords::AreaKernel::run() {
    std::copy(mesh_.begin(), mesh_.end(), lit.columns.begin());
    gather(lit);
    for (uint16_t column : lit.look->full.columns)
        if (const float* row = of_point(column)) lit.columns[column] = const_cast<float*>(row);
    lit.memory.counters.light_points += at.count;
    std::span<float*> out = all_.kernels_.run(lit.look->full, lit);
    if (light.emits) put_emission(out);
    return out;
}

// In the place of Cl: radiance over pi times the density by area, and of that the samples' share.
void LightRecords::AreaKernel::put_emission(std::span<float*> out) const {
    const LightOutputs& statement = all_.bindings_.statements(number_)[0];
    std::span<vec3> emission = arena_.allocate_span<vec3>(at.count);
    find_emission(all_.frame_, all_.kernels_, lit, samples, at, emission);
    const std::span<const float> density = by_area(statement, out);
    for (size_t i = 0; i < padded(at.count); ++i) {
        const size_t point = std::min(i, at.count - 1);
        const bool even_in_area = samples.density[point] == LightSamples::kByArea;
        const float share = even_in_area ? share_of_samples(density[i]) : 1.0f;
        for (int k = 0; k < 3; ++k)
            out[size_t(statement.Cl[k])][i] =
                emission[point][k] * share / (float(kPi) * density[i]);
    }
}

std::span<float> LightRecords::AreaKernel::by_area(const LightOutputs& statement,
                                                   std::span<float* const> out) const {
    std::span<float> density = arena_.allocate_span<float>(padded(at.count));
    for (size_t i = 0; i < density.size(); ++i) {
        const size_t point = std::min(i, at.count - 1);
        const vec3 L(out[size_t(statement.L[0])][point], out[size_t(statement.L[1])][point],
                     out[size_t(statement.L[2])][point]);
        const vec3 Ng = lit.frame.camera_from_accel * triple(samples.hits.Ng, point);
        density[i] = density_by_area(L, Ng, area_at(point));
    }
    return density;
}

std::span<float> LightRecords::AreaKernel::shares() const {
    std::span<float> share = arena_.allocate_span<float>(padded(at.count));
    for (size_t i = 0; i < share.size(); ++i) {
        const size_t point = std::min(i, at.count - 1);
        const float dense = samples.density[point];
        share[i] = may_light(i) ? 1 / float(count) : 0.0f;
        if (share[i] == 0 || dense == LightSamples::kByArea) continue;
        const vec3 L = triple(samples.hits.P, point) - triple(at.accel, point);
        const float even = density_by_area(L, triple(samples.hits.Ng, point), area_at(point));
        share[i] = dense > 0 ? samples.share[point] * even / (dense * float(count)) : 0.0f;
    }
    return share;
}

std::span<float> LightRecords::AreaKernel::densities(const LightOutputs& statement,
                                                     std::span<float* const> out) const {
    std::span<float> density = by_area(statement, out);
    for (size_t i = 0; i < density.size(); ++i) {
        const float dense = samples.density[std::min(i, at.count - 1)];
        density[i] = (dense == LightSamples::kByArea ? density[i] : dense) * float(count);
    }
    return density;
}

namespace {

// The material's own directions may meet such light.
bool is_weighed(const ShaderInstance& look, const LightOutputs& statement) {
    return look.lowered.lit_by_samples && statement.kind == rsl::kLightIlluminate &&
           statement.L[0] >= 0;
}

// A light's outputs and a density beside them.
std::span<float* const> with_density(LightOutputs& statement, std::span<float* const> out,
                                     std::span<float> density, Arena& arena) {
    std::span<float*> all = arena.allocate_span<float*>(out.size() + 1);
    std::copy(out.begin(), out.end(), all.begin());
    all.back() = density.data();
    statement.sampled = true;
    statement.density = int(out.size());
    std::copy_n(statement.L, 3, statement.end);
    return all;
}

// Cl of each point becomes `factor(i)` times as much.
template <class F>
void scale(const LightOutputs& statement, std::span<float* const> out, size_t points, F&& factor) {
    for (size_t i = 0; i < points; ++i) {
        const float by = factor(i);
        for (int output : statement.Cl)
            if (output >= 0) out[size_t(output)][i] = by > 0 ? out[size_t(output)][i] * by : 0.0f;
    }
}

}  // namespace

void LightRecords::area_record(Making& making, size_t l, AreaKernel& kernel,
                               const LightOutputs& own, std::span<float* const> out) const {
    const std::span<const float> shares = kernel.shares();
    scale(own, out, padded(making.at.count), [&](size_t i) { return shares[i]; });
    LightOutputs statement = own;
    std::span<float* const> columns = out;
    if (is_weighed(*making.grid.look, own))
        columns =
            with_density(statement, out, kernel.densities(own, out), making.grid.memory.arena);
    const LightBinding& binding = bindings_.binding(making.grid.look->index, l);
    make_record(making, statement, binding, binding.messages, columns, true, &kernel.samples);
}

void LightRecords::area_records(Making& making, size_t l) {
    AreaKernel kernel(*this, making, l);
    for (uint32_t k = 0; k < kernel.count; ++k) {
        kernel.sampler.choose(kernel.lit, {k, kernel.count}, kernel.samples);
        do {
            std::span<float*> out = kernel.run();
            for (const LightOutputs& statement : bindings_.statements(l))
                area_record(making, l, kernel, statement, out);
        } while (kernel.sampler.go_on(kernel.lit, kernel.samples));
    }
}

// ---- from directions ----------------------------------------------------------------------------

namespace {

constexpr int kMostLamps = 16;  // one behind the other along a direction

// Rays of the points that ask, which meet lamps alone; a slot is the point's number.
void add_lamp_rays(raytrace::RayBatch& rays, const Grid& grid, const LightPoints& at,
                   const ChosenDirections& directions) {
    const mat3 accel_from_camera = glm::transpose(grid.frame.camera_from_accel);
    for (size_t i = 0; i < at.count; ++i) {
        const vec3 D = accel_from_camera * directions.at(i);
        if (!(glm::dot(D, D) > 0) || !(directions.density[i] > 0)) continue;
        const vec3 P(at.P[0][i], at.P[1][i], at.P[2][i]);
        add_ray(rays, grid, ray_start(grid, at.first + i, P), D, kMiss, -1, 0, uint32_t(i));
        rays.sees[rays.count - 1] = raytrace::kMaskLamp;
    }
}

}  // namespace

void LightRecords::lamps_along(Making& making, const ChosenDirections& directions) {
    if (area_lights_.all().empty()) return;
    ThreadMemory& memory = making.grid.memory;
    NestedWavefront batch(memory);
    raytrace::RayBatch& rays = batch->rays;
    rays.reserve(kGridPoints);
    rays.count = 0;
    add_lamp_rays(rays, making.grid, making.at, directions);
    for (int layer = 0; layer < kMostLamps && rays.count > 0; ++layer) {
        NestedWavefront nested(memory);
        nested->hits.reserve(kGridPoints);
        const raytrace::HitBatch& hits =
            raytrace::trace(frame_.pose.accel, rays, raytrace::kMaskLamp, making.grid.depth + 1,
                            nested->hits, memory.counters.trace);
        for (size_t l : area_lights_.all())
            if (!is_dark(making.grid, l, {})) lamp_along(making, l, directions, rays, hits);
        for (size_t h = 0; h < hits.count; ++h)
            raytrace::pass_through(frame_.pose.accel, rays, h, hits, h);
        rays.count = hits.count;
        rays.passing = true;
    }
    rays.passing = false;
}

void LightRecords::lamp_along(Making& making, size_t l, const ChosenDirections& directions,
                              const raytrace::RayBatch& rays, const raytrace::HitBatch& hits) {
    const AreaLight& light = *area_lights_.find(l);
    if (std::none_of(hits.instance, hits.instance + hits.count,
                     [&](uint32_t surface) { return light.has(surface); }))
        return;
    AreaKernel kernel(*this, making, l);
    LightSamples& samples = kernel.samples;
    std::fill(samples.primitive.begin(), samples.primitive.end(), 0u);
    std::fill_n(samples.u, samples.primitive.size(), 0.0f);
    std::fill_n(samples.v, samples.primitive.size(), 0.0f);
    std::span<bool> met = making.grid.memory.arena.allocate_span<bool>(padded(making.at.count));
    std::fill(met.begin(), met.end(), false);
    for (size_t h = 0; h < hits.count; ++h) {
        const uint32_t point = rays.slot[hits.ray[h]];
        if (!light.has(hits.instance[h])) continue;
        met[point] = true;
        samples.instance[point] = hits.instance[h];
        samples.primitive[point] = hits.primitive[h];
        samples.u[point] = hits.u[h];
        samples.v[point] = hits.v[h];
    }
    for (size_t i = 0; i < making.at.count; ++i) samples.density[i] = kernel.sampler.density(i);
    samples.find_points(frame_.pose.accel);
    std::span<float*> out = kernel.run();
    for (const LightOutputs& own : bindings_.statements(l)) {
        if (!is_weighed(*making.grid.look, own)) continue;
        const std::span<const float> by_area = kernel.by_area(own, out);
        const std::span<float> density = kernel.densities(own, out);
        scale(own, out, padded(making.at.count), [&](size_t i) {
            if (!met[i] || !kernel.may_light(i)) return 0.0f;
            const float radiance = float(kPi) * by_area[i];
            return radiance * sample_weight(directions.density[i], density[i], directions.power[i]);
        });
        LightOutputs statement = own;
        std::span<float* const> columns =
            with_density(statement, out, density, making.grid.memory.arena);
        const LightBinding& binding = bindings_.binding(making.grid.look->index, l);
        make_record(making, statement, binding, binding.messages, columns, true, &samples);
    }
}

}  // namespace kinora
