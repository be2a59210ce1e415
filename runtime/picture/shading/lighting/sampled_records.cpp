// runtime/picture/shading/lighting/sampled_records.cpp: records of lights with sample methods:
// their samples at lit points, and what they send from directions that a material has chosen.
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

void LightRecords::sampled_records(Making& making, size_t l) {
    Arena& arena = making.grid.memory.arena;
    LightQuestion question;
    question.domain = domain_of(*making.grid.look);
    LightAnswer answer(question, making.at.count, arena);
    LitGrid lit(making, l);
    std::span<float*> out = run_kernel(making, l, lit, &answer);
    const CountedSamples samples(answer, making.at, making.grid.ray.most_samples, uint32_t(l),
                                 arena);
    keep_counts(making, l, samples.counts());
    for (size_t k = 0; k < samples.most(); ++k) sample_record(making, l, samples, k, out);
}

// Beside each other for all points of the grid: records at other points are made lane by lane.
void LightRecords::keep_counts(Making& making, size_t l, const float* counts) const {
    Grid& grid = making.grid;
    Arena& arena = grid.memory.arena;
    if (grid.sample_counts.empty()) {
        grid.sample_counts = arena.allocate_span<float*>(frame_.lights.lights.size());
        std::fill(grid.sample_counts.begin(), grid.sample_counts.end(), nullptr);
    }
    float*& row = grid.sample_counts[l];
    if (!row) {
        std::span<float> all = arena.allocate_span<float>(padded(grid.count()));
        std::fill(all.begin(), all.end(), 0.0f);
        row = all.data();
    }
    std::copy_n(counts, making.at.count, row + making.at.first);
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

}  // namespace kinora
