// runtime/picture/shading/lighting/chosen_records.cpp: records of lights that are chosen for each
// point: at every point such a record is another light, with its share of the light of all.
//
// The kernel of each light runs at the points that chose it, and its outputs are scattered to the
// records. What is drawn of a pixel's sequence is one number for all lights of a point, so that the
// samples of a pixel choose at even steps together.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/sampling.h"
#include "runtime/picture/shading/lighting/light_records.h"
#include "runtime/scene/kernels/columns.h"

namespace kinora {

namespace {

// A light of a group that a point has chosen.
struct ChosenPair {
    uint32_t lamp;           // by its place in the group
    uint32_t point, record;  // of those that are made
    float weight;
};

// Rows of a record that is made of many lights' outputs; messages follow.
enum ChosenRow : size_t {
    kRowL = 0,
    kRowCl = 3,
    kRowOl = 6,
    kRowLit = 9,
    kRowLamp = 10,
    kRowMessages = 11
};

// The rows of all records, beside each other.
struct ChosenRows {
    float* first;
    size_t width, points;

    size_t place(const ChosenPair& pair) const { return pair.record * width * points + pair.point; }
    float* row(size_t record, size_t number) const {
        return first + (record * width + number) * points;
    }
};

ChosenRows take_rows(size_t records, size_t width, size_t points, Arena& arena) {
    std::span<float> all = arena.allocate_span<float>(records * width * padded(points));
    std::fill(all.begin(), all.end(), 0.0f);
    return {all.data(), width, padded(points)};
}

// In the order of the lamps, so that each kernel runs once.
std::span<const ChosenPair> sort_by_lamp(std::span<ChosenPair> pairs, size_t lamps, Arena& arena) {
    auto key = [](const ChosenPair& pair) { return uint64_t(pair.lamp) << 32 | pair.point; };
    if (lamps > pairs.size()) {
        std::ranges::sort(pairs, {}, key);
        return pairs;
    }
    std::span<uint32_t> next = arena.allocate_span<uint32_t>(lamps + 1);
    std::fill(next.begin(), next.end(), 0u);
    for (const ChosenPair& pair : pairs) ++next[pair.lamp + 1];
    for (size_t l = 0; l < lamps; ++l) next[l + 1] += next[l];
    std::span<ChosenPair> sorted = arena.allocate_span<ChosenPair>(pairs.size());
    for (const ChosenPair& pair : pairs) sorted[next[pair.lamp]++] = pair;
    return sorted;
}

// From `first` on, sixteen points to be lit.
LampPoints points_from(const LightPoints& at, const float* const looks[3], size_t first,
                       uint32_t who) {
    LampPoints points;
    points.count = std::min(at.count - first, kLampPoints);
    for (size_t p = 0; p < points.count; ++p) {
        const size_t i = first + p;
        for (size_t k = 0; k < 3; ++k) {
            points.P[k][p] = at.P[k][i];
            points.side[k][p] = looks[k][i];
        }
        const raytrace::SampleSeries series = raytrace::series_of(at.series[i], who);
        const auto start = float(raytrace::stratified_sample(series.part, series.seed).x);
        points.start[p] = std::min(start, std::nextafter(1.0f, 0.0f));
    }
    return points;
}

std::span<const ChosenPair> choose_lamps(const LampGroup& group, const LightPoints& at,
                                         const float* const looks[3], size_t wanted, uint32_t who,
                                         Arena& arena) {
    std::span<ChosenPair> pairs = arena.allocate_span<ChosenPair>(at.count * wanted);
    std::span<ChosenLamp> chosen = arena.allocate_span<ChosenLamp>(kLampPoints * wanted);
    size_t used = 0;
    for (size_t first = 0; first < at.count; first += kLampPoints) {
        const LampPoints points = points_from(at, looks, first, who);
        uint32_t records[kLampPoints] = {};  // that each point has
        const size_t count = group.tree.choose(points, wanted, arena, chosen);
        for (const ChosenLamp& lamp : chosen.first(count))
            pairs[used++] = {lamp.lamp, uint32_t(first) + lamp.point, records[lamp.point]++,
                             lamp.weight};
    }
    return sort_by_lamp(pairs.first(used), group.lights.size(), arena);
}

// Columns that a light's kernel reads, of the points that chose it.
std::span<float*> gather_columns(const ShaderInstance& look, vec3 origin, const LightPoints& at,
                                 std::span<const ChosenPair> pairs, Arena& arena) {
    std::span<float*> columns = arena.allocate_span<float*>(look.column_count);
    std::fill(columns.begin(), columns.end(), nullptr);
    struct Source {
        uint16_t column;
        const float* const* rows;
    };
    const Source sources[] = {{kColPs, at.P}, {kColNs, at.N}, {kColN, at.N}};
    for (uint16_t column : look.full.columns) {
        if (columns[column]) continue;
        const float* from = nullptr;
        for (const Source& source : sources)
            if (column >= source.column && column < source.column + 3)
                from = source.rows[column - source.column];
        const bool is_origin = column >= kColP && column < kColP + 3;
        const float fixed = is_origin ? origin[column - kColP] : 0.0f;
        float* const to = columns[column] = arena.allocate_span<float>(padded(pairs.size())).data();
        for (size_t k = 0; k < padded(pairs.size()); ++k)
            to[k] = from ? from[pairs[std::min(k, pairs.size() - 1)].point] : fixed;
    }
    return columns;
}

// A kernel's outputs to the records of the points that chose its light.
void scatter(const LightOutputs& statement, std::span<const int> messages,
             std::span<float* const> out, std::span<const ChosenPair> pairs, const ChosenRows& rows,
             Arena& arena) {
    std::span<size_t> places = arena.allocate_span<size_t>(pairs.size());
    for (size_t k = 0; k < pairs.size(); ++k) places[k] = rows.place(pairs[k]);
    auto put = [&](size_t row, int output) {
        float* const to = rows.row(0, row);
        const float* from = output < 0 ? nullptr : out[size_t(output)];
        for (size_t k = 0; from && k < pairs.size(); ++k) to[places[k]] = from[k];
    };
    for (size_t c = 0; c < 3; ++c) {
        put(kRowL + c, statement.L[c]);
        put(kRowOl + c, statement.Ol[c]);
        float* const Cl = statement.Cl[c] < 0 ? nullptr : out[size_t(statement.Cl[c])];
        for (size_t k = 0; Cl && k < pairs.size(); ++k) Cl[k] *= pairs[k].weight;
        put(kRowCl + c, statement.Cl[c]);
    }
    put(kRowLit, statement.lit);
    float* const lit = rows.row(0, kRowLit);  // everywhere, where it is no output
    for (size_t k = 0; statement.lit < 0 && k < pairs.size(); ++k)
        lit[places[k]] = jit::float_of(1);
    for (size_t m = 0; m < messages.size(); ++m) put(kRowMessages + m, messages[m]);
}

// What runs a light's kernel at points of a grid.
struct ChosenRun {
    const ShadingFrame& frame;
    KernelRunner& kernels;
    Grid& grid;
    const LightPoints& at;

    void operator()(const LightSource& light, const LightOutputs& statement,
                    std::span<const int> messages, std::span<const ChosenPair> pairs,
                    const ChosenRows& rows) const {
        const ShaderInstance& look = *frame.shaders.shader_instances[light.look];
        Arena& arena = grid.memory.arena;
        const Arena::Mark mark = arena.mark();
        std::span<uint32_t> points = arena.allocate_span<uint32_t>(pairs.size());
        for (size_t k = 0; k < pairs.size(); ++k)
            points[k] = grid.points[at.first + pairs[k].point];
        Grid lit(frame, grid.memory, grid.hits, points, &look);
        lit.depth = grid.depth;
        lit.ray = grid.ray;
        lit.record_sets = grid.record_sets;
        const vec3 origin(frame.pose.view.camera_from_world *
                          frame.pose.nodes[light.node].world[3]);
        lit.columns = gather_columns(look, origin, at, pairs, arena);
        grid.memory.counters.light_points += pairs.size();
        scatter(statement, messages, kernels.run(look.full, lit), pairs, rows, arena);
        arena.release(mark);
    }
};

// Rows as outputs of a statement.
LightOutputs statement_of_rows(const LightOutputs& like) {
    LightOutputs statement = like;
    for (int k = 0; k < 3; ++k) {
        statement.L[k] = int(kRowL) + k;
        statement.Cl[k] = int(kRowCl) + k;
        statement.Ol[k] = int(kRowOl) + k;
    }
    statement.lit = int(kRowLit);
    statement.lamp = int(kRowLamp);
    return statement;
}

}  // namespace

bool LightRecords::chooses(const ShaderInstance& look) const {
    return !all_ && frame_.insight.only_light == kNone && choice_.serves(look);
}

void LightRecords::chosen_records(Making& making, const LampGroup& group) {
    const LightPoints& at = making.at;
    Arena& arena = making.grid.memory.arena;
    const LightBinding& binding = bindings_.binding(making.grid.look->index, group.lights[0]);
    if (!binding.seen) return;
    making.grid.note_random();
    float* looks[3];
    for (float*& row : looks) row = arena.allocate_span<float>(padded(at.count)).data();
    if (at.own)
        find_looks(seen_points(making.grid), arena, looks);
    else  // nobody knows the normal there
        for (float* row : looks) std::fill_n(row, at.count, 0.0f);
    const uint32_t who = raytrace::hash(group.lights[0], frame_.seed);
    std::span<const ChosenPair> pairs = choose_lamps(group, at, looks, choice_.count(), who, arena);
    uint32_t records = 0;
    for (const ChosenPair& pair : pairs) records = std::max(records, pair.record + 1);
    const size_t messages = binding.messages.size();
    const ChosenRows rows = take_rows(records, kRowMessages + messages, at.count, arena);
    const ChosenRun run{frame_, kernels_, making.grid, at};
    for (size_t begin = 0, end; begin < pairs.size(); begin = end) {
        for (end = begin + 1; end < pairs.size() && pairs[end].lamp == pairs[begin].lamp;) ++end;
        const uint32_t light = group.lights[pairs[begin].lamp];
        for (const ChosenPair& pair : pairs.subspan(begin, end - begin))
            rows.row(pair.record, kRowLamp)[pair.point] = jit::float_of(int32_t(light) + 1);
        run(frame_.lights.lights[light], bindings_.statements(light)[0],
            bindings_.binding(making.grid.look->index, light).messages,
            pairs.subspan(begin, end - begin), rows);
    }
    const LightOutputs statement = statement_of_rows(bindings_.statements(group.lights[0])[0]);
    std::span<int> message_rows = arena.allocate_span<int>(messages);
    for (size_t m = 0; m < messages; ++m) message_rows[m] = int(kRowMessages + m);
    for (uint32_t r = 0; r < records; ++r) {
        std::span<float*> of = arena.allocate_span<float*>(rows.width);
        for (size_t k = 0; k < rows.width; ++k) of[k] = rows.row(r, k);
        make_record(making, statement, binding, message_rows, of, false, nullptr);
    }
}

}  // namespace kinora
