// jit/compiler.h: from a lowered module to kernels: the passes, the cache, the dumps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "jit/ir.h"
#include "jit/target.h"

namespace kinora::jit {

// The passes, one file each, in the order optimize() runs them; hoist() comes before schedule(),
// dce again between. Each takes a verified module and leaves a verified one with the same meaning.
void differentiate(Module& module);  // Du, Dv -> dual numbers for the values that reach them
void inline_calls(Module& module);   // one call site or under 40 instructions
void dce(Module& module);            // what nothing needs
void fold(Module& module);           // constants and exact identities
void unmask(Module& module);         // loops of known rounds that all lanes around enter
void cse(Module& module);            // equal pure values once; loop-invariant ones before loops
bool fuse(Module& module);           // loops over the same records, Ifs of one mask; true if any
void schedule(Module& module);       // what a loop's next round begins with, as soon as it can be
// Splits frame-rate work off: returns the frame kernel (all its outputs are frame block slots, all
// its inputs frame inputs), leaving `module` with FrameLoads and point inputs only.
Module hoist(Module& module);

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
};

// Optimises, splits and emits. Kernels are cached by the hash of their final IR and the target
// (process-wide, thread-safe: the first thread to need a kernel compiles it, others wait).
KernelPair compile(Module module, const CompileOptions& options = {});

// For tests and tools: the passes without emitting.
void optimize(Module& module, Module* frame,
              std::vector<std::pair<std::string, std::string>>* dumps = nullptr);

struct CacheStats {
    size_t kernels = 0;
    size_t code_bytes = 0;
    double total_ms = 0;
};
CacheStats cache_stats();
void clear_cache();  // drops kernels nobody holds

}  // namespace kinora::jit
