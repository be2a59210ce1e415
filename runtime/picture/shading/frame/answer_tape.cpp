// runtime/picture/shading/frame/answer_tape.cpp: answers kept and found again in their order.
#include "runtime/picture/shading/frame/answer_tape.h"

#include <algorithm>

namespace kinora {

namespace {

// Marches call for light thousands of times at each point: a thread keeps no more than this.
constexpr size_t kMostFloats = size_t(64) << 20 >> 2;

}  // namespace

bool AnswerTape::is_full() const {
    return floats_ > kMostFloats;
}

void AnswerTape::start() {
    arena_.reset();
    answers_.clear();
    next_ = floats_ = 0;
}

void AnswerTape::keep_numbers(rsl::Service service, const jit::ServiceCall& call, size_t rows) {
    if (is_full()) return;
    const size_t count = rows * jit::kMaxLanes;
    std::span<float> kept = arena_.allocate_span<float>(count);
    std::copy_n(call.results, count, kept.begin());
    floats_ += count;
    answers_.push_back({service, call.first, kept.data()});
}

void AnswerTape::keep_records(rsl::Service service, const jit::ServiceCall& call, int32_t handle,
                              const jit::RecordSet& set, size_t uniforms, size_t columns,
                              std::span<const bool> colors) {
    if (is_full()) return;
    const auto records = size_t(set.count);
    std::span<jit::Record> kept = arena_.allocate_span<jit::Record>(records);
    for (size_t r = 0; r < records; ++r) {
        std::span<const float*> rows = arena_.allocate_span<const float*>(columns);
        float* const values = arena_.allocate_span<float>(columns * jit::kMaxLanes).data();
        for (size_t c = 0; c < columns; ++c) {
            rows[c] = nullptr;
            if (!set.records[r].columns[c]) continue;
            float* const row = values + c * jit::kMaxLanes;
            std::copy_n(set.records[r].columns[c] + call.first, jit::kMaxLanes, row);
            rows[c] = row - call.first;
        }
        std::span<float> numbers = arena_.allocate_span<float>(uniforms);
        if (uniforms > 0) std::copy_n(set.records[r].uniforms, uniforms, numbers.begin());
        kept[r] = {rows.data(), numbers.data()};
    }
    std::span<bool> found = arena_.allocate_span<bool>(colors.size());
    std::ranges::copy(colors, found.begin());
    floats_ += records * (columns * jit::kMaxLanes + uniforms);
    answers_.push_back({service,
                        call.first,
                        nullptr,
                        handle,
                        {set.count, kept.data()},
                        colors.empty() ? nullptr : found.data()});
}

const AnswerTape::Answer* AnswerTape::find(rsl::Service service, const jit::ServiceCall& call) {
    for (size_t at = next_; at < answers_.size(); ++at) {
        const Answer& answer = answers_[at];
        if (answer.first > call.first) return nullptr;  // groups run one behind the other
        if (answer.service != service || answer.first != call.first) continue;
        next_ = at + 1;
        return &answer;
    }
    return nullptr;
}

}  // namespace kinora
