// runtime/scene/kernels/kernel_probe.h: a hand on all launches of point kernels, to measure them.
#pragma once

#include "jit/ir/kernel_call.h"

namespace kinora {

// Runs the launches of BoundKernel::run in its place, on the thread that asks.
class KernelProbe {
  public:
    virtual ~KernelProbe() = default;
    virtual void run(const jit::KernelCall& call) = 0;
};

// Of all kernels, until the next call; null: none. While no kernel runs.
void probe_kernels(KernelProbe* probe);

}  // namespace kinora
