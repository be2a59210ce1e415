// runtime/picture/shading/lighting/sampled_records.cpp: records of lights with sample methods:
// their samples at lit points, and what they send from directions that a material has chosen; the
// services that ask for records.
//
// Cl of a sample is radiance / (PI x density), density being the number of samples x pdf: the sum
// over the samples is then the light that a point light of Cl would give, for diffuse() and for
// directlighting() alike.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/picture/shading/lighting/chosen_directions.h"
#include "runtime/picture/shading/lighting/counted_samples.h"
#include "runtime/picture/shading/lighting/light_records.h"

namespace kinora {

namespace {

// Shadow rays end a little before the light: a mesh that shows it may lie where its samples do.
constexpr float kShortOf = 0.9999f;
constexpr float kEndless = 1e29f;  // a distance as great means none

// Columns of a sample as a record has them, in the place of a kernel's outputs.
struct SampleColumns {
    explicit SampleColumns(Arena& arena, size_t points) {
        for (auto* rows : {&L, &end, &Cl})
            for (float*& row : *rows) row = arena.allocate_span<float>(points).data();
        density = arena.allocate_span<float>(points).data();
    }
    void set(size_t i, vec3 towards, vec3 light, float dense) {
        for (int k = 0; k < 3; ++k) {
            L[k][i] = towards[k];
            end[k][i] = kShortOf * towards[k];
            Cl[k][i] = light[k];
        }
        density[i] = dense;
    }

    SampleColumnList columns() const {
        return {L[0], L[1], L[2], end[0], end[1], end[2], Cl[0], Cl[1], Cl[2], density};
    }

    float* L[3];
    float* end[3];  // of its shadow ray
    float* Cl[3];
    float* density;
};

// What a sample holds at a point; dark where its numbers mean nothing.
struct PointSample {
    PointSample() = default;
    PointSample(const LightSampleRows& rows, size_t i, float far)
        : Cl(rows.Cl[0][i], rows.Cl[1][i], rows.Cl[2][i]), pdf(rows.pdf[i]) {
        const vec3 D(rows.D[0][i], rows.D[1][i], rows.D[2][i]);
        const float length2 = glm::dot(D, D), distance = rows.distance[i];
        shines = pdf > 0 && length2 > 0 && length2 < kEndless && distance > 0 &&
                 std::isfinite(Cl.x) && std::isfinite(Cl.y) && std::isfinite(Cl.z);
        if (!shines) return;
        L = D * ((distance < kEndless ? distance : far) / std::sqrt(length2));
    }
    vec3 L{0.0f, 0.0f, 1.0f}, Cl{0.0f};
    float pdf = 0;
    bool shines = false;
};

// Both side by side; the statement gets to know their numbers.
std::span<float* const> columns_of(Arena& arena, LightOutputs& statement,
                                   std::span<float* const> out, std::span<float* const> sample) {
    std::span<float*> all = arena.allocate_span<float*>(out.size() + sample.size());
    std::copy(sample.begin(), sample.end(), std::copy(out.begin(), out.end(), all.begin()));
    for (int k = 0; k < 3; ++k) {
        statement.L[k] = int(out.size()) + k;
        statement.end[k] = int(out.size()) + 3 + k;
        statement.Cl[k] = int(out.size()) + 6 + k;
    }
    statement.density = int(out.size()) + 9;
    return all;
}

int32_t domain_of(const ShaderInstance& look) {
    return rsl::intern(look.lowered.light_domain);
}

}  // namespace

namespace {

// Beside each other for all points of the grid: records at other points are made lane by lane.
void keep_counts(Grid& grid, const LightPoints& at, size_t l, const float* counts) {
    Arena& arena = grid.memory.arena;
    if (grid.sample_counts.empty()) {
        grid.sample_counts = arena.allocate_span<float*>(grid.frame.lights.lights.size());
        std::fill(grid.sample_counts.begin(), grid.sample_counts.end(), nullptr);
    }
    float*& row = grid.sample_counts[l];
    if (!row) {
        std::span<float> all = arena.allocate_span<float>(padded(grid.count()));
        std::fill(all.begin(), all.end(), 0.0f);
        row = all.data();
    }
    std::copy_n(counts, at.count, row + at.first);
}

}  // namespace

void LightRecords::sampled_records(Making& making, size_t l) {
    Arena& arena = making.grid.memory.arena;
    LightQuestion question;
    question.domain = domain_of(*making.grid.look);
    LightAnswer answer(question, making.at.count, arena);
    LitGrid lit(making, l);
    std::span<float*> out = run_kernel(making, l, lit, &answer);
    const CountedSamples samples(answer, making.at, making.grid.ray.most_samples, uint32_t(l),
                                 arena);
    keep_counts(making.grid, making.at, l, samples.counts());
    for (size_t k = 0; k < samples.most(); ++k) sample_record(making, l, samples, k, out);
}

void LightRecords::sample_record(Making& making, size_t l, const CountedSamples& samples, size_t k,
                                 std::span<float* const> out) const {
    const size_t points = padded(making.at.count);
    SampleColumns sample(making.grid.memory.arena, points);
    for (size_t i = 0; i < points; ++i) {
        const LightSampleRows* rows = samples.find(k, i);
        const PointSample at = rows ? PointSample(*rows, i, far_) : PointSample();
        const float density = at.shines ? at.pdf * samples.counts()[i] : 0.0f;
        const bool counts_for = density > 0;
        sample.set(i, at.L, counts_for ? at.Cl / (float(kPi) * density) : vec3(0.0f), density);
    }
    add_sample(making, l, out, sample.columns());
}

void LightRecords::add_sample(Making& making, size_t l, std::span<float* const> out,
                              SampleColumnList sample) const {
    LightOutputs statement = bindings_.statements(l)[0];
    const LightBinding& binding = bindings_.binding(making.grid.look->index, l);
    std::span<float* const> columns = columns_of(making.grid.memory.arena, statement, out, sample);
    make_record(making, statement, binding, binding.messages, columns, true, nullptr);
}

// ---- from directions ----------------------------------------------------------------------------

void LightRecords::record_along(Making& making, size_t l, const ChosenDirections& directions) {
    Grid& grid = making.grid;
    LightQuestion question;
    question.wish = rsl::SampleWish::Evaluate;
    question.domain = domain_of(*grid.look);
    std::copy_n(directions.D, 3, question.along);
    const size_t count = making.at.count, points = padded(count);
    LightAnswer answer(question, count, grid.memory.arena);
    LitGrid lit(making, l);
    std::span<float*> out = run_kernel(making, l, lit, &answer);
    if (!answer.first()) return;
    const float* samples = grid.sample_counts.empty() ? nullptr : grid.sample_counts[l];
    SampleColumns sample(grid.memory.arena, points);
    for (size_t i = 0; i < points; ++i) {
        const PointSample at(*answer.first(), i, far_);
        const float own = directions.density[i], power = directions.power[i];
        const bool asks = i < count && own > 0 && at.shines;
        const float lights = samples && asks ? samples[making.at.first + i] * at.pdf : 0.0f;
        sample.set(i, at.L, asks ? at.Cl * sample_weight(own, lights, power) : vec3(0.0f), lights);
    }
    add_sample(making, l, out, sample.columns());
}

// ---- services
// ------------------------------------------------------------------------------------

namespace {

// A part of the grid asks: one lane group at its own points. Records of a group that is done are
// let go, or a marching loop would keep them all. The handle of the call's records.
uint32_t next_handle(Grid& grid, int32_t first) {
    Arena& arena = grid.memory.arena;
    if (grid.record_group != first) {
        if (grid.record_group >= 0) arena.release(grid.record_mark);
        grid.record_mark = arena.mark();
        grid.record_group = first;
        grid.record_calls = 0;
    }
    const uint32_t handle = grid.next_record_set;
    grid.next_record_set = handle + 1 < kGatherSets ? handle + 1 : 1;
    return handle;
}

}  // namespace

int32_t LightRecords::at(Grid& grid, const jit::ServiceCall& call) {
    const uint32_t handle = next_handle(grid, call.first);
    if (++grid.record_calls > kMostLightQuestions) {
        grid.memory.counters.unlit += 1;
        grid.record_sets[handle] = {};
    } else {
        grid.record_sets[handle] = make_records(grid, points_of(grid, call));
    }
    return int32_t(handle);
}

bool LightRecords::notes_directions(const Grid& grid) const {
    return grid.lit_points && grid.look->lowered.lit_by_samples &&
           (!sampling_.empty() || !area_lights_.all().empty());
}

void LightRecords::start_directions(Grid& grid) const {
    constexpr size_t kMostBytes = 16 << 20, kRecordBytes = 64 * sizeof(float);  // with its making
    if (!notes_directions(grid)) return;
    // Few of the lamps on geometry lie along one direction.
    const size_t lamps = sampling_.size() + std::min<size_t>(area_lights_.all().size(), 2);
    const size_t most = kMostBytes / (kRecordBytes * lamps * padded(grid.count()));
    Arena& arena = grid.memory.arena;
    grid.directions =
        new (arena.allocate(sizeof(DirectionNotes))) DirectionNotes(grid.count(), most, arena);
}

void LightRecords::answer_directions(Grid& grid) {
    StageScope stage(Stage::Lights);
    LightPoints at = *grid.lit_points;
    at.own = false;
    for (DirectionNotes::Round& round : grid.directions->rounds())
        round.answer = records_along(grid, at, round.directions);
    grid.directions->rewind();
}

jit::RecordSet LightRecords::records_along(Grid& grid, const LightPoints& at,
                                           const ChosenDirections& directions) {
    Arena& arena = grid.memory.arena;
    Making making{grid, at, arena.allocate_span<jit::Record>(sampling_.size()),
                  arena.allocate_span<SentLight>(1)};
    const Sphere lit = sphere_about(at.P, at.count);
    for (size_t l : sampling_)
        if (bindings_.binding(grid.look->index, l).seen && reaches(reaches_[l], lit))
            record_along(making, l, directions);
    lamps_along(making, directions);
    return {int32_t(making.record_count), making.records.data()};
}

int32_t LightRecords::along(Grid& grid, const jit::ServiceCall& call) {
    const uint32_t handle = next_handle(grid, call.first);
    jit::RecordSet& records = grid.record_sets[handle];
    if (const jit::RecordSet* noted = grid.directions ? grid.directions->find(call) : nullptr) {
        records = *noted;
        return int32_t(handle);
    }
    const bool own = grid.lit_points && asks_at(*grid.lit_points, call);
    const LightPoints at = own ? part_of(*grid.lit_points, call) : points_of(grid, call);
    records = records_along(grid, at, directions_of(call, grid.memory.arena));
    return int32_t(handle);
}

}  // namespace kinora
