// runtime/picture/shading/lighting/lamps.cpp: what is seen of surfaces that are lights.
//
// A light on geometry sends a point the mean of Cl cos over its area. A surface of radiance L sends
// the integral of L cos cos' / (pi d^2), so L = pi Cl d^2 / (area cos').
#include "runtime/picture/shading/lighting/lamps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "runtime/picture/shading/kernel_runner.h"
#include "runtime/picture/shading/lighting/emission.h"
#include "runtime/picture/shading/lighting/light_records.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/kernels/columns.h"

namespace kinora {

namespace {

constexpr float kLeastCosine = 0.05f;  // a point light on a surface is no brighter at its edge

const ShaderInstance& look_of(const ShadingFrame& frame, size_t light) {
    return *frame.shaders.shader_instances[frame.lights.lights[light].look];
}

// Of a light as its file has it: no pose stands yet.
double first_number(const ShadingFrame& frame, const LightNumber& number) {
    return number.value == kNone ? double(number.fixed)
                                 : frame.resources.description->values[number.value];
}

uint32_t surface_of(const Grid& grid, size_t point) {
    return grid.hits.instance[grid.points[point]];
}

// Cl d^2 / cos' of a statement of the grid's light at each hit.
void find_exitance(const Grid& lit, const LightOutputs& statement, std::span<float* const> out,
                   std::span<vec3> exitance) {
    auto at = [&](int output, size_t i) { return output < 0 ? 0.0f : out[size_t(output)][i]; };
    auto triple_at = [&](const int(&outputs)[3], size_t i) {
        return vec3(at(outputs[0], i), at(outputs[1], i), at(outputs[2], i));
    };
    for (size_t i = 0; i < exitance.size(); ++i) {
        const vec3 L = triple_at(statement.L, i);
        const vec3 Ng = lit.frame.camera_from_accel * triple(lit.hits.Ng, lit.points[i]);
        const float square = glm::dot(L, L);
        const bool dark = statement.lit >= 0 && jit::bits_of(at(statement.lit, i)) == 0;
        exitance[i] = vec3(0.0f);
        if (dark || !(square > 0)) continue;
        const float cosine = std::abs(glm::dot(Ng, L)) / std::sqrt(square);
        exitance[i] = triple_at(statement.Cl, i) * (square / std::max(cosine, kLeastCosine));
    }
}

}  // namespace

void fill_light_columns(Grid& lit, const ShadingFrame& frame) {
    auto is_lit = [](uint16_t c) { return c >= kColPs && c < kColNs + 3; };
    auto is_sent = [](uint16_t c) { return c >= kColSentL && c < kColSentL + 3; };
    for (uint16_t column : lit.look->full.columns)
        if (!is_lit(column) && !is_sent(column)) want_columns(lit, {&column, 1});
    gather(lit);
    for (uint16_t column : lit.look->full.columns) {
        if (!is_lit(column) && !is_sent(column)) continue;
        float* const row = lit.memory.arena.allocate_span<float>(padded(lit.count())).data();
        std::fill_n(row, padded(lit.count()), 0.0f);
        lit.columns[column] = row;
        for (size_t i = 0; is_lit(column) && i < lit.count(); ++i) {
            const vec3 org = triple(lit.hits.org, lit.points[i]) - frame.eye;
            const vec3 of_row = frame.camera_from_accel *
                                (column < kColNs ? org : triple(lit.hits.dir, lit.points[i]));
            row[i] = of_row[(column - kColPs) % 3];
        }
    }
}

static_assert(kColNs == kColPs + 3);

Lamps::Lamps(ShadingFrame& frame, KernelRunner& kernels, const LightRecords& lights)
    : frame_(frame), kernels_(kernels), lights_(lights) {
    find_lamps();
    find_counted();
}

void Lamps::find_lamps() {
    const auto& looks = frame_.shaders.shader_instances;
    of_surface_.resize(frame_.shapes.surfaces.size());
    wears_.resize(looks.size());
    made_.resize(looks.size());
    const rsl::Shader* const made = library_shader("area_emitter").get();
    for (size_t l = 0; l < frame_.lights.lights.size(); ++l) {
        const AreaLight* const light = lights_.areas().find(l);
        if (!light || !lights_.bindings().directed(l)) continue;
        for (uint32_t surface : light->surfaces) {
            of_surface_[surface].push_back(l);
            const uint32_t look = frame_.shapes.surfaces[surface].look;
            wears_[look] = true;
            made_[look] = &looks[look]->shader() == made;
        }
    }
}

// Looks that the same lamps light share a number, so that their rays go together.
void Lamps::find_counted() {
    const auto& looks = frame_.shaders.shader_instances;
    const bool dome = frame_.dome != kNone;
    frame_.counted.assign(looks.size(), 0);
    frame_.counted_specular.assign(looks.size(), 0);
    number_of_set(std::vector<bool>(of_surface_.size()), false);
    if (!dome && std::ranges::none_of(wears_, [](bool lamp) { return lamp; })) return;
    for (const auto& look : looks) {
        if (look->kind != ShaderInstanceKind::Surface) continue;
        auto counted = [&](LightNumber LightBinding::*lacks) {
            auto lights = [&](size_t light) {
                const LightBinding& binding = lights_.bindings().binding(look->index, light);
                return binding.seen && first_number(frame_, binding.*lacks) == 0;
            };
            std::vector<bool> lit(of_surface_.size(), false);
            for (size_t s = 0; s < lit.size(); ++s)
                lit[s] = std::ranges::any_of(of_surface_[s], lights);
            return number_of_set(std::move(lit), dome && lights(frame_.dome));
        };
        frame_.counted[look->index] = counted(&LightBinding::nondiffuse);
        frame_.counted_specular[look->index] = counted(&LightBinding::nonspecular);
    }
}

uint32_t Lamps::number_of_set(std::vector<bool> surfaces, bool dome) {
    uint32_t number = 0;
    while (number < counted_.size() &&
           !(counted_[number] == surfaces && frame_.counts_dome[number] == dome))
        ++number;
    if (number < counted_.size()) return number;
    counted_.push_back(std::move(surfaces));
    frame_.counts_dome.push_back(dome);
    return number;
}

bool Lamps::is_counted(const Grid& grid, size_t point) const {
    return counted_[grid.ray.counted][surface_of(grid, point)];
}

void Lamps::show(Grid& grid, raytrace::ShadeResult& result) {
    const uint32_t look = grid.look->index;
    if (!wears_[look] || (!made_[look] && grid.ray.counted == 0)) return;
    Arena& arena = grid.memory.arena;
    const Arena::Mark mark = arena.mark();
    std::span<vec3> radiance = arena.allocate_span<vec3>(grid.count());
    std::span<float> shares = arena.allocate_span<float>(grid.count());
    std::fill(radiance.begin(), radiance.end(), vec3(0.0f));
    std::fill(shares.begin(), shares.end(), 0.0f);
    find_radiance(grid, radiance, shares);
    if (!made_[look]) take_emission(grid, shares, result);
    for (size_t i = 0; made_[look] && i < grid.count(); ++i)
        for (int k = 0; k < 3; ++k)
            result.Ci[k][grid.points[i]] = is_counted(grid, i) ? 0.0f : radiance[i][k];
    arena.release(mark);
}

void Lamps::find_radiance(Grid& grid, std::span<vec3> radiance, std::span<float> shares) {
    for (size_t l = 0; l < frame_.lights.lights.size(); ++l) {
        const AreaLight* const light = lights_.areas().find(l);
        if (!light || !lights_.bindings().directed(l)) continue;
        auto wears_look = [&](uint32_t surface) {
            return frame_.shapes.surfaces[surface].look == grid.look->index;
        };
        if (std::ranges::none_of(light->surfaces, wears_look)) continue;
        light->emits ? add_shares(grid, *light, shares) : add_radiance(grid, l, radiance);
    }
    for (size_t i = 0; i < grid.count(); ++i)
        if (radiance[i] != vec3(0.0f)) shares[i] = 1;
}

void Lamps::add_shares(const Grid& grid, const AreaLight& light, std::span<float> shares) const {
    for (size_t i = 0; light.has_area() && i < grid.count(); ++i) {
        const uint32_t hit = grid.points[i];
        if (light.has(surface_of(grid, i)))
            shares[i] = share_of_samples(light, triple(grid.hits.org, hit), grid.hits, hit);
    }
}

void Lamps::add_radiance(Grid& grid, size_t light, std::span<vec3> radiance) {
    Arena& arena = grid.memory.arena;
    const AreaLight& area = *lights_.areas().find(light);
    std::span<uint32_t> which = arena.allocate_span<uint32_t>(grid.count());
    std::span<uint32_t> hits = arena.allocate_span<uint32_t>(grid.count());
    uint32_t count = 0;
    for (uint32_t i = 0; i < grid.count(); ++i)
        if (area.has(surface_of(grid, i))) {
            which[count] = i;
            hits[count++] = grid.points[i];
        }
    if (count == 0 || !area.has_area()) return;
    const ShaderInstance& look = look_of(frame_, light);
    Grid lit(frame_, grid.memory, grid.hits, hits.first(count), &look);
    kernels_.prepare(lit, grid.ray);
    fill_light_columns(lit, frame_);
    const std::span<float*> out = kernels_.run(look.full, lit);
    grid.memory.counters.light_points += count;
    std::span<vec3> Cl = arena.allocate_span<vec3>(count);
    for (const LightOutputs& statement : lights_.bindings().statements(light)) {
        if (statement.kind != rsl::kLightIlluminate) continue;
        find_exitance(lit, statement, out, Cl);
        for (uint32_t i = 0; i < count; ++i)
            radiance[which[i]] += Cl[i] * (float(kPi) / area.below.back());
    }
}

// What the kernel gives without lights and rays, where the lamp sends light to the ray's sender.
void Lamps::take_emission(Grid& grid, std::span<const float> shares,
                          raytrace::ShadeResult& result) {
    Arena& arena = grid.memory.arena;
    std::span<uint32_t> hits = arena.allocate_span<uint32_t>(grid.count());
    std::span<float> share = arena.allocate_span<float>(grid.count());
    uint32_t count = 0;
    for (uint32_t i = 0; i < grid.count(); ++i) {
        if (!is_counted(grid, i) || shares[i] == 0) continue;
        share[count] = shares[i];
        hits[count++] = grid.points[i];
    }
    if (count == 0) return;
    Grid dark(frame_, grid.memory, grid.hits, hits.first(count), grid.look);
    kernels_.prepare(dark, grid.ray);
    want_columns(dark, grid.look->full.columns);
    gather(dark);
    const std::span<float*> out = kernels_.run_in_the_dark(dark);
    float* Ci[3];
    find_color(grid.look->full.kernel(), out, rsl::Global::Ci, Ci);
    for (int k = 0; k < 3; ++k)
        for (uint32_t i = 0; Ci[k] && i < count; ++i)
            result.Ci[k][hits[i]] = std::max(0.0f, result.Ci[k][hits[i]] - share[i] * Ci[k][i]);
}

}  // namespace kinora
