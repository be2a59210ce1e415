// runtime/shading/hit_shader.cpp: hits through the kernels of their looks.
#include "runtime/shading/hit_shader.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "raytrace/hits.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

// Precise kernels run in the IEEE default, fast ones flush denormals
// (docs/decisions.md#exact-arithmetic).
struct DenormalMode {
    explicit DenormalMode(const Scene& scene) {
        if (scene.options.math == jit::math::Tier::Fast) flush.emplace();
    }
    std::optional<raytrace::DenormalGuard> flush;
};

// "surface:NAME": the shader's parameter of that name where it is an output; "surface:N" its
// normal.
bool is_wanted(const rsl::KernelKey& key, const rsl::LoweredShader::GatherResult& result) {
    static const int32_t normal = rsl::name_id("N");
    if (key.kind == rsl::KeyKind::Aov) return key.name == result.variable;
    return key.kind == rsl::KeyKind::Global && key.global() == rsl::Global::N &&
           result.variable == normal;
}

void copy_outputs(const HitOutputs& wanted, const jit::Kernel& kernel, std::span<float* const> out,
                  std::span<const uint32_t> points) {
    size_t column = 0;
    for (const rsl::LoweredShader::GatherResult& result : wanted.wanted) {
        size_t components = size_t(rsl::component_count(result.type));
        for (size_t o = 0; o < kernel.outputs.size(); ++o) {
            rsl::KernelKey key = rsl::key_of(kernel.outputs[o]);
            size_t k = size_t(rsl::number_index(key));
            if (!is_wanted(key, result) || k >= components) continue;
            for (size_t i = 0; i < points.size(); ++i)
                wanted.columns[column + k][points[i]] = out[o][i];
        }
        column += components;
    }
}

}  // namespace

void HitShader::shade(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
                      raytrace::ShadeResult& result, const HitOutputs* outputs) {
    const Scene& scene = frame_.scene;
    Arena::Mark mark = memory.arena.mark();
    DenormalMode mode(scene);
    // A counting sort by look keeps the hits' order within each, so rows stay together.
    size_t looks = scene.looks.size();
    std::span<uint32_t> begin = memory.arena.allocate_span<uint32_t>(looks + 1);
    std::fill(begin.begin(), begin.end(), 0u);
    for (size_t i = 0; i < hits.count; ++i) ++begin[scene.surfaces[hits.instance[i]].look + 1];
    for (size_t l = 0; l < looks; ++l) begin[l + 1] += begin[l];
    std::span<uint32_t> order = memory.arena.allocate_span<uint32_t>(hits.count);
    std::span<uint32_t> next = memory.arena.allocate_span<uint32_t>(looks);
    std::copy_n(begin.begin(), looks, next.begin());
    for (uint32_t i = 0; i < hits.count; ++i)
        order[next[scene.surfaces[hits.instance[i]].look]++] = i;
    for (size_t l = 0; l < looks; ++l)
        for (size_t at = begin[l]; at < begin[l + 1]; at += kGridPoints)
            shade_look(hits, order.subspan(at, std::min(kGridPoints, begin[l + 1] - at)),
                       *scene.looks[l], ray, memory, result, outputs);
    volumes_.apply(hits, ray, shadows_, memory, result);
    memory.arena.release(mark);
}

namespace {

constexpr float kBlack = 1.5e-4f;  // 0 in an 8-bit picture

float largest(const float* const rows[3], size_t i) {
    return std::max({rows[0][i], rows[1][i], rows[2][i]});
}

// Whether light from somewhere arrives at the side of the grid's point i that the ray sees.
bool is_lit(const Grid& grid, size_t i) {
    vec3 N = triple(grid.columns.data() + kColN, i);
    vec3 seen_along = grid.frame.camera_from_accel * triple(grid.hits.dir, grid.points[i]);
    if (glm::dot(N, seen_along) > 0) N = -N;
    const jit::RecordSet& set = grid.record_sets[0];
    for (int32_t r = 0; r < set.count; ++r) {
        const jit::Record& record = set.records[r];
        if (jit::bits_of(record.uniforms[rsl::kLightKind]) == rsl::kLightAmbient) continue;
        if (jit::bits_of(record.columns[rsl::kLightLit][i]) == 0) continue;
        float facing = glm::dot(N, triple(record.columns + rsl::kLightL, i));
        if (facing > 0 && largest(record.columns + rsl::kLightCl, i) > kBlack) return true;
    }
    return false;
}

}  // namespace

// For LIGHTS_DARK: black points of surfaces that ask for light and get none.
void HitShader::count_dark(const Grid& grid, const raytrace::ShadeResult& result) const {
    ShadingCounters& counters = grid.memory.counters;
    for (size_t i = 0; i < grid.count(); ++i) {
        uint32_t hit = grid.points[i];
        if (!(largest(result.Oi, hit) > 0)) continue;
        counters.seen += 1;
        bool black = largest(result.Ci, hit) < kBlack;
        counters.dark += black && grid.look->lowered.uses_lights && !is_lit(grid, i);
    }
}

void HitShader::shade_look(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                           const ShaderInstance& look, const RayTag& ray, ThreadMemory& memory,
                           raytrace::ShadeResult& result, const HitOutputs* outputs) {
    Arena::Mark mark = memory.arena.mark();
    Grid grid(frame_, memory, hits, points, &look);
    kernels_.prepare(grid, ray);
    grid.shadows = &shadows_;
    grid.goes_on = result.passages;
    want_columns(grid, look.full.columns);
    if (look.lowered.uses_lights) lights_.want_columns(grid);
    gather(grid);
    if (look.lowered.uses_lights) lights_.run(grid);
    std::span<float*> out = kernels_.run(look.full, grid);
    if (outputs) copy_outputs(*outputs, look.full.kernel(), out, points);
    memory.counters.points += grid.count();
    float *Ci[3], *Oi[3];
    find_color(look.full.kernel(), out, rsl::Global::Ci, Ci);
    find_color(look.full.kernel(), out, rsl::Global::Oi, Oi);
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < points.size(); ++i) {
            result.Ci[k][points[i]] = Ci[k] ? Ci[k][i] : 0.0f;
            result.Oi[k][points[i]] = Oi[k] ? Oi[k][i] : 1.0f;
        }
    for (size_t i = 0; result.passages && i < points.size(); ++i) {
        const PointRays& rays = grid.rays[i];
        uint32_t turns = hits.rays->turns[hits.ray[points[i]]];
        result.passages[points[i]] = {rays.onward, turns + rays.reflects, rays.shot};
    }
    if (frame_.scene.watch_dark && grid.depth == 0) count_dark(grid, result);
    for (size_t p = 0; p < std::min(result.aov.size(), look.aovs.size()); ++p)
        for (size_t i = 0; look.aovs[p] >= 0 && i < points.size(); ++i)
            result.aov[p][points[i]] = out[size_t(look.aovs[p])][i];
    memory.arena.release(mark);
}

// Nothing lies there, so a volume begins with Ci and Oi of 0; without one they stay so.
void HitShader::shade_misses(const raytrace::HitBatch& ends, const RayTag& ray,
                             ThreadMemory& memory, raytrace::ShadeResult& result) {
    DenormalMode mode(frame_.scene);
    for (size_t k = 0; k < 3; ++k) {
        std::fill_n(result.Ci[k], ends.count, 0.0f);
        std::fill_n(result.Oi[k], ends.count, 0.0f);
    }
    volumes_.apply(ends, ray, shadows_, memory, result);
}

}  // namespace kinora
