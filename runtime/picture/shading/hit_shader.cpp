// runtime/picture/shading/hit_shader.cpp: hits through the kernels of their looks.
#include "runtime/picture/shading/hit_shader.h"

#include <time.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "raytrace/hits.h"
#include "rsl/model/renderer_services.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/shading/dome.h"
#include "runtime/picture/shading/frame/frame.h"
#include "runtime/picture/shading/frame/insight.h"
#include "runtime/picture/shading/light_layers.h"
#include "runtime/picture/shading/lighting/lamps.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/picture/shading/relight.h"

namespace kinora {

namespace {

// Precise kernels run in the IEEE default, fast ones flush denormals
// (docs/decisions.md#exact-arithmetic).
struct DenormalMode {
    explicit DenormalMode(const Quality& quality) {
        if (quality.math == jit::math::Tier::Fast) flush.emplace();
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

struct HitShader::Call {
    const raytrace::HitBatch& hits;
    const RayTag& ray;
    ThreadMemory& memory;
    raytrace::ShadeResult& result;
    const HitOutputs* outputs;
};

void HitShader::shade(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
                      raytrace::ShadeResult& result, const HitOutputs* outputs) {
    StageScope stage(Stage::Gather);
    Arena& arena = memory.arena;
    Arena::Mark mark = arena.mark();
    DenormalMode mode(frame_.quality);
    Call call{hits, ray, memory, result, outputs};
    std::span<const LookRun> runs = runs_by_look(frame_, hits, arena);
    // Small grids of several looks are lit together, so that their shadow rays fill packets.
    std::span<Grid*> lit = arena.allocate_span<Grid*>(runs.size());
    size_t grids = 0, points = 0;
    LampRays shadows(frame_, queue_, memory, ray);
    Arena::Mark part = arena.mark();
    RayNotes notes(queue_, hits.depth + 1, memory);
    auto shade_lit = [&] {
        light_grids(lit.first(grids), shadows, notes);
        note_rays(lit.first(grids), shadows, notes);
        for (Grid* grid : lit.first(grids)) {
            notes.answer(*grid);
            shade_grid(call, *grid);
        }
        notes.reset();
        arena.release(part);
        grids = points = 0;
    };
    if (hits.depth == 0 && frame_.insight.first) frame_.insight.first->take(hits);
    PixelCosts* costs = hits.depth == 0 ? frame_.insight.costs : nullptr;
    for (const LookRun& run : runs) {
        CostScope cost(costs, memory, hits, run.hits);
        const size_t most =
            run.look->lowered.uses_lights ? lights_.most_points(*run.look) : kGridPoints;
        for (size_t at = 0, n; at < run.hits.size(); at += n) {
            n = std::min(most, run.hits.size() - at);
            if (points + n > most) shade_lit();
            lit[grids++] = &make_grid(call, run, run.hits.subspan(at, n));
            points += n;
        }
        if (costs) shade_lit();
    }
    shade_lit();
    volumes_.apply(hits, ray, shadows_, memory, result);
    arena.release(mark);
}

namespace {

constexpr float kBlack = 1.5e-4f;  // 0 in an 8-bit picture

float largest(const float* const rows[3], size_t i) {
    return std::max({rows[0][i], rows[1][i], rows[2][i]});
}

// The points of `dark`, up to the returned number, at whose side that the ray sees no light from
// somewhere arrives. Record by record, whose columns then are read in their order.
size_t drop_lit(const Grid& grid, std::span<uint32_t> dark) {
    std::span<vec3> N = grid.memory.arena.allocate_span<vec3>(grid.count());
    for (uint32_t i : dark) {
        N[i] = triple(grid.columns.data() + kColN, i);
        vec3 seen_along = grid.frame.camera_from_accel * triple(grid.hits.dir, grid.points[i]);
        if (glm::dot(N[i], seen_along) > 0) N[i] = -N[i];
    }
    const float least = std::max(kBlack, grid.frame.lights.world_light);
    const jit::RecordSet& set = grid.record_sets[0];
    for (int32_t r = 0; r < set.count && !dark.empty(); ++r) {
        const jit::Record& record = set.records[r];
        if (jit::bits_of(record.uniforms[rsl::kLightKind]) == rsl::kLightAmbient) continue;
        const float* lit = record.columns[rsl::kLightLit];
        auto is_lit = [&](uint32_t i) {
            return jit::bits_of(lit[i]) != 0 &&
                   largest(record.columns + rsl::kLightCl, i) > least &&
                   glm::dot(N[i], triple(record.columns + rsl::kLightL, i)) > 0;
        };
        dark = dark.first(size_t(std::remove_if(dark.begin(), dark.end(), is_lit) - dark.begin()));
    }
    return dark.size();
}

}  // namespace

// For LIGHTS_DARK: black points of surfaces that ask for light and get none. What the grey world
// alone shows counts as black.
void HitShader::count_dark(const Grid& grid, const raytrace::ShadeResult& result) const {
    ShadingCounters& counters = grid.memory.counters;
    std::span<uint32_t> dark = grid.memory.arena.allocate_span<uint32_t>(grid.count());
    size_t count = 0;
    const float most = kBlack + frame_.lights.world_light;
    for (uint32_t i = 0; i < grid.count(); ++i) {
        uint32_t hit = grid.points[i];
        if (!(largest(result.Oi, hit) > 0)) continue;
        counters.seen += 1;
        bool black = largest(result.Ci, hit) < most;
        if (black && grid.look->lowered.uses_lights) dark[count++] = i;
    }
    if (count > 0) counters.dark += drop_lit(grid, dark.first(count));
}

namespace {

// Rays of grids that send some, noted together where there is more than one lane group of them.
void note_together(std::span<Grid* const> grids, FunctionRef<bool(const Grid&)> sends,
                   RayNotes& notes, FunctionRef<void(Grid&)> note) {
    size_t points = 0;
    for (const Grid* grid : grids)
        if (sends(*grid)) points += grid->count();
    if (points <= jit::kMaxLanes) return;
    notes.start();
    for (Grid* grid : grids)
        if (sends(*grid)) note(*grid);
    notes.finish();
}

}  // namespace

// The lights of all grids, whose rays go together: first those that their kernels send.
void HitShader::light_grids(std::span<Grid* const> grids, LampRays& shadows, RayNotes& notes) {
    for (Grid* grid : grids) grid->shadows = &shadows;
    auto sends = [&](const Grid& grid) { return lights_.sends_noted_rays(grid); };
    if (!frame_.stopped())
        note_together(grids, sends, notes, [&](Grid& grid) { lights_.note_rays(grid, notes); });
    for (Grid* grid : grids) {
        if (grid->look->lowered.uses_lights) lights_.run(*grid);
        grid->notes = nullptr;
        grid->shadows = &shadows_;
    }
    notes.reset();
    shadows.finish();
}

// Rays, and directions that lights are asked for.
void HitShader::note_rays(std::span<Grid* const> grids, LampRays& shadows, RayNotes& notes) {
    auto sends = [&](const Grid& grid) {
        return sends_noted_rays(*grid.look, grid) || lights_.notes_directions(grid);
    };
    if (frame_.stopped()) return;
    note_together(grids, sends, notes, [&](Grid& grid) {
        grid.notes = &notes;
        lights_.start_directions(grid);
        kernels_.run_noting(grid, [&] { kernels_.run_in_the_dark(grid); });
    });
    for (Grid* grid : grids) {
        if (!grid->directions) continue;
        grid->shadows = &shadows;
        lights_.answer_directions(*grid);
        grid->shadows = &shadows_;
    }
    shadows.finish();
}

// A grid in the arena with all that its kernel and its lights read.
Grid& HitShader::make_grid(const Call& call, const LookRun& run, std::span<const uint32_t> points) {
    const ShaderInstance& look = *run.look;
    void* at = call.memory.arena.allocate(sizeof(Grid));
    Grid& grid = *new (at) Grid(frame_, call.memory, call.hits, points, &look);
    kernels_.prepare(grid, call.ray);
    grid.ascending = run.ascending;
    grid.dense = run.ascending && points.back() - points.front() == points.size() - 1;
    grid.goes_on = call.result.passages;
    want_columns(grid, look.full.columns);
    if (look.lowered.uses_lights) lights_.want_columns(grid);
    gather(grid);
    if (look.lowered.uses_lights) lights_.find_points(grid);
    return grid;
}

namespace {

// An output of the kernel to the hits; `otherwise` where it has none.
void put_output(const Grid& grid, const float* output, float otherwise, float* to) {
    const size_t count = grid.count();
    if (grid.dense && output)
        std::copy_n(output, count, to + grid.points[0]);
    else if (grid.dense)
        std::fill_n(to + grid.points[0], count, otherwise);
    else
        for (size_t i = 0; i < count; ++i) to[grid.points[i]] = output ? output[i] : otherwise;
}

}  // namespace

void HitShader::shade_grid(const Call& call, Grid& grid) {
    const ShaderInstance& look = *grid.look;
    std::span<const uint32_t> points = grid.points;
    const raytrace::HitBatch& hits = call.hits;
    raytrace::ShadeResult& result = call.result;
    const bool layered = start_tape(grid, result);
    std::span<float*> out = kernels_.run(look.full, grid);
    if (call.outputs) copy_outputs(*call.outputs, look.full.kernel(), out, points);
    grid.memory.counters.points += grid.count();
    float *Ci[3], *Oi[3];
    find_color(look.full.kernel(), out, rsl::Global::Ci, Ci);
    find_color(look.full.kernel(), out, rsl::Global::Oi, Oi);
    for (int k = 0; k < 3; ++k) {
        put_output(grid, Ci[k], 0, result.Ci[k]);
        put_output(grid, Oi[k], 1, result.Oi[k]);
    }
    lamps_.show(grid, result);
    for (size_t i = 0; result.passages && i < grid.rays.size(); ++i) {
        const PointRays& rays = grid.rays[i];
        const uint32_t before = hits.rays->spent[hits.ray[points[i]]];
        result.passages[points[i]] = {rays.onward, rays.reflects, rays.shot - before, rays.kept};
    }
    if (layered) fill_light_layers(grid, kernels_, Ci, result, call.memory.layer_errors);
    if (frame_.relit && grid.depth == 0) relight(grid, kernels_, result);
    const bool whole = frame_.insight.only_light == kNone;
    if (whole && frame_.pose.watch_dark > 0 && grid.depth == 0) count_dark(grid, result);
    for (size_t p = 0; p < std::min(result.aov.size(), look.aovs.size()); ++p)
        for (size_t i = 0; look.aovs[p] >= 0 && i < points.size(); ++i)
            result.aov[p][points[i]] = out[size_t(look.aovs[p])][i];
}

// A volume begins with what surrounds the scene. Where nothing does, Ci and Oi are 0; without a
// volume they stay so.
void HitShader::shade_misses(const raytrace::HitBatch& ends, const RayTag& ray,
                             ThreadMemory& memory, raytrace::ShadeResult& result) {
    DenormalMode mode(frame_.quality);
    for (size_t k = 0; k < 3; ++k) {
        std::fill_n(result.Ci[k], ends.count, 0.0f);
        std::fill_n(result.Oi[k], ends.count, 0.0f);
    }
    if (dome_.is_seen(ray)) dome_.show(ends, ray, memory, result);
    fill_layers_of_misses(frame_, ends.count, result);
    volumes_.apply(ends, ray, shadows_, memory, result);
}

void PixelCosts::start(int picture_width, int picture_height) {
    width = picture_width;
    height = picture_height;
    for (std::vector<float>* plane : {&ns, &rays, &points, &filled, &lanes})
        plane->assign(size_t(width) * size_t(height), 0.0f);
}

CostScope::CostScope(PixelCosts* costs, const ThreadMemory& memory, const raytrace::HitBatch& hits,
                     std::span<const uint32_t> which)
    : costs_(costs), memory_(memory), hits_(hits), which_(which) {
    if (costs_) begin_ = read();
}

CostScope::Reading CostScope::read() const {
    const ShadingCounters& counters = memory_.counters;
    timespec now{};  // of this thread alone: what else the machine does is no cost of the pixel
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return {int64_t(now.tv_sec) * 1'000'000'000 + now.tv_nsec,
            counters.trace.rays + counters.trace.shadow_rays, counters.kernel_points,
            counters.kernel_lanes};
}

CostScope::~CostScope() {
    if (!costs_ || which_.empty()) return;
    const Reading end = read();
    const auto share = 1.0f / float(which_.size());
    for (uint32_t hit : which_) {
        const size_t pixel =
            size_t(hits_.pixel_y[hit]) * size_t(costs_->width) + hits_.pixel_x[hit];
        costs_->ns[pixel] += share * float(end.ns - begin_.ns);
        costs_->rays[pixel] += share * float(end.rays - begin_.rays);
        costs_->points[pixel] += 1;
        costs_->filled[pixel] += share * float(end.filled - begin_.filled);
        costs_->lanes[pixel] += share * float(end.lanes - begin_.lanes);
    }
}

}  // namespace kinora
