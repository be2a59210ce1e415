// jit/x64/kernel.cpp: from a module to a kernel: emits the functions it reaches, and the pool.
#include <chrono>
#include <deque>

#include "jit/codegen/code_memory.h"
#include "jit/codegen/module_code_p.h"
#include "jit/ir/analysis.h"
#include "jit/x64/emit_p.h"
#include "jit/x64/x64.h"

namespace kinora::jit {

namespace x64 {

namespace {

// Registers 14, 15 (AVX2) and 30, 31 (AVX-512) are the emitter's scratch; k0 and k7 too.
constexpr Isa kAvx2 = {"avx2", 8, false, 14, 0};
constexpr Isa kAvx512 = {"avx512", 16, true, 30, 7};

void number_frame_rows(ModuleState& state, std::span<const size_t> functions) {
    if (state.isa.wide) return;
    state.frame_row.assign(static_cast<size_t>(state.module.frame_slots), -1);
    int32_t rows = 0;
    for (size_t index : functions)
        for (const Inst& inst : state.module.functions[index].insts) {
            if (inst.op != Op::FrameLoad) continue;
            int32_t& row = state.frame_row[static_cast<size_t>(inst.imm)];
            if (row < 0) row = rows++;
        }
    state.globals_bytes = (kFrameRows + 32 * rows + kRow - 1) / kRow * kRow;
}

struct Emitted {
    asmjit::CodeHolder code;
    asmjit::StringLogger log;
    size_t scratch_bytes = 0;
    bool fits = true;  // false: a frame is too large for code, which is not written
    std::vector<CodePlace> places;
    UnwindWriter unwind{kUnwindX64};
    std::string fault;  // of the register allocation, if asked for
};

void emit_module(const Module& module, const Isa& isa, bool listing, bool check, Emitted& out) {
    out.code.init(asmjit::Environment::host());
    if (listing) out.code.setLogger(&out.log);
    x86::Assembler a(&out.code);
    Pool pool(a, isa.wide ? 1 : 8);
    ModuleState state{module, isa, a, pool, {}, {}};
    std::vector<size_t> functions = reached_functions(module);
    state.entries.resize(module.functions.size());
    for (size_t index : functions) state.entries[index] = a.newLabel();
    number_frame_rows(state, functions);

    std::deque<Emit> emits;
    std::vector<size_t> frames(module.functions.size(), 0);
    for (size_t index : functions) {
        const Emit& emit = emits.emplace_back(state, index);
        frames[index] = emit.frame_bytes();
        out.fits = out.fits && emit.fits();
        state.uses_valid = state.uses_valid || emit.uses_valid_lanes();
        if (check && out.fault.empty()) out.fault = emit.check();
    }
    out.scratch_bytes = static_cast<size_t>(state.globals_bytes) + deepest_stack(module, frames);
    if (!out.fits) return;
    for (Emit& emit : emits) emit.emit_function(listing);
    state.places.push_back({static_cast<uint32_t>(a.offset()), Location{}});
    pool.place(a);
    out.places = std::move(state.places);
    out.unwind = std::move(state.unwind);
}

std::shared_ptr<Kernel> emit(const Module& module, const Isa& isa, std::string* assembly) {
    auto start = std::chrono::steady_clock::now();
    Emitted emitted;
    emit_module(module, isa, assembly != nullptr, false, emitted);
    if (!emitted.fits) return nullptr;
    if (assembly != nullptr) *assembly = emitted.log.data();
    const asmjit::CodeBuffer& bytes = emitted.code.textSection()->buffer();
    return finish_kernel(module, isa.name,
                         {{bytes.data(), bytes.size()},
                          emitted.scratch_bytes,
                          std::move(emitted.places),
                          std::move(emitted.unwind),
                          start,
                          true});
}

std::string check(const Module& module, const Isa& isa) {
    Emitted emitted;
    emit_module(module, isa, false, true, emitted);
    return emitted.fault;
}

}  // namespace

}  // namespace x64

std::string check_avx2(const Module& module) {
    return x64::check(module, x64::kAvx2);
}

std::string check_avx512(const Module& module) {
    return x64::check(module, x64::kAvx512);
}

bool avx2_supported() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && may_execute();
}

bool avx512_supported() {
    return avx2_supported() && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw");
}

std::shared_ptr<Kernel> emit_avx2(const Module& module, std::string* assembly) {
    return x64::emit(module, x64::kAvx2, assembly);
}

std::shared_ptr<Kernel> emit_avx512(const Module& module, std::string* assembly) {
    return x64::emit(module, x64::kAvx512, assembly);
}

}  // namespace kinora::jit
