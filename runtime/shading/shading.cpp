// runtime/shading/shading.cpp: hits grouped by look, shaded in dense grids.
#include "runtime/shading/shading.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "runtime/base/parallel.h"
#include "runtime/description/findings.h"
#include "runtime/shading/shading_p.h"

namespace kinora {

void ShadingCounters::operator+=(const ShadingCounters& o) {
    trace += o.trace;
    points += o.points;
    light_points += o.light_points;
    opacity_points += o.opacity_points;
    too_deep += o.too_deep;
    unlit += o.unlit;
}

Shading::Shading(Scene& scene) : scene_(scene) {
    bind_area_lights();
    bind_lights();
}
Shading::~Shading() = default;

void Shading::begin_frame(uint32_t seed, int max_layers) {
    seed_ = seed;
    max_layers_ = max_layers;
    while (threads_.size() < size_t(thread_count())) threads_.push_back(std::make_unique<Thread>());
    for (auto& thread : threads_) {
        thread->counters = {};
        thread->faults.resize(2 * scene_.looks.size());
        for (size_t l = 0; l < scene_.looks.size(); ++l) {
            const ShaderInstance& look = *scene_.looks[l];
            thread->faults[2 * l].assign(look.full.kernel().fault_sites.size() + 1, 0);
            if (look.opacity)
                thread->faults[2 * l + 1].assign(look.opacity->kernel().fault_sites.size() + 1, 0);
        }
    }
    FrameContext context{scene_};
    any_transparent_ = false;
    for (auto& look : scene_.looks) {
        look->update(context);
        any_transparent_ |= look->kind == ShaderInstanceKind::Surface && look->opacity.has_value();
        has_exteriors_ |= look->exterior;
    }
    update_area_lights();
    const raytrace::Camera& view = scene_.view;
    dmat3 axes(view.right, view.up, view.forward);
    camera_from_accel_ = mat3(glm::transpose(axes));
    eye_ = vec3(view.eye);
    const CameraDefinition& camera =
        scene_.description->cameras[scene_.cameras[scene_.camera].definition];
    miss_distance_ =
        camera.zfar.present() ? float(view.zfar) : float(glm::length(view.eye) + scene_.size);
}

uint32_t Shading::ray_depth() const {
    return uint32_t(scene_.options.ray_depth);
}
uint32_t Shading::diffuse_depth() const {
    return uint32_t(scene_.options.diffuse_depth);
}

ShadingCounters Shading::end_frame(Diagnostics& diagnostics, bool whole) {
    ShadingCounters total;
    for (auto& thread : threads_) total += thread->counters;
    flush_prints();
    flush_bakes(whole, diagnostics);
    for (size_t l = 0; l < scene_.looks.size(); ++l) {
        const BoundKernel* kernels[] = {&scene_.looks[l]->full, scene_.looks[l]->opacity
                                                                    ? &*scene_.looks[l]->opacity
                                                                    : nullptr};
        for (size_t k = 0; k < 2; ++k) {
            if (!kernels[k]) continue;
            const auto& sites = kernels[k]->kernel().fault_sites;
            for (size_t s = 0; s < sites.size(); ++s) {
                bool hit = std::any_of(threads_.begin(), threads_.end(), [&](const auto& thread) {
                    return thread->faults[2 * l + k][s] != 0;
                });
                if (hit) diagnostics.report(Code::SHADER_FAULT, sites[s].where, sites[s].message);
            }
        }
    }
    return total;
}

void Shading::shade(const raytrace::HitBatch& hits, int thread_id, raytrace::ShadeResult& result) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    // Precise kernels run in the IEEE default, fast ones flush denormals
    // (docs/decisions.md#exact-arithmetic).
    std::optional<raytrace::DenormalGuard> flush;
    if (scene_.options.math == jit::math::Tier::Fast) flush.emplace();
    // A counting sort by look keeps the hits' order within each, so rows stay together.
    size_t looks = scene_.looks.size();
    std::span<uint32_t> begin = own.arena.allocate_span<uint32_t>(looks + 1);
    std::fill(begin.begin(), begin.end(), 0u);
    for (size_t i = 0; i < hits.count; ++i) ++begin[scene_.surfaces[hits.instance[i]].look + 1];
    for (size_t l = 0; l < looks; ++l) begin[l + 1] += begin[l];
    std::span<uint32_t> order = own.arena.allocate_span<uint32_t>(hits.count);
    std::span<uint32_t> next = own.arena.allocate_span<uint32_t>(looks);
    std::copy_n(begin.begin(), looks, next.begin());
    for (uint32_t i = 0; i < hits.count; ++i)
        order[next[scene_.surfaces[hits.instance[i]].look]++] = i;
    for (size_t l = 0; l < looks; ++l)
        for (size_t at = begin[l]; at < begin[l + 1]; at += kGridPoints)
            shade_look(hits, order.subspan(at, std::min(kGridPoints, begin[l + 1] - at)),
                       *scene_.looks[l], thread_id, result);
    if (scene_.atmosphere != kNone || !scene_.volumes.empty())
        apply_volumes(hits, thread_id, result);
    own.arena.release(mark);
}

void Shading::prepare_grid(Grid& grid, int thread_id) {
    Arena& arena = thread(thread_id).arena;
    grid.depth = grid.hits.depth;
    grid.thread = thread_id;
    grid.shading = this;
    grid.ray = thread(thread_id).ray;
    grid.arena = &arena;
    grid.columns = arena.allocate_span<float*>(grid.look->column_count);
    std::fill(grid.columns.begin(), grid.columns.end(), nullptr);
    grid.calls = arena.allocate_span<uint16_t>(padded(grid.count()));
    std::fill(grid.calls.begin(), grid.calls.end(), uint16_t(0));
    grid.record_sets = arena.allocate_span<jit::RecordSet>(kRecordSets);
    std::fill(grid.record_sets.begin(), grid.record_sets.end(), jit::RecordSet{});
}

static std::span<float*> take_outputs(const jit::Kernel& kernel, size_t count, Arena& arena) {
    std::span<float*> out = arena.allocate_span<float*>(kernel.outputs.size());
    for (float*& column : out) column = arena.allocate_span<float>(padded(count)).data();
    return out;
}

void find_color(const jit::Kernel& kernel, std::span<float* const> out, std::string_view name,
                float* color[3]) {
    for (int k = 0; k < 3; ++k) color[k] = nullptr;
    for (size_t o = 0; o < kernel.outputs.size(); ++o) {
        std::string_view full = kernel.outputs[o].name;
        if (full.size() != name.size() + 2 || !full.starts_with(name)) continue;
        color[full.back() == 'r' ? 0 : full.back() == 'g' ? 1 : 2] = out[o];
    }
}

std::span<float*> Shading::run_for_colors(const BoundKernel& bound, Grid& grid) {
    std::span<float*> out = take_outputs(bound.kernel(), grid.count(), *grid.arena);
    run_kernel(bound, grid, out);
    return out;
}

void Shading::run_kernel(const BoundKernel& bound, Grid& grid, std::span<float* const> out) {
    std::span<const float*> in = grid.arena->allocate_span<const float*>(bound.columns.size());
    for (size_t i = 0; i < in.size(); ++i) in[i] = grid.columns[bound.columns[i]];
    Thread& own = thread(grid.thread);
    jit::KernelCall{.kernel = bound.kernel(),
                    .count = grid.count(),
                    .in = in,
                    .out = out,
                    .row_floats = padded(grid.count()),
                    .frame = bound.frame,
                    .scratch = grid.arena->allocate_span<std::byte>(bound.kernel().scratch_bytes),
                    .faults = own.faults[2 * grid.look->index + (&bound != &grid.look->full)],
                    .services = bound.services,
                    .record_sets = grid.record_sets,
                    .host = &grid.host}
        .run();
}

void Shading::shade_look(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                         const ShaderInstance& look, int thread_id, raytrace::ShadeResult& result) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    Grid grid(scene_, hits, points, &look);
    prepare_grid(grid, thread_id);
    want_columns(grid, look.full.columns);
    if (look.lowered.uses_lights) want_lights(grid);
    gather(grid);
    const HitOutputs* outputs = std::exchange(own.outputs, nullptr);  // not those of rays from here
    if (look.lowered.uses_lights) run_lights(grid);
    std::span<float*> out = run_for_colors(look.full, grid);
    own.outputs = outputs;
    if (outputs) copy_outputs(*outputs, look.full.kernel(), out, points);
    own.counters.points += grid.count();
    float *Ci[3], *Oi[3];
    find_color(look.full.kernel(), out, "Ci", Ci);
    find_color(look.full.kernel(), out, "Oi", Oi);
    for (int k = 0; k < 3; ++k)
        for (size_t i = 0; i < points.size(); ++i) {
            result.Ci[k][points[i]] = Ci[k] ? Ci[k][i] : 0.0f;
            result.Oi[k][points[i]] = Oi[k] ? Oi[k][i] : 1.0f;
        }
    for (size_t p = 0; p < std::min(result.aov.size(), look.aovs.size()); ++p)
        for (size_t i = 0; look.aovs[p] >= 0 && i < points.size(); ++i)
            result.aov[p][points[i]] = out[size_t(look.aovs[p])][i];
    own.arena.release(mark);
}

// "surface:NAME": the shader's parameter of that name where it is an output; "surface:N" its
// normal.
void Shading::copy_outputs(const HitOutputs& wanted, const jit::Kernel& kernel,
                           std::span<float* const> out, std::span<const uint32_t> points) {
    size_t column = 0;
    for (const rsl::LoweredShader::GatherResult& result : wanted.wanted) {
        size_t components = size_t(rsl::component_count(result.type));
        std::string_view name = result.name;
        if (name.starts_with("surface:")) {
            name.remove_prefix(8);
            for (size_t o = 0; o < kernel.outputs.size(); ++o) {
                std::string_view full = kernel.outputs[o].name;
                if (full.starts_with("aov:"))
                    full.remove_prefix(4);
                else if (name != "N")
                    continue;
                if (!full.starts_with(name)) continue;
                int k = output_component(full.substr(name.size()));
                if (k < 0 || size_t(k) >= components) continue;
                for (size_t i = 0; i < points.size(); ++i)
                    wanted.columns[column + size_t(k)][points[i]] = out[o][i];
            }
        }
        column += components;
    }
}

void Shading::opacity(const raytrace::HitBatch& hits, int thread_id, vec3* result) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    std::span<uint32_t> points = own.arena.allocate_span<uint32_t>(hits.count);
    for (size_t l = 0; l < scene_.looks.size(); ++l) {
        const ShaderInstance& look = *scene_.looks[l];
        size_t count = 0;
        for (uint32_t i = 0; i < hits.count; ++i)
            if (scene_.surfaces[hits.instance[i]].look == l) points[count++] = i;
        if (count == 0) continue;
        if (!look.opacity) {
            for (size_t i = 0; i < count; ++i) result[points[i]] = vec3(1.0f);
            continue;
        }
        for (size_t at = 0; at < count; at += kGridPoints) {
            Arena::Mark grid_mark = own.arena.mark();
            std::span<const uint32_t> part = points.subspan(at, std::min(kGridPoints, count - at));
            Grid grid(scene_, hits, part, &look);
            prepare_grid(grid, thread_id);
            grid.shadows = false;
            want_columns(grid, look.opacity->columns);
            if (look.lowered.uses_lights) want_lights(grid);
            gather(grid);
            if (look.lowered.uses_lights) run_lights(grid);
            std::span<float*> out = run_for_colors(*look.opacity, grid);
            own.counters.opacity_points += grid.count();
            float* Oi[3];
            find_color(look.opacity->kernel(), out, "Oi", Oi);
            for (size_t i = 0; i < part.size(); ++i) {
                vec3 given(1.0f);
                for (int k = 0; k < 3; ++k)
                    if (Oi[k]) given[k] = Oi[k][i];
                result[part[i]] = stopped_by(given);
            }
            own.arena.release(grid_mark);
        }
    }
    own.arena.release(mark);
}

}  // namespace kinora
