// runtime/picture/shading/lighting/light_records.cpp: light kernels over the points of a grid.
#include "runtime/picture/shading/lighting/light_records.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "raytrace/hits.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/columns/sixteen_points.h"
#include "runtime/picture/lights/cone_samples.h"
#include "runtime/picture/shading/lighting/emission.h"
#include "runtime/picture/shading/lighting/lamp_probe.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/kernels/columns.h"

namespace kinora {

namespace {

const ShaderInstance& look_of_light(const ShadingFrame& frame, size_t light) {
    return *frame.shaders.shader_instances[frame.lights.lights[light].look];
}

// Columns a light kernel reads, from the points to be lit.
std::span<float*> light_columns(const ShaderInstance& look, const Pose& pose,
                                const LightSource& light, const LightPoints& at, Arena& arena) {
    std::span<float*> columns = arena.allocate_span<float*>(look.column_count);
    std::fill(columns.begin(), columns.end(), nullptr);
    vec3 origin(pose.view.camera_from_world * pose.nodes[light.node].world[3]);
    auto view = [](const float* p) { return const_cast<float*>(p); };
    for (uint16_t column : look.full.columns) {
        if (columns[column]) continue;
        if (column >= kColPs && column < kColPs + 3)
            columns[column] = view(at.P[column - kColPs]);
        else if (column >= kColNs && column < kColNs + 3)
            columns[column] = view(at.N[column - kColNs]);
        else if (column >= kColN && column < kColN + 3)
            columns[column] = view(at.N[column - kColN]);
        else if (column == kColRng && at.rng)
            columns[column] = view(at.rng);
        else {
            columns[column] = arena.allocate_span<float>(padded(at.count)).data();
            bool is_origin = column >= kColP && column < kColP + 3;
            std::fill_n(columns[column], padded(at.count),
                        is_origin ? origin[column - kColP] : 0.0f);
        }
    }
    return columns;
}

// A light without an output `lit` is lit everywhere.
const float* ones_column(Arena& arena, size_t count) {
    std::span<float> column = arena.allocate_span<float>(padded(count));
    std::fill(column.begin(), column.end(), jit::float_of(1));
    return column.data();
}

// `light_begin`: the first record of the light.
const float* record_uniforms(const Pose& pose, Arena& arena, const LightOutputs& statement,
                             const LightBinding& binding, size_t light_begin) {
    float* uniforms = arena.allocate_span<float>(rsl::kLightUniforms + binding.known.size()).data();
    uniforms[rsl::kLightKind] = jit::float_of(statement.kind);
    uniforms[rsl::kLightCategories] = jit::float_of(binding.categories);
    uniforms[rsl::kLightNondiffuse] = binding.nondiffuse.in(pose);
    uniforms[rsl::kLightNonspecular] = binding.nonspecular.in(pose);
    uniforms[rsl::kLightNumber] = jit::float_of(binding.light);
    uniforms[rsl::kLightHandle] = jit::float_of(int32_t(light_begin));
    uniforms[rsl::kLightSampled] = jit::float_of(int32_t(statement.sampled));
    for (size_t m = 0; m < binding.known.size(); ++m)
        uniforms[rsl::kLightUniforms + m] = jit::float_of(binding.known[m]);
    return uniforms;
}

bool gathers_indirect(const Grid& grid) {
    return calls_service(grid.look->full, RayKind::Indirect);
}

void shadow_sample(Grid& grid, const LightPoints& at, const SentLight& sent) {
    if (!grid.shadows) return;
    if (at.own) drop_behind(seen_points(grid), grid.memory.arena, {&sent, 1});
    if (sent.casts) grid.shadows->cast(grid, at, sent);
}

}  // namespace

LightRecords::LightRecords(const ShadingFrame& frame, KernelRunner& kernels)
    : frame_(frame),
      kernels_(kernels),
      bindings_(frame.resources, frame.lights, frame.shaders),
      area_lights_(frame, bindings_),
      choice_(frame.lights, frame.shaders, bindings_) {
    for (size_t l = 0; l < frame.lights.lights.size(); ++l) {
        all_lights_.every.push_back(l);
        for (const LightOutputs& statement : bindings_.statements(l)) {
            all_lights_.records += asked_samples(l, statement, false);
            draws_samples_ |= statement.spread >= 0;
            draws_samples_ |= statement.sampled;
            if (statement.sampled) sampling_.push_back(l);
        }
        draws_samples_ |= area_lights_.find(l) != nullptr;
        need_rng_ |= look_of_light(frame, l).lowered.uses_rng;
        if (shoots_rays(look_of_light(frame, l)) && !area_lights_.find(l)) sending_.push_back(l);
        sends_indirect_ |= calls_service(look_of_light(frame, l).full, RayKind::Indirect);
    }
}

size_t LightRecords::asked_samples(size_t light, const LightOutputs& statement,
                                   bool beside_indirect) const {
    const AreaLight* area = area_lights_.find(light);
    const bool wide = area ? area->directed : statement.spread >= 0;
    return wide ? light_samples(frame_, light, beside_indirect) : 1;
}

size_t LightRecords::samples_of(size_t light, const LightOutputs& statement,
                                const Grid& grid) const {
    return size_t(samples_at(
        grid.ray, int(asked_samples(light, statement, sends_indirect_ || gathers_indirect(grid)))));
}

void LightRecords::begin_frame(bool all, ThreadMemory& memory) {
    all_ = all;
    area_lights_.begin_frame();
    choose_sampling(memory);
    reaches_.resize(frame_.lights.lights.size());
    for (size_t l = 0; l < reaches_.size(); ++l)
        if (all || bindings_.asked(l))
            reaches_[l] = LightBindings::reach(frame_.nodes, frame_.pose, look_of_light(frame_, l));
    find_present();
    if (!all)
        choice_.begin_frame(frame_.nodes, frame_.pose, all_lights_.present,
                            frame_.quality.light_choice);
    if (!choice_.groups().empty()) find_others();
}

void LightRecords::choose_sampling(ThreadMemory& memory) {
    for (size_t l : area_lights_.all()) {
        const AreaLight& light = *area_lights_.find(l);
        if (!(all_ || bindings_.asked(l))) continue;
        if (light.emits) {
            find_powers(frame_, kernels_, memory, light, powers_);
            area_lights_.weigh(l, powers_);
        }
        area_lights_.sample_by_angle(
            l, suits_by_angle(frame_, kernels_, memory, light, l, bindings_.statements(l)));
    }
}

// By the box of the whole scene, so that the grids need not ask of each light again.
void LightRecords::find_present() {
    vec3 low, high;
    frame_.pose.accel.bounds(low, high);
    const dmat3 current(frame_.camera_from_accel);
    const dvec3 half = 0.5 * (dvec3(high) - dvec3(low));
    Sphere scene;
    scene.center = current * (0.5 * (dvec3(high) + dvec3(low)) - dvec3(frame_.eye));
    scene.radius = glm::length(half);
    for (int k = 0; k < 3; ++k)
        scene.half[k] = glm::dot(glm::abs(glm::transpose(current)[k]), half);
    far_ = 4 * float(scene.radius);  // from any point of the scene
    all_lights_.present.clear();
    for (size_t l = 0; l < reaches_.size(); ++l)
        if (!reaches_[l].bounded() || reaches(reaches_[l], scene)) all_lights_.present.push_back(l);
}

void LightRecords::find_others() {
    auto copy = [&](const std::vector<size_t>& from, std::vector<size_t>& to) {
        to.clear();
        for (size_t l : from)
            if (!choice_.holds(l)) to.push_back(l);
    };
    copy(all_lights_.every, others_.every);
    copy(all_lights_.present, others_.present);
    others_.records = choice_.groups().size() * choice_.count();
    for (size_t l : others_.every)
        for (const LightOutputs& statement : bindings_.statements(l))
            others_.records += asked_samples(l, statement, false);
}

size_t LightRecords::most_points(const ShaderInstance& look) const {
    constexpr size_t kCacheBytes = 1 << 20, kRecordBytes = 7 * sizeof(float);  // L, Cl and lit
    constexpr size_t kLeast = 64;
    const size_t records = chooses(look) ? others_.records : all_lights_.records;
    const size_t points = kCacheBytes / (kRecordBytes * std::max<size_t>(records, 1));
    return std::clamp(points / kLeast * kLeast, kLeast, kGridPoints);
}

void LightRecords::want_columns(Grid& grid) const {
    want_triple(grid, kColP);
    want_triple(grid, kColN);
    grid.normals = grid.memory.arena.allocate_span<uint32_t>(padded(grid.count()));
    constexpr uint16_t kRandom[] = {kColRng};
    if (need_rng_) kinora::want_columns(grid, kRandom);
}

namespace {

// From columns of hits to columns of the grid's points.
void of_points(const Grid& grid, std::span<const float** const> columns, const uint32_t*& surface) {
    Arena& arena = grid.memory.arena;
    const size_t count = grid.count();
    std::span<float*> to = arena.allocate_span<float*>(columns.size());
    for (float*& row : to) row = arena.allocate_span<float>(padded(count)).data();
    uint32_t* surfaces = arena.allocate_span<uint32_t>(padded(count)).data();
    for (size_t first = 0; first < count; first += kColumnPoints) {
        const SixteenPoints points(grid.points, first, count, grid.ascending);
        float room[kColumnPoints];
        for (size_t c = 0; c < columns.size(); ++c)
            std::memcpy(to[c] + first, points.at(*columns[c], room), sizeof(room));
        uint32_t rows[kColumnPoints];
        std::memcpy(surfaces + first, points.at(surface, rows), sizeof(rows));
    }
    for (size_t c = 0; c < columns.size(); ++c) *columns[c] = to[c];
    surface = surfaces;
}

}  // namespace

void LightRecords::find_points(Grid& grid) {
    StageScope stage(Stage::Lights);
    LightPoints& at = *grid.memory.arena.allocate_span<LightPoints>(1).data();
    at = {};
    at.count = grid.count();
    for (size_t k = 0; k < 3; ++k) {
        at.P[k] = grid.columns[kColP + k];
        at.N[k] = grid.columns[kColN + k];
        at.accel[k] = grid.hits.P[k];
        at.error[k] = grid.hits.P_error[k];
        at.Ng[k] = grid.hits.Ng[k];
    }
    at.surface = grid.hits.instance;
    const float** columns[] = {&at.accel[0], &at.accel[1], &at.accel[2], &at.error[0], &at.error[1],
                               &at.error[2], &at.Ng[0],    &at.Ng[1],    &at.Ng[2]};
    // From the first of a vector on, columns of hits are columns of the points.
    if (grid.dense && grid.points.front() % jit::kMaxLanes == 0) {
        for (const float** column : columns) *column += grid.points[0];
        at.surface += grid.points[0];
    } else {
        of_points(grid, columns, at.surface);
    }
    at.normals = grid.normals.data();
    at.rng = grid.columns[kColRng];
    if (draws_samples_ || chooses(*grid.look)) {
        std::span<raytrace::SampleSeries> series =
            grid.memory.arena.allocate_span<raytrace::SampleSeries>(at.count);
        for (size_t i = 0; i < at.count; ++i)
            series[i] = series_of(grid.hits, grid.points[i], frame_.seed);
        at.series = series.data();
    }
    at.own = true;
    std::span<float> zeros = grid.memory.arena.allocate_span<float>(padded(at.count));
    std::fill(zeros.begin(), zeros.end(), 0.0f);
    at.zeros = zeros.data();
    grid.lit_points = &at;
}

void LightRecords::run(Grid& grid) {
    StageScope stage(Stage::Lights);
    if (!grid.lit_points) find_points(grid);
    grid.record_sets[0] = make_records(grid, *grid.lit_points);
}

bool LightRecords::sends_noted_rays(const Grid& grid) const {
    return grid.look->lowered.uses_lights && std::ranges::any_of(sending_, [&](size_t l) {
               return kinora::sends_noted_rays(look_of_light(frame_, l), grid);
           });
}

void LightRecords::note_rays(Grid& grid, RayNotes& notes) {
    StageScope stage(Stage::Lights);
    grid.notes = &notes;
    const LightPoints& at = *grid.lit_points;
    const Sphere lit = sphere_about(at.P, at.count);
    const Making making{grid, at, {}, {}};
    kernels_.run_noting(grid, [&] {
        for (size_t l : sending_) {
            if (is_dark(grid, l, lit)) continue;
            LitGrid of_light(making, l);
            prepare(making, l, of_light, nullptr);
            kernels_.run_in_the_dark(of_light);
        }
    });
}

bool LightRecords::is_dark(const Grid& grid, size_t l, const Sphere& points) const {
    const uint32_t only = frame_.insight.only_light;
    const bool seen = bindings_.binding(grid.look->index, l).seen;
    // Emission ends with the rays that would find it: it is the first bounce of indirect light.
    if (const AreaLight* area = area_lights_.find(l);
        area && area->emits &&
        is_too_deep(row_of(RayKind::Indirect), grid, look_of_light(frame_, l)))
        return true;
    return (only != kNone && l != only) || !seen || !reaches(reaches_[l], points);
}

jit::RecordSet LightRecords::make_records(Grid& grid, const LightPoints& at) {
    Arena& arena = grid.memory.arena;
    const bool chosen = chooses(*grid.look);
    const Lights& lights = chosen ? others_ : all_lights_;
    Making making{grid, at, arena.allocate_span<jit::Record>(lights.records),
                  arena.allocate_span<SentLight>(lights.records)};
    const Sphere lit = sphere_about(at.P, at.count);
    // At other points, and within volumes, handles count all lights.
    const bool leaves_out = at.own && !all_ && grid.look->kind == ShaderInstanceKind::Surface;
    for (size_t l : leaves_out ? lights.present : lights.every) {
        const bool dark = is_dark(grid, l, lit);
        if (dark && leaves_out) continue;
        making.light_begin = making.record_count;
        if (dark)
            dark_records(making, l);
        else
            make_records(making, l);
    }
    if (chosen)
        for (const LampGroup& group : choice_.groups()) chosen_records(making, group);
    shadow(making);
    return {int32_t(making.record_count), making.records.data()};
}

void LightRecords::dark_records(Making& making, size_t l) const {
    const LightBinding& binding = bindings_.binding(making.grid.look->index, l);
    for (const LightOutputs& statement : bindings_.statements(l))
        dark_records(making, statement, binding,
                     making.record_count + samples_of(l, statement, making.grid));
}

void LightRecords::dark_records(Making& making, const LightOutputs& statement,
                                const LightBinding& binding, size_t end) const {
    Arena& arena = making.grid.memory.arena;
    std::span<const float*> columns =
        arena.allocate_span<const float*>(rsl::kLightMessages + binding.messages.size());
    std::fill(columns.begin(), columns.end(), making.at.zeros - making.at.first);
    columns[rsl::kLightLamp] = nullptr;
    const float* uniforms =
        record_uniforms(frame_.pose, arena, statement, binding, making.light_begin);
    while (making.record_count < end) {
        making.make_room();
        making.records[making.record_count++] = {columns.data(), uniforms};
    }
}

void LightRecords::shadow(const Making& making) const {
    Grid& grid = making.grid;
    if (!grid.shadows) return;
    std::span<const SentLight> sent = making.sent.first(making.sent_count);
    Arena& arena = grid.memory.arena;
    if (making.at.own) drop_behind(seen_points(grid), arena, sent);
    // Lights that are chosen are weak where they count most.
    if (!chooses(*grid.look))
        drop_weak(float(frame_.quality.weak_lights), making.at.count, arena, sent);
    for (const SentLight& light : sent)
        if (light.casts) grid.shadows->cast(grid, making.at, light);
}

LightRecords::LitGrid::LitGrid(const Making& making, size_t light)
    : Grid(making.grid.frame, making.grid.memory, making.grid.hits,
           making.grid.points.subspan(making.at.first, making.at.count),
           &look_of_light(making.grid.frame, light)) {}

void LightRecords::prepare(const Making& making, size_t l, Grid& lit, LightAnswer* answer) const {
    Grid& grid = making.grid;
    const LightPoints& at = making.at;
    const ShaderInstance& look = *lit.look;
    Arena& arena = grid.memory.arena;
    lit.depth = grid.depth;
    lit.ray = grid.ray;
    lit.lamp_samples = uint32_t(samples_at(
        grid.ray, int(light_samples(frame_, l, sends_indirect_ || gathers_indirect(grid)))));
    lit.shadows = grid.shadows;
    lit.answer = answer;
    if (answer) lit.series = at.series;
    lit.surface = grid.look->kind == ShaderInstanceKind::Surface ? grid.look : nullptr;
    lit.lit = &grid;
    lit.lit_first = at.first;
    lit.rays = accounts_of(grid, at);
    if (at.own) lit.notes = grid.notes;
    lit.record_sets = grid.record_sets;
    if (!look.lowered.gathers.empty()) {  // its own, not those of the surface's turns
        lit.record_sets = arena.allocate_span<jit::RecordSet>(kRecordSets);
        std::fill(lit.record_sets.begin(), lit.record_sets.end(), jit::RecordSet{});
    }
    lit.columns = light_columns(look, frame_.pose, frame_.lights.lights[l], at, arena);
    if (look.lowered.draws_random) lit.note_random();
}

std::span<float*> LightRecords::run_kernel(const Making& making, size_t l, Grid& lit,
                                           LightAnswer* answer) {
    prepare(making, l, lit, answer);
    if (lit.notes) lit.notes->answer(lit);
    making.grid.memory.counters.light_points += making.at.count;
    return kernels_.run(lit.look->full, lit);
}

void LightRecords::make_records(Making& making, size_t l) {
    if (bindings_.statements(l)[0].sampled) return sampled_records(making, l);
    area_lights_.find(l) ? area_records(making, l) : plain_records(making, l);
}

void LightRecords::plain_records(Making& making, size_t l) {
    LitGrid lit(making, l);
    std::span<float*> out = run_kernel(making, l, lit, nullptr);
    const LightBinding& binding = bindings_.binding(making.grid.look->index, l);
    for (const LightOutputs& statement : bindings_.statements(l))
        if (statement.spread >= 0)
            cone_records(making, l, statement, lit, out);
        else
            make_record(making, statement, binding, binding.messages, out, false, nullptr);
}

namespace {

bool reads_sent_L(const ShaderInstance& look) {
    return std::ranges::any_of(look.full.columns,
                               [](uint16_t c) { return c >= kColSentL && c < kColSentL + 3; });
}

// What the kernel gives for light that comes along a sample of a cone.
std::span<float*> run_along(KernelRunner& kernels, Grid& lit, const ConeSamples& cone, size_t s) {
    const size_t rows = padded(lit.count());
    for (size_t c = 0; c < 3; ++c) {
        float* const L = lit.memory.arena.allocate_span<float>(rows).data();
        for (size_t i = 0; i < rows; ++i) L[i] = -cone.row(s, c)[i];
        lit.columns[kColSentL + c] = L;
    }
    lit.memory.counters.light_points += lit.count();
    return kernels.run(lit.look->full, lit);
}

}  // namespace

void LightRecords::cone_records(Making& making, size_t l, const LightOutputs& statement, Grid& lit,
                                std::span<float* const> out) const {
    const LightPoints& at = making.at;
    Arena& arena = making.grid.memory.arena;
    const LightBinding& binding = bindings_.binding(making.grid.look->index, l);
    const size_t samples = samples_of(l, statement, making.grid),
                 end = making.record_count + samples;
    const float* angle = out[size_t(statement.spread)];
    const bool wide =
        statement.L[0] >= 0 && std::any_of(angle, angle + at.count, [](float a) { return a != 0; });
    if (wide)
        making.grid.note_random();
    else
        make_record(making, statement, binding, binding.messages, out, false, nullptr);
    std::span<float*> rows = arena.allocate_span<float*>(out.size());
    const bool anew = wide && reads_sent_L(*lit.look);
    SkyCones cones{at.count,         {}, angle, at.series, raytrace::hash(uint32_t(l), frame_.seed),
                   uint32_t(samples)};
    for (size_t c = 0; wide && c < 3; ++c) cones.axis[c] = out[size_t(statement.L[c])];
    for (uint32_t first = 0; wide && first < samples; first += ConeSamples::kAtOnce) {
        ConeSamples cone(cones, padded(at.count), arena);
        cone.find(first);
        for (size_t s = 0; s < std::min<size_t>(ConeSamples::kAtOnce, samples - first); ++s) {
            std::span<float* const> sent = out;
            if (anew) sent = run_along(kernels_, lit, cone, s);
            std::copy(sent.begin(), sent.end(), rows.begin());
            for (size_t c = 0; c < 3; ++c) {
                rows[size_t(statement.L[c])] = cone.row(s, c);
                if (statement.Cl[c] < 0) continue;
                float* const share = arena.allocate_span<float>(padded(at.count)).data();
                const float* whole = sent[size_t(statement.Cl[c])];
                for (size_t i = 0; i < padded(at.count); ++i) share[i] = whole[i] / float(samples);
                rows[size_t(statement.Cl[c])] = share;
            }
            make_record(making, statement, binding, binding.messages, rows, true, nullptr);
        }
    }
    // Records were counted before: those without light are dark.
    if (making.record_count < end) dark_records(making, statement, binding, end);
}

namespace {

// Cl as it is before its shadows.
const float* copy_of(const float* column, size_t count, Arena& arena) {
    std::span<float> copy = arena.allocate_span<float>(count);
    std::copy_n(column, count, copy.begin());
    return copy.data();
}

SentLight sent_light(const LightOutputs& statement, std::span<float* const> out,
                     const LightSamples* samples) {
    SentLight sent = {};
    sent.casts = statement.casts_shadow;
    sent.solar = statement.kind == rsl::kLightSolar;
    sent.lit = statement.lit < 0 ? nullptr : out[size_t(statement.lit)];
    sent.samples = samples;
    for (size_t k = 0; k < 3; ++k) {
        sent.L[k] = out[size_t(statement.sampled ? statement.end[k] : statement.L[k])];
        sent.Cl[k] = statement.Cl[k] < 0 ? nullptr : out[size_t(statement.Cl[k])];
    }
    return sent;
}

}  // namespace

void LightRecords::make_record(Making& making, const LightOutputs& statement,
                               const LightBinding& binding, std::span<const int> messages,
                               std::span<float* const> out, bool sample,
                               const LightSamples* samples) const {
    const LightPoints& at = making.at;
    Arena& arena = making.grid.memory.arena;
    std::span<const float*> columns =
        arena.allocate_span<const float*>(rsl::kLightMessages + messages.size());
    std::fill(columns.begin(), columns.end(), at.zeros);
    auto set = [&](size_t column, int output) {
        if (output >= 0) columns[column] = out[size_t(output)];
    };
    for (size_t k = 0; k < 3; ++k) {
        set(rsl::kLightL + k, statement.L[k]);
        set(rsl::kLightCl + k, statement.Cl[k]);
        set(rsl::kLightOl + k, statement.Ol[k]);
    }
    set(rsl::kLightDensity, statement.density);
    columns[rsl::kLightLamp] = nullptr;
    set(rsl::kLightLamp, statement.lamp);
    const bool bare = making.grid.look->lowered.reads_bare_light ||
                      (frame_.layers_read_bare_light && making.grid.depth == 0);
    for (size_t k = 0; k < 3 && bare; ++k)
        columns[rsl::kLightBare + k] = copy_of(columns[rsl::kLightCl + k], padded(at.count), arena);
    if (statement.lit < 0) columns[rsl::kLightLit] = ones_column(arena, at.count);
    set(rsl::kLightLit, statement.lit);
    for (size_t m = 0; m < messages.size(); ++m) set(rsl::kLightMessages + m, messages[m]);
    if (statement.kind != rsl::kLightAmbient && statement.L[0] >= 0) {
        SentLight& sent = making.sent[making.sent_count];
        sent = sent_light(statement, out, samples);
        const bool shines = sent.Cl[0] && sent.Cl[1] && sent.Cl[2];
        if (shines && sample)
            shadow_sample(making.grid, at, sent);
        else
            making.sent_count += shines;
    }
    // Columns are read at the grid's point, so those of a part of it start before it.
    for (const float*& column : columns)
        if (column) column -= at.first;
    making.make_room();
    making.records[making.record_count++] = {
        columns.data(),
        record_uniforms(frame_.pose, arena, statement, binding, making.light_begin)};
}

// Lights with sample methods send more than anyone counted.
void LightRecords::Making::make_room() {
    constexpr size_t kMoreRecords = 16;
    if (record_count < records.size()) return;
    std::span<jit::Record> more =
        grid.memory.arena.allocate_span<jit::Record>(2 * records.size() + kMoreRecords);
    std::copy(records.begin(), records.end(), more.begin());
    records = more;
}

}  // namespace kinora
