// jit/ir/kernel_call.cpp: a launch of a kernel.
#include "jit/ir/kernel_call.h"

#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

constexpr uintptr_t kAlignment = 64;

bool is_aligned(const void* memory) {
    return memory && reinterpret_cast<uintptr_t>(memory) % kAlignment == 0;
}

template <class Row>
bool are_aligned(std::span<Row* const> rows) {
    for (Row* row : rows)
        if (!is_aligned(row)) return false;
    return true;
}

}  // namespace

void KernelCall::run() const {
    CHECK_GT(count, size_t(0));
    CHECK_GE(row_floats, padded(count));
    CHECK_EQ(in.size(), kernel.inputs.size());
    CHECK_EQ(out.size(), kernel.outputs.size());
    CHECK(are_aligned(in) && are_aligned(out));
    CHECK_GE(frame.size(), size_t(kernel.frame_slots));
    CHECK_GE(scratch.size(), kernel.scratch_bytes);
    CHECK(kernel.scratch_bytes == 0 || is_aligned(scratch.data()));
    CHECK_GE(faults.size(), kernel.fault_sites.size());
    CHECK_EQ(services.size(), kernel.services.size());
    kernel.run({.in = in.data(),
                .out = out.data(),
                .frame = frame.data(),
                .scratch = scratch.data(),
                .fault = faults.data(),
                .services = services.data(),
                .record_sets = record_sets.data(),
                .grid = host,
                .count = int32_t(count)});
}

}  // namespace kinora::jit
