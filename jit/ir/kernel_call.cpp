// jit/ir/kernel_call.cpp: a launch of a kernel.
#include "jit/ir/kernel_call.h"

#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

constexpr uintptr_t kAlignment = 64;

bool is_aligned(const void* memory) {
    return memory && reinterpret_cast<uintptr_t>(memory) % kAlignment == 0;
}

// All addresses joined, so that a row costs no branch.
template <class Row>
bool are_aligned(std::span<Row* const> rows) {
    uintptr_t bits = 0;
    bool missing = false;
    for (Row* row : rows) {
        bits |= reinterpret_cast<uintptr_t>(row);
        missing |= !row;
    }
    return !missing && bits % kAlignment == 0;
}

}  // namespace

CheckedCall::CheckedCall(const KernelCall& call)
    : kernel_(&call.kernel),
      args_{.in = call.in.data(),
            .out = call.out.data(),
            .frame = call.frame.data(),
            .scratch = call.scratch.data(),
            .fault = call.faults.data(),
            .services = call.services.data(),
            .record_sets = call.record_sets.data(),
            .grid = call.host,
            .count = int32_t(call.count),
            .stop = call.stop ? call.stop : &kNeverStops} {
    CHECK_GT(call.count, size_t(0));
    CHECK_GE(call.row_floats, padded(call.count));
    CHECK_EQ(call.in.size(), kernel_->inputs.size());
    CHECK_EQ(call.out.size(), kernel_->outputs.size());
    CHECK(are_aligned(call.in) && are_aligned(call.out));
    CHECK_GE(call.frame.size(), size_t(kernel_->frame_slots));
    CHECK_GE(call.scratch.size(), kernel_->scratch_bytes);
    CHECK(kernel_->scratch_bytes == 0 || is_aligned(call.scratch.data()));
    CHECK_GE(call.faults.size(), kernel_->fault_sites.size());
    CHECK_EQ(call.services.size(), kernel_->services.size());
}

}  // namespace kinora::jit
