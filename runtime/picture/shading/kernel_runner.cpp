// runtime/picture/shading/kernel_runner.cpp: grids through kernels.
#include "runtime/picture/shading/kernel_runner.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "jit/target.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/lights/kernels.h"
#include "runtime/picture/shading/grid_host.h"
#include "runtime/picture/shading/light_layers.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

// Rows of faults by look and kernel.
size_t fault_row(const ShaderInstance& look, const BoundKernel& bound) {
    return 2 * look.index + (&bound != &look.full);
}

const FrameBlock& block_of(const ShadingFrame& frame, const ShaderInstance& look,
                           const BoundKernel& bound) {
    const InstanceFrame& of = frame.instances[look.index];
    return &bound == &look.full ? of.full : of.opacity;
}

// Calls f(look, bound kernel) for each kernel of all looks.
template <class F>
void for_each_kernel(const SceneShaders& shaders, F&& f) {
    for (const auto& look : shaders.shader_instances) {
        f(*look, look->full);
        if (look->opacity) f(*look, *look->opacity);
    }
}

}  // namespace

void KernelRunner::begin_frame(size_t threads) {
    faults_.resize(std::max(faults_.size(), threads));
    for (auto& faults : faults_) {
        for (auto& row : faults) std::ranges::fill(row, uint8_t(0));
        if (faults.size() == 2 * frame_.shaders.shader_instances.size()) continue;
        faults.resize(2 * frame_.shaders.shader_instances.size());
        for_each_kernel(frame_.shaders, [&](const ShaderInstance& look, const BoundKernel& bound) {
            faults[fault_row(look, bound)].assign(bound.kernel().fault_sites.size(), 0);
        });
    }
}

void KernelRunner::report_faults(Diagnostics& diagnostics) const {
    for (const auto& look : frame_.shaders.shader_instances)
        if (const InstanceFrame& of = frame_.instances[look->index];
            of.prints_asked > of.prints_shown)
            diagnostics.report(Code::PRINT_LIMIT, Location{}, look->shader().name, of.prints_asked,
                               of.prints_shown);
    for_each_kernel(frame_.shaders, [&](const ShaderInstance& look, const BoundKernel& bound) {
        const size_t row = fault_row(look, bound);
        auto faulted = [&](size_t site) {
            return std::any_of(faults_.begin(), faults_.end(),
                               [&](const auto& faults) { return faults[row][site] != 0; });
        };
        kinora::report_faults(bound.kernel(), faulted, diagnostics);
        bound.report_frame_faults(block_of(frame_, look, bound), diagnostics);
    });
}

namespace {

// Of the rows of ray_kinds(); null for rays that no shader sends.
std::vector<jit::ServiceFn> find_ray_services() {
    std::vector<jit::ServiceFn> fns;
    for (const RayKindRow& row : ray_kinds())
        fns.push_back(row.service.empty() ? nullptr : find_service(row.service));
    return fns;
}

}  // namespace

bool calls_service(const BoundKernel& kernel, RayKind kind) {
    static const std::vector<jit::ServiceFn> fns = find_ray_services();
    return std::ranges::find(kernel.services, fns[size_t(kind)]) != kernel.services.end();
}

bool shoots_rays(const ShaderInstance& look) {
    static const jit::ServiceFn limit = find_service("raylimit");
    auto shoots = [](const BoundKernel& kernel) {
        return std::ranges::count(kernel.services, limit) > 0 ||
               std::ranges::any_of(ray_kinds(), [&](const RayKindRow& row) {
                   return calls_service(kernel, row.kind);
               });
    };
    return shoots(look.full) || (look.opacity && shoots(*look.opacity));
}

void KernelRunner::prepare(Grid& grid, const RayTag& ray) const {
    Arena& arena = grid.memory.arena;
    grid.depth = grid.hits.depth;
    grid.ray = ray;
    grid.columns = arena.allocate_span<float*>(grid.look->column_count);
    std::fill(grid.columns.begin(), grid.columns.end(), nullptr);
    if (frame_.lights_shoot || shoots_rays(*grid.look)) {
        grid.calls = arena.allocate_span<uint16_t>(padded(grid.count()));
        grid.rays = arena.allocate_span<PointRays>(grid.count());
        start_accounts(grid);
    }
    // Services fill a set before they return its handle; set 0 needs no handle.
    grid.record_sets = arena.allocate_span<jit::RecordSet>(kRecordSets);
    grid.record_sets[0] = {};
}

void KernelRunner::start_accounts(Grid& grid) const {
    std::fill(grid.calls.begin(), grid.calls.end(), uint16_t(0));
    for (size_t i = 0; i < grid.rays.size(); ++i) {
        grid.rays[i] = {};
        if (const raytrace::RayBatch* rays = grid.hits.rays)
            grid.rays[i].shot = rays->spent[grid.hits.ray[grid.points[i]]];
    }
}

namespace {

size_t count_points(const Grid& grid, bool PointRays::*flag) {
    return size_t(std::ranges::count_if(grid.rays, flag));
}

}  // namespace

namespace {

// A run whose faults may come of what it does not know.
void run_untold(const ShadingFrame& frame, const BoundKernel& bound, Grid& grid, KernelHost& host,
                std::span<float* const> out) {
    Arena& arena = grid.memory.arena;
    bound.run({.count = grid.count(),
               .frame = block_of(frame, *grid.look, bound),
               .columns = grid.columns,
               .out = out,
               .faults = arena.allocate_span<uint8_t>(bound.kernel().fault_sites.size()),
               .record_sets = grid.record_sets,
               .host = host,
               .stop = frame.stop},
              arena);
}

}  // namespace

std::span<float*> KernelRunner::run_in_the_dark(Grid& grid) const {
    const BoundKernel& bound = grid.look->full;
    std::span<float*> out = take_outputs(bound.kernel(), grid.count(), grid.memory.arena);
    NotingHost host(grid, services_);
    run_untold(frame_, bound, grid, host, out);
    return out;
}

void KernelRunner::run_again(const BoundKernel& bound, Grid& grid, KernelHost& host,
                             std::span<float* const> out, const jit::RecordSet& lights) const {
    Arena& arena = grid.memory.arena;
    std::span<jit::RecordSet> sets = arena.allocate_span<jit::RecordSet>(kRecordSets);
    std::fill(sets.begin(), sets.end(), jit::RecordSet{});
    sets[0] = lights;
    std::swap(sets, grid.record_sets);
    run_untold(frame_, bound, grid, host, out);
    std::swap(sets, grid.record_sets);
}

std::span<float*> KernelRunner::run_relit(Grid& grid, const jit::RecordSet& lights) const {
    const BoundKernel& bound = grid.look->full;
    std::span<float*> out = take_outputs(bound.kernel(), grid.count(), grid.memory.arena);
    RelitHost host(grid, services_);
    run_again(bound, grid, host, out, lights);
    return out;
}

std::span<float*> KernelRunner::run_part(const BoundKernel& bound, Grid& grid,
                                         const LightPart& part) const {
    Arena& arena = grid.memory.arena;
    std::span<float*> out = take_outputs(bound.kernel(), grid.count(), arena);
    const Arena::Mark mark = arena.mark();
    ReplayHost host(grid, services_, part);
    run_again(bound, grid, host, out, records_of_part(grid, grid.record_sets[0], part));
    arena.release(mark);
    return out;
}

void KernelRunner::run_noting(Grid& grid, FunctionRef<void()> run) const {
    const size_t ended = count_points(grid, &PointRays::ended),
                 thinned = count_points(grid, &PointRays::thinned);
    run();
    grid.memory.counters.out_of_rays -= count_points(grid, &PointRays::ended) - ended;
    grid.memory.counters.thinned -= count_points(grid, &PointRays::thinned) - thinned;
    start_accounts(grid);
}

std::span<float*> KernelRunner::run(const BoundKernel& bound, Grid& grid) {
    StageScope stage(Stage::Kernels);
    Arena& arena = grid.memory.arena;
    std::span<float*> out = take_outputs(bound.kernel(), grid.count(), arena);
    GridHost plain(grid, services_);
    TapingHost taping(grid, services_);
    KernelHost& host = grid.tape ? static_cast<KernelHost&>(taping) : plain;
    const jit::Target* target = frame_.resources.options.target;
    const auto lanes = size_t((target ? *target : jit::best_target()).lanes);
    grid.memory.counters.kernel_points += grid.count();
    grid.memory.counters.kernel_lanes += (grid.count() + lanes - 1) / lanes * lanes;
    bound.run({.count = grid.count(),
               .frame = block_of(frame_, *grid.look, bound),
               .columns = grid.columns,
               .out = out,
               .faults = faults_[grid.memory.number][fault_row(*grid.look, bound)],
               .record_sets = grid.record_sets,
               .host = host,
               .stop = frame_.stop},
              arena);
    return out;
}

namespace {

void sort_few(const uint32_t* look, std::span<uint32_t> order) {
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return look[a] != look[b] ? look[a] < look[b] : a < b;
    });
}

void sort_by_counting(const uint32_t* look, size_t looks, std::span<uint32_t> order, Arena& arena) {
    std::span<uint32_t> next = arena.allocate_span<uint32_t>(looks + 1);
    std::fill(next.begin(), next.end(), 0u);
    for (size_t i = 0; i < order.size(); ++i) ++next[look[i] + 1];
    for (size_t l = 0; l < looks; ++l) next[l + 1] += next[l];
    for (uint32_t i = 0; i < order.size(); ++i) order[next[look[i]]++] = i;
}

}  // namespace

namespace {

// The cell of each hit among 8 x 8 x 8 of the hits' box, such that cells of near numbers are near.
void find_cells(const raytrace::HitBatch& hits, std::span<uint32_t> cell) {
    float low[3], scale[3];
    for (int k = 0; k < 3; ++k) {
        float high;
        light_kernels().bounds(hits.P[k], hits.count, low[k], high);
        scale[k] = 7.99f / (high - low[k]);
        if (!(scale[k] > 0 && scale[k] < 1e30f)) low[k] = scale[k] = 0;
    }
    light_kernels().cells(hits.P, low, scale, hits.count, cell.data());
}

// Hits of rays that scatter lie anywhere: in the order of place, those that are shaded together
// read the same triangles, and what they send leaves from near places. What a hit shows does not
// depend on its neighbours.
void sort_by_place(const raytrace::HitBatch& hits, std::span<const uint32_t> look, size_t looks,
                   std::span<uint32_t> order, Arena& arena) {
    constexpr size_t kCells = 512;
    std::span<uint32_t> cell = arena.allocate_span<uint32_t>(hits.count);
    std::span<uint32_t> by_cell = arena.allocate_span<uint32_t>(hits.count);
    std::span<uint32_t> next = arena.allocate_span<uint32_t>(looks + 1);
    find_cells(hits, cell);
    sort_by_counting(cell.data(), kCells, by_cell, arena);
    std::fill(next.begin(), next.end(), 0u);
    for (uint32_t l : look) ++next[l + 1];
    for (size_t l = 0; l < looks; ++l) next[l + 1] += next[l];
    for (uint32_t i : by_cell) order[next[look[i]]++] = i;
}

// The look of each hit; whether it is the same for all.
bool find_looks(const SceneShapes& shapes, const raytrace::HitBatch& hits,
                std::span<uint32_t> look) {
    uint32_t differs = 0;
    for (size_t i = 0; i < hits.count; ++i) {
        look[i] = shapes.surfaces[hits.instance[i]].look;
        differs |= look[i] ^ look[0];
    }
    return differs == 0;
}

}  // namespace

std::span<const LookRun> runs_by_look(const ShadingFrame& frame, const raytrace::HitBatch& hits,
                                      Arena& arena) {
    std::span<uint32_t> look = arena.allocate_span<uint32_t>(hits.count);
    const bool alike = find_looks(frame.shapes, hits, look);
    std::span<uint32_t> order = arena.allocate_span<uint32_t>(hits.count);
    constexpr size_t kScattered = 64;  // hits from which their places are worth an order
    const bool by_place = hits.depth > 0 && hits.count >= kScattered &&
                          hits.count >= frame.shaders.shader_instances.size();
    if (alike && !by_place)
        std::iota(order.begin(), order.end(), 0u);
    else if (hits.count < frame.shaders.shader_instances.size())
        sort_few(look.data(), order);
    else if (by_place)
        sort_by_place(hits, look, frame.shaders.shader_instances.size(), order, arena);
    else
        sort_by_counting(look.data(), frame.shaders.shader_instances.size(), order, arena);
    std::span<LookRun> runs =
        arena.allocate_span<LookRun>(std::min(hits.count, frame.shaders.shader_instances.size()));
    size_t count = 0;
    for (size_t begin = 0, end; begin < hits.count; begin = end) {
        uint32_t own = look[order[begin]];
        for (end = begin + 1; end < hits.count && look[order[end]] == own;) ++end;
        runs[count++] = {frame.shaders.shader_instances[own].get(),
                         order.subspan(begin, end - begin), !by_place};
    }
    return runs.first(count);
}

raytrace::ShadeResult take_colors(Arena& arena, size_t count) {
    raytrace::ShadeResult result;
    for (size_t k = 0; k < 3; ++k) {
        result.Ci[k] = arena.allocate_span<float>(padded(count)).data();
        result.Oi[k] = arena.allocate_span<float>(padded(count)).data();
    }
    return result;
}

void find_color(const jit::Kernel& kernel, std::span<float* const> out, rsl::Global id,
                float* color[3]) {
    for (int k = 0; k < 3; ++k) color[k] = nullptr;
    for (size_t o = 0; o < kernel.outputs.size(); ++o) {
        rsl::KernelKey key = rsl::key_of(kernel.outputs[o]);
        if (key.kind == rsl::KeyKind::Global && key.global() == id) color[key.component] = out[o];
    }
}

}  // namespace kinora
