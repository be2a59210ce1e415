// runtime/picture/shading/replay_host.cpp: answers of lights and rays kept, and given again in
// part.
#include <algorithm>
#include <bit>

#include "rsl/model/renderer_services.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/light_layers.h"
#include "runtime/picture/shading/rays/gather_records.h"

namespace kinora {

namespace {

using rsl::Service;

// Numbers of a service's answer: so many rows, and which of them are light that rays found.
struct NumberRow {
    Service service;
    size_t rows, light_begin, light_end;
};
constexpr NumberRow kNumbers[] = {
    {Service::trace, 4, 0, 3},     {Service::transmission, 3, 0, 0},
    {Service::occlusion, 7, 4, 7}, {Service::indirectdiffuse, 7, 0, 6},
    {Service::raylimit, 1, 0, 0},
};

const NumberRow& row_of(Service service) {
    return *std::ranges::find(kNumbers, service, &NumberRow::service);
}

const std::vector<GatherResult>& results_of(const Grid& grid, const jit::ServiceCall& call) {
    constexpr int kRequest =
        rsl::service_argument(Service::gather, "request").first * jit::kMaxLanes;
    const int lane = std::countr_zero(call.mask);
    return grid.look->lowered.gathers[size_t(jit::bits_of(call.args[kRequest + lane]))];
}

// The handle is the same in all lanes.
int32_t handle_in(const jit::ServiceCall& call) {
    return jit::bits_of(call.results[0]);
}

}  // namespace

// ---- noting -------------------------------------------------------------------------------------

void TapingHost::keep(Service service, const jit::ServiceCall& call) {
    grid_.tape->keep_numbers(service, call, row_of(service).rows);
}

void TapingHost::keep_lights(Service service, const jit::ServiceCall& call) {
    const int32_t handle = handle_in(call);
    const size_t uniforms = rsl::kLightUniforms + grid_.look->lowered.light_messages.size();
    grid_.tape->keep_records(service, call, handle, grid_.record_sets[size_t(handle)], uniforms,
                             light_columns_of(grid_.look->lowered), {});
}

void TapingHost::trace(const jit::ServiceCall& call) {
    GridHost::trace(call);
    keep(Service::trace, call);
}
void TapingHost::transmission(const jit::ServiceCall& call) {
    GridHost::transmission(call);
    keep(Service::transmission, call);
}
void TapingHost::occlusion(const jit::ServiceCall& call) {
    GridHost::occlusion(call);
    keep(Service::occlusion, call);
}
void TapingHost::indirectdiffuse(const jit::ServiceCall& call) {
    GridHost::indirectdiffuse(call);
    keep(Service::indirectdiffuse, call);
}
void TapingHost::raylimit(const jit::ServiceCall& call) {
    GridHost::raylimit(call);
    keep(Service::raylimit, call);
}
void TapingHost::lights(const jit::ServiceCall& call) {
    GridHost::lights(call);
    keep_lights(Service::lights, call);
}
void TapingHost::samplinglights(const jit::ServiceCall& call) {
    GridHost::samplinglights(call);
    keep_lights(Service::samplinglights, call);
}

// Colours of what was hit, and of maps behind it, are light; an opacity is none.
void TapingHost::gather(const jit::ServiceCall& call) {
    GridHost::gather(call);
    const std::vector<GatherResult>& results = results_of(grid_, call);
    const auto width = size_t(record_width(results));
    Arena& arena = grid_.memory.arena;
    const Arena::Mark mark = arena.mark();
    std::span<bool> colors = arena.allocate_span<bool>(width);
    std::ranges::fill(colors, false);
    size_t at = rsl::kGatherResults;
    for (const GatherResult& result : results) {
        const auto components = size_t(rsl::component_count(result.type));
        const bool light = result.type == rsl::BaseType::Color && result.name != "surface:Oi";
        for (size_t k = 0; k < components; ++k) colors[at++] = light;
    }
    const int32_t handle = handle_in(call);
    grid_.tape->keep_records(Service::gather, call, handle, grid_.record_sets[size_t(handle)], 0,
                             width, colors);
    arena.release(mark);
}

// ---- in part ------------------------------------------------------------------------------------

namespace {

std::span<float> zeros_of(const Grid& grid) {
    std::span<float> zeros = grid.memory.arena.allocate_span<float>(padded(grid.count()));
    std::ranges::fill(zeros, 0.0f);
    return zeros;
}

// Where some of a set is read.
struct ReadPoints {
    std::span<const float> zeros;  // of all points
    size_t begin, end;
};

// A record whose light differs from point to point.
jit::Record record_of_points(const Grid& grid, const jit::Record& record, const LightPart& part,
                             size_t width, const ReadPoints& read) {
    Arena& arena = grid.memory.arena;
    std::span<const float*> columns = arena.allocate_span<const float*>(width);
    std::copy_n(record.columns, width, columns.begin());
    const float* const lamps = record.columns[rsl::kLightLamp];
    for (size_t c : {rsl::kLightCl + 0, rsl::kLightCl + 1, rsl::kLightCl + 2, rsl::kLightLit + 0,
                     rsl::kLightBare + 0, rsl::kLightBare + 1, rsl::kLightBare + 2}) {
        float* const row = arena.allocate_span<float>(padded(grid.count())).data();
        for (size_t i = read.begin; i < read.end; ++i) {
            const int32_t lamp = jit::bits_of(lamps[i]);
            row[i] = lamp > 0 && part.has(size_t(lamp - 1)) ? columns[c][i] : 0.0f;
        }
        columns[c] = row;
    }
    return {columns.data(), record.uniforms};
}

jit::RecordSet part_of_set(const Grid& grid, const jit::RecordSet& set, const LightPart& part,
                           const ReadPoints& read) {
    Arena& arena = grid.memory.arena;
    const size_t width = light_columns_of(grid.look->lowered);
    std::span<jit::Record> records = arena.allocate_span<jit::Record>(size_t(set.count));
    std::span<const float*> dark = arena.allocate_span<const float*>(width);
    std::ranges::fill(dark, read.zeros.data());
    int32_t count = 0;  // those behind the last one of the part are left out
    for (int32_t r = 0; r < set.count; ++r) {
        const jit::Record& record = set.records[r];
        const bool by_point = record.columns[rsl::kLightLamp];
        const bool in_part =
            by_point || part.has(size_t(jit::bits_of(record.uniforms[rsl::kLightNumber])));
        jit::Record& made = records[size_t(r)] = {dark.data(), record.uniforms};
        if (in_part) count = r + 1;
        if (by_point)
            made = record_of_points(grid, record, part, width, read);
        else if (in_part)
            made = record;
        if (!in_part || !part.bare) continue;
        std::span<const float*> columns = arena.allocate_span<const float*>(width);
        std::copy_n(made.columns, width, columns.begin());
        for (size_t k = 0; k < 3; ++k) columns[rsl::kLightCl + k] = columns[rsl::kLightBare + k];
        made.columns = columns.data();
    }
    return {count, records.data()};
}

// What rays hit, and nothing of the light they found.
jit::RecordSet without_colors(const AnswerTape::Answer& answer, const float* zeros, Arena& arena,
                              size_t width) {
    const auto count = size_t(answer.records.count);
    std::span<jit::Record> records = arena.allocate_span<jit::Record>(count);
    for (size_t r = 0; r < count; ++r) {
        std::span<const float*> columns = arena.allocate_span<const float*>(width);
        for (size_t c = 0; c < width; ++c)
            columns[c] = answer.colors[c] ? zeros : answer.records.records[r].columns[c];
        records[r] = {columns.data(), answer.records.records[r].uniforms};
    }
    return {answer.records.count, records.data()};
}

}  // namespace

size_t light_columns_of(const rsl::LoweredShader& look) {
    size_t columns = rsl::kLightMessages;
    for (int components : look.light_message_components) columns += size_t(components);
    return columns;
}

jit::RecordSet records_of_part(const Grid& grid, const jit::RecordSet& set, const LightPart& part) {
    return part_of_set(grid, set, part, {zeros_of(grid), 0, grid.count()});
}

ReplayHost::ReplayHost(Grid& grid, const GridServices& services, const LightPart& part)
    : RelitHost(grid, services), part_(part), zeros_(zeros_of(grid)) {
    grid.tape->rewind();
}

bool ReplayHost::replay(Service service, const jit::ServiceCall& call) {
    const AnswerTape::Answer* answer = grid_.tape->find(service, call);
    if (!answer) return false;
    if (answer->numbers) {
        const NumberRow& row = row_of(service);
        std::copy_n(answer->numbers, row.rows * jit::kMaxLanes, call.results);
        for (size_t r = row.light_begin; r < row.light_end && !part_.rays; ++r)
            std::fill_n(call.results + r * jit::kMaxLanes, jit::kMaxLanes, 0.0f);
        return true;
    }
    if (group_ < 0) mark_ = grid_.memory.arena.mark();
    if (group_ != call.first) grid_.memory.arena.release(mark_);  // that group is done
    group_ = call.first;
    std::fill_n(call.results, jit::kMaxLanes, jit::float_of(answer->handle));
    jit::RecordSet& set = grid_.record_sets[size_t(answer->handle)];
    set = answer->records;
    const auto first = size_t(call.first);
    const ReadPoints read{zeros_, first, std::min(first + jit::kMaxLanes, grid_.count())};
    if (!answer->colors)
        set = part_of_set(grid_, set, part_, read);
    else if (!part_.rays)
        set = without_colors(*answer, zeros_.data(), grid_.memory.arena,
                             size_t(record_width(results_of(grid_, call))));
    return true;
}

void ReplayHost::trace(const jit::ServiceCall& call) {
    if (!replay(Service::trace, call)) RelitHost::trace(call);
}
void ReplayHost::transmission(const jit::ServiceCall& call) {
    if (!replay(Service::transmission, call)) RelitHost::transmission(call);
}
void ReplayHost::occlusion(const jit::ServiceCall& call) {
    if (!replay(Service::occlusion, call)) RelitHost::occlusion(call);
}
void ReplayHost::indirectdiffuse(const jit::ServiceCall& call) {
    if (!replay(Service::indirectdiffuse, call)) RelitHost::indirectdiffuse(call);
}
void ReplayHost::gather(const jit::ServiceCall& call) {
    if (!replay(Service::gather, call)) RelitHost::gather(call);
}
void ReplayHost::raylimit(const jit::ServiceCall& call) {
    if (!replay(Service::raylimit, call)) RelitHost::raylimit(call);
}
void ReplayHost::lights(const jit::ServiceCall& call) {
    if (!replay(Service::lights, call)) RelitHost::gather(call);
}
void ReplayHost::samplinglights(const jit::ServiceCall& call) {
    if (!replay(Service::samplinglights, call)) RelitHost::gather(call);
}

}  // namespace kinora
