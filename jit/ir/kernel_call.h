// jit/ir/kernel_call.h: a launch of a kernel: its parts by name, checked before the code runs.
#pragma once

#include <span>

#include "jit/ir/kernel.h"

namespace kinora::jit {

// Floats in a row of so many points.
constexpr size_t padded(size_t count) {
    return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

// What a kernel runs on. Rows and scratch memory are 64-byte aligned.
struct KernelCall {
    const Kernel& kernel;
    size_t count = 0;                       // points, > 0
    std::span<const float* const> in = {};  // a row an input, padded with copies of the last point
    std::span<float* const> out = {};       // a row an output
    size_t row_floats = 0;                  // of each of these rows: padded(count) or more
    std::span<const float> frame = {};      // the frame block
    std::span<std::byte> scratch = {};      // Kernel::scratch_bytes
    std::span<uint8_t> faults = {};         // a byte a site, set where it reports
    std::span<const ServiceFn> services = {};  // by slot
    std::span<const RecordSet> record_sets = {};
    void* host = nullptr;  // what services see
    // Once it is not 0, long loops end early and outputs are worth nothing. Null: never.
    const std::atomic<int>* stop = nullptr;

    // Checks the parts and runs all points.
    void run() const;
};

// A call whose parts were checked, to run as often as they stay as they are.
class CheckedCall {
  public:
    // CHECKs that each part is what the kernel needs.
    explicit CheckedCall(const KernelCall& call);
    void run() const { kernel_->run(args_); }

  private:
    const Kernel* kernel_;
    KernelArgs args_;
};

inline void KernelCall::run() const {
    CheckedCall(*this).run();
}

}  // namespace kinora::jit
