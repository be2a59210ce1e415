// runtime/picture/shading/relight.cpp: kernels under one white light.
#include "runtime/picture/shading/relight.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "rsl/model/renderer_services.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/light_layers.h"

namespace kinora {

namespace {

bool is_relit(const OutputPlane& plane) {
    return plane.source == AovSource::Albedo;
}

float* filled(Arena& arena, size_t count, float value) {
    std::span<float> column = arena.allocate_span<float>(padded(count));
    std::fill(column.begin(), column.end(), value);
    return column.data();
}

// A light along N on the side that the eye sees, white, without speculars.
jit::RecordSet white_light(const Grid& grid) {
    Arena& arena = grid.memory.arena;
    const size_t count = grid.count(), messages = grid.look->lowered.light_messages.size();
    float *const zeros = filled(arena, count, 0), *const ones = filled(arena, count, 1);
    float* const L[3] = {filled(arena, count, 0), filled(arena, count, 0), filled(arena, count, 0)};
    for (size_t i = 0; i < count && grid.columns[kColN]; ++i) {
        const vec3 N = triple(grid.columns.data() + kColN, i);
        const vec3 along = grid.frame.camera_from_accel * triple(grid.hits.dir, grid.points[i]);
        set_triple(L, i, glm::dot(N, along) > 0 ? -N : N);
    }
    std::span<const float*> columns =
        arena.allocate_span<const float*>(light_columns_of(grid.look->lowered));
    std::fill(columns.begin(), columns.end(), zeros);
    for (size_t k = 0; k < 3; ++k) {
        columns[rsl::kLightL + k] = L[k];
        columns[rsl::kLightCl + k] = columns[rsl::kLightBare + k] = ones;
    }
    columns[rsl::kLightLit] = filled(arena, count, jit::float_of(1));
    std::span<float> uniforms = arena.allocate_span<float>(rsl::kLightUniforms + messages);
    std::fill(uniforms.begin(), uniforms.end(), 0.0f);
    uniforms[rsl::kLightKind] = jit::float_of(int32_t(rsl::kLightSolar));
    uniforms[rsl::kLightNonspecular] = 1;
    std::span<jit::Record> records = arena.allocate_span<jit::Record>(1);
    records[0] = {columns.data(), uniforms.data()};
    return {1, records.data()};
}

using Color = std::array<const float*, 3>;  // null where the kernel has no Ci

Color color_under(Grid& grid, const KernelRunner& kernels, const jit::RecordSet& lights) {
    const std::span<float*> out = kernels.run_relit(grid, lights);
    float* Ci[3];
    find_color(grid.look->full.kernel(), out, rsl::Global::Ci, Ci);
    return {Ci[0], Ci[1], Ci[2]};
}

}  // namespace

bool wants_relight(const SceneShaders& shaders) {
    return std::ranges::any_of(shaders.outputs, is_relit);
}

void relight(Grid& grid, const KernelRunner& kernels, const raytrace::ShadeResult& result) {
    const std::vector<OutputPlane>& planes = grid.frame.shaders.outputs;
    const Color dark = color_under(grid, kernels, {});
    const Color lit =
        grid.look->lowered.uses_lights ? color_under(grid, kernels, white_light(grid)) : dark;
    for (size_t p = 0; p < std::min(planes.size(), result.aov.size()); ++p) {
        const size_t c = planes[p].component;
        if (!is_relit(planes[p]) || !dark[c]) continue;
        for (size_t i = 0; i < grid.count(); ++i)
            result.aov[p][grid.points[i]] = lit[c][i] - dark[c][i];
    }
}

}  // namespace kinora
