// jit/ir/kernel.h: what a compiled module looks like to its caller.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// Grids are padded to this many points; services see arguments in rows of this many floats.
inline constexpr int kMaxLanes = 16;

// A record of a grid: a light's answer for all its points (rsl/model/renderer_services.h).
struct Record {
    const float* const* columns;  // [field][point], ints bit for bit
    const float* uniforms;        // [field]
};
struct RecordSet {
    int32_t count = 0;
    const Record* records = nullptr;
};

struct ServiceCall {
    void* grid;         // KernelArgs::grid
    const float* args;  // [argument][kMaxLanes], ints bit for bit
    float* results;     // [result][kMaxLanes]; write at least the lanes of mask
    uint32_t mask;      // lanes that ask; never a padding lane
    int32_t first;      // point of lane 0
    int32_t lanes;      // lanes of the calling kernel
};
using ServiceFn = void (*)(const ServiceCall& call);

// Generated code reads it as it lies.
static_assert(sizeof(std::atomic<int>) == 4 && std::atomic<int>::is_always_lock_free);
inline constexpr std::atomic<int> kNeverStops{0};

// Laid out for generated code; offsets are asserted in the targets.
struct KernelArgs {
    const float* const* in = nullptr;        // [Kernel::inputs], each 64-byte aligned, padded to
                                             // kMaxLanes with copies of the last point
    float* const* out = nullptr;             // [Kernel::outputs], likewise aligned and padded
    const float* frame = nullptr;            // the frame block, Kernel::frame_slots floats
    std::byte* scratch = nullptr;            // Kernel::scratch_bytes, 64-byte aligned
    uint8_t* fault = nullptr;                // one byte per fault site
    const ServiceFn* services = nullptr;     // [Kernel::services]
    const RecordSet* record_sets = nullptr;  // [0]: the lights at P
    void* grid = nullptr;                    // handed to services
    int32_t count = 0;                       // points, > 0
    // Never null. Once it is not 0, long loops end early and outputs are worth nothing.
    const std::atomic<int>* stop = &kNeverStops;
};
using KernelFn = void (*)(const KernelArgs* args);

// Code from `offset` on comes from there in the source, up to the next row's offset.
struct CodeLine {
    uint32_t offset;
    Location where;  // without a file: from no line
};

// A kernel ready to run. Immutable and shared; its code lives as long as it does.
struct Kernel {
    virtual ~Kernel() = default;
    // Runs all `args.count` points. Thread-safe. The caller sets the denormal mode.
    virtual void run(const KernelArgs& args) const = 0;

    std::string name;
    std::vector<InputInfo> inputs;
    std::vector<OutputInfo> outputs;
    std::vector<ServiceInfo> services;
    std::vector<FaultSite> fault_sites;
    int32_t frame_slots = 0;
    size_t scratch_bytes = 0;
    size_t code_bytes = 0;                    // 0 for the interpreter
    std::span<const std::byte> machine_code;  // with its constants; entry first
    std::vector<CodeLine> lines;              // by offset; the last row is where code ends
    std::vector<std::byte> eh_frame;          // the rules of its stack (jit/codegen/unwind.h)
    std::shared_ptr<const void>
        shown;                // keeps the code known to a debugger (jit/debug/code_tools.h)
    double compile_ms = 0;    // IR to code, passes apart
    const char* target = "";  // "avx2"
    uint64_t ir_hash = 0;     // of the final IR
};

}  // namespace kinora::jit
