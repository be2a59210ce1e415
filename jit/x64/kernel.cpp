// jit/x64/kernel.cpp: from a module to a kernel: emits the functions it reaches, and the pool.
#include <chrono>

#include "jit/codegen/code_memory.h"
#include "jit/codegen/module_code_p.h"
#include "jit/x64/function_writer_p.h"
#include "jit/x64/x64.h"

namespace kinora::jit {

namespace x64 {

namespace {

// Registers 14, 15 (AVX2) and 30, 31 (AVX-512) are the emitter's scratch; k0 and k7 too.
constexpr Isa kAvx2 = {"avx2", 8, false, 14, 0};
constexpr Isa kAvx512 = {"avx512", 16, true, 30, 7};

void number_frame_rows(const Module& module, const PlannedModule& plan, ModuleState& state) {
    if (state.isa.wide) return;
    state.frame_row.assign(static_cast<size_t>(module.frame_slots), -1);
    int32_t rows = 0;
    for (const FunctionCode& code : plan.functions)
        for (const Inst& inst : code.function.insts) {
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
    std::vector<CodeLine> lines;
    UnwindWriter unwind{kUnwindX64};
};

void write_module(const Module& module, const PlannedModule& plan, const Isa& isa, bool listing,
                  Emitted& out) {
    out.code.init(asmjit::Environment::host());
    if (listing) out.code.setLogger(&out.log);
    x86::Assembler a(&out.code);
    Pool pool(a, isa.wide ? 1 : 8);
    ModuleState state{a, isa, pool, {}, {}, kFrameRows, plan.uses_valid_lanes};
    state.entries.resize(module.functions.size());
    for (const FunctionCode& code : plan.functions) state.entries[code.index] = a.newLabel();
    number_frame_rows(module, plan, state);
    out.scratch_bytes = static_cast<size_t>(state.globals_bytes) + plan.stack_bytes;
    for (const FunctionCode& code : plan.functions) FunctionWriter(state, code).write(listing);
    state.lines.push_back({static_cast<uint32_t>(a.offset()), Location{}});
    pool.embed(a);
    out.lines = std::move(state.lines);
    out.unwind = std::move(state.unwind);
}

std::shared_ptr<Kernel> emit(const Module& module, const Isa& isa, std::string* assembly) {
    auto start = std::chrono::steady_clock::now();
    PlannedModule plan(module, isa.rules());
    if (!plan.fits) return nullptr;
    Emitted emitted;
    write_module(module, plan, isa, assembly != nullptr, emitted);
    if (assembly != nullptr) *assembly = emitted.log.data();
    const asmjit::CodeBuffer& bytes = emitted.code.textSection()->buffer();
    return finish_kernel(module, isa.name,
                         {{bytes.data(), bytes.size()},
                          emitted.scratch_bytes,
                          std::move(emitted.lines),
                          std::move(emitted.unwind),
                          start,
                          true});
}

std::string check(const Module& module, const Isa& isa) {
    PlannedModule plan(module, isa.rules());
    Emitted emitted;
    if (plan.fits) write_module(module, plan, isa, false, emitted);
    return plan.check();
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
