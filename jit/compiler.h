// jit/compiler.h: from a lowered module to kernels: the passes, a target, the cache.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jit/target.h"

namespace kinora::jit {

// A surface or light as it runs: the frame kernel once per instance and frame (count 1), whose
// outputs, one float each, are the frame block of the point kernel.
struct KernelPair {
    std::shared_ptr<const Kernel> frame;  // null if the frame block is empty
    std::shared_ptr<const Kernel> point;
    double optimize_ms = 0;
    double emit_ms = 0;
    bool cached = false;  // nothing was compiled
};

struct CompileOptions {
    const Target* target = nullptr;  // null: best_target()
    // Filled when not null: (stage, text) pairs "ir", "ir:fold", ..., "asm", for --dump.
    std::vector<std::pair<std::string, std::string>>* dumps = nullptr;
    const SourceFiles* files = nullptr;  // names of the source's lines, for debuggers
    // A cached kernel of the same instructions from other lines is not taken: Kernel::lines counts.
    bool own_lines = false;
};

// Optimises, splits and emits. Kernels are cached by the hash of their final IR and the target
// (process-wide, thread-safe: the first thread to need a kernel compiles it, others wait).
KernelPair compile(Module module, const CompileOptions& options = {});

struct CacheStats {
    size_t kernels = 0;
    size_t code_bytes = 0;
    size_t derivative_values = 0;  // jit/passes/passes.h
    double total_ms = 0;
};
CacheStats cache_stats();
void clear_cache();  // drops kernels nobody holds

}  // namespace kinora::jit
