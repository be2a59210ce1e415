// runtime/picture/lights/light_samples.cpp: what kernels of lights with sample methods ask and
// answer.
#include "runtime/picture/lights/light_samples.h"

#include <algorithm>

namespace kinora {

namespace {

// Rows of lightsample's arguments.
enum SampleArgument { kD = 0, kDistance = 3, kCl = 4, kPdf = 7, kCount = 8 };

}  // namespace

LightAnswer::LightAnswer(const LightQuestion& question, size_t points, Arena& arena)
    : question_(question), arena_(arena), counts_(arena.allocate_span<float>(jit::padded(points))) {
    std::fill(counts_.begin(), counts_.end(), 0.0f);
}

void LightAnswer::tell(const jit::ServiceCall& call) const {
    const bool evaluates = question_.wish == rsl::SampleWish::Evaluate;
    float* to = call.results;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        const size_t point = std::min(size_t(call.first + lane), counts_.size() - 1);
        to[lane] = jit::float_of(int32_t(question_.wish));
        for (int k = 0; k < 3; ++k)
            to[(1 + k) * jit::kMaxLanes + lane] = evaluates ? question_.along[k][point] : 0.0f;
        to[4 * jit::kMaxLanes + lane] = jit::float_of(question_.domain);
    }
}

LightSampleRows* LightAnswer::add_rows() {
    auto* rows = arena_.allocate_span<LightSampleRows>(1).data();
    *rows = {};
    auto take = [&] {
        std::span<float> row = arena_.allocate_span<float>(counts_.size());
        std::fill(row.begin(), row.end(), 0.0f);
        return row.data();
    };
    for (float*& row : rows->D) row = take();
    for (float*& row : rows->Cl) row = take();
    rows->distance = take();
    rows->pdf = take();
    return rows;
}

void LightAnswer::take(const jit::ServiceCall& call) {
    if (call.first != group_) {
        group_ = call.first;
        next_ = &first_;
    }
    if (!*next_) *next_ = add_rows();
    LightSampleRows& rows = **next_;
    next_ = &rows.next;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        const size_t point = size_t(call.first + lane);
        if (!(call.mask >> lane & 1) || point >= counts_.size()) continue;
        auto argument = [&](int row) { return call.args[row * jit::kMaxLanes + lane]; };
        for (int k = 0; k < 3; ++k) {
            rows.D[k][point] = argument(kD + k);
            rows.Cl[k][point] = argument(kCl + k);
        }
        rows.distance[point] = argument(kDistance);
        rows.pdf[point] = argument(kPdf);
        counts_[point] = argument(kCount);
    }
}

float sample_weight(float own, float other, float power) {
    if (power == 0 || !(other > 0)) return 1;
    const float share = other / own;
    return 1 / (1 + (power == 1 ? share : share * share));
}

}  // namespace kinora
