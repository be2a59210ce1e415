// runtime/scene/kernels/bound_kernel.h: a compiled shader whose inputs and services are bound,
// ready to run on points from any source.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "jit/compiler.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/base/arena.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/kernels/kernel_host.h"

namespace kinora {

// The numbers of frame-rate inputs.
class FrameNumbers {
  public:
    virtual ~FrameNumbers() = default;
    // Of the frame kernel's input `index`.
    virtual float number(size_t index) const = 0;
};

class BoundKernel;

// What a frame kernel has computed: the numbers that a point kernel reads as broadcasts. Filled by
// BoundKernel::run_frame; one for each frame that is under way.
struct FrameBlock {
    std::vector<float> numbers;
    std::vector<uint8_t> faults;  // a byte a site of the frame kernel

  private:
    friend class BoundKernel;
    Arena arena_{4096};  // rows of kMaxLanes floats for the frame kernel
    std::vector<float*> in_, out_;
    bool ran_ = false;  // to its end, with the numbers of in_
};

// What a point kernel runs on. Rows have padded(count) floats from `first` on.
struct PointLaunch {
    size_t first = 0;  // of the rows' points
    size_t count = 0;  // points, > 0
    const FrameBlock& frame;
    std::span<float* const> columns;  // by Column; those that the kernel reads are not null
    std::span<float* const> out;      // a row an output
    std::span<uint8_t> faults;        // a byte a site
    std::span<const jit::RecordSet> record_sets = {};
    KernelHost& host;
    const std::atomic<int>* stop = nullptr;  // KernelCall::stop
};

// A kernel pair with its inputs and services.
class BoundKernel {
  public:
    // `column_of` gives the column of a point kernel's input; it is asked once for each.
    void bind(jit::KernelPair kernels,
              const std::function<uint16_t(const rsl::KernelKey&)>& column_of);
    // Runs the frame kernel and fills the frame block. Where all numbers are as they were and no
    // service or record is read, the block and the faults stand as they are. No allocation after
    // the first time.
    void run_frame(FrameBlock& block, const FrameNumbers& numbers, KernelHost& host,
                   std::span<const jit::RecordSet> record_sets = {},
                   const std::atomic<int>* stop = nullptr) const;
    // Runs the point kernel; its scratch memory is taken from `arena` and stays taken, as does what
    // services take there.
    void run(const PointLaunch& launch, Arena& arena) const;

    // The faults of the frame kernel, one finding for each source line.
    void report_frame_faults(const FrameBlock& block, Diagnostics& diagnostics) const;

    const jit::Kernel& kernel() const { return *pair.point; }
    bool empty() const { return !pair.point; }

    jit::KernelPair pair;
    std::vector<uint16_t> columns;                         // of the point kernel's inputs
    std::vector<jit::ServiceFn> services, frame_services;  // of both kernels, by slot

  private:
    void size(FrameBlock& block) const;
};

// Rows for all outputs of a kernel.
std::span<float*> take_outputs(const jit::Kernel& kernel, size_t count, Arena& arena);

// One finding for each source line of which faulted(its site's number).
void report_fault(const jit::FaultSite& site, Diagnostics& diagnostics);
template <class F>
void report_faults(const jit::Kernel& kernel, F&& faulted, Diagnostics& diagnostics) {
    for (size_t s = 0; s < kernel.fault_sites.size(); ++s)
        if (faulted(s)) report_fault(kernel.fault_sites[s], diagnostics);
}

}  // namespace kinora
