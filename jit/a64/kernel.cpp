// jit/a64/kernel.cpp: from a module to a kernel: an entry, the functions it reaches, the pool.
#include <chrono>

#include "jit/a64/a64.h"
#include "jit/a64/function_writer_p.h"
#include "jit/codegen/code_memory.h"
#include "jit/codegen/module_code_p.h"

namespace kinora::jit {

namespace a64 {

namespace {

// AVX-512's freedoms are missing: masks are vectors, and no compare is true on NaN.
constexpr CodeRules kRules = {
    .plan = {false, false, false}, .limits = {.registers = {kVectorRegisters}}, .lanes = kLanes};

// The first instruction that AsmJit cannot encode.
struct FirstError final : asmjit::ErrorHandler {
    void handleError(asmjit::Error, const char* message, asmjit::BaseEmitter*) override {
        if (text.empty()) text = message;
    }
    std::string text;
};

struct Emitted {
    FirstError error;  // outlives `code`, which points at it
    asmjit::CodeHolder code;
    asmjit::StringLogger log;
    std::vector<CodeLine> lines;
    UnwindWriter unwind{kUnwindA64};
};

enum class Purpose { Run, List, Check };

bool uses_saved_registers(const PlannedModule& plan) {
    for (const FunctionCode& code : plan.functions)
        for (const LiveInterval& interval : code.allocation.intervals)
            if (interval.reg >= kFirstSavedRegister) return true;
    return false;
}

void write_module(const Module& module, const PlannedModule& plan, Purpose purpose, Emitted& out) {
    out.code.init(asmjit::Environment(asmjit::Arch::kAArch64));
    out.code.setErrorHandler(&out.error);
    if (purpose == Purpose::List) out.code.setLogger(&out.log);
    arm::Assembler a(&out.code);
    if (purpose == Purpose::Check)
        a.addDiagnosticOptions(asmjit::DiagnosticOptions::kValidateAssembler);
    ModuleState state{a, {}, {}, plan.uses_valid_lanes, uses_saved_registers(plan)};
    state.entries.resize(module.functions.size());
    for (const FunctionCode& code : plan.functions) state.entries[code.index] = a.newLabel();
    // The code is entered at its start, by way of its end: there adr reaches the pool, however long
    // the code is.
    Label end = a.newLabel(), pool = a.newLabel();
    a.b(end);
    for (const FunctionCode& code : plan.functions)
        FunctionWriter(state, code).write(purpose == Purpose::List);
    a.bind(end);
    state.unwind.begin_function(a.offset());
    a.adr(arm::x9, pool);
    a.b(state.entries[0]);
    state.lines.push_back({static_cast<uint32_t>(a.offset()), Location{}});
    a.align(asmjit::AlignMode::kData, 64);
    a.bind(pool);
    state.pool.embed(a);
    out.lines = std::move(state.lines);
    out.unwind = std::move(state.unwind);
}

std::shared_ptr<Kernel> emit(const Module& module, std::string* assembly) {
    auto start = std::chrono::steady_clock::now();
    PlannedModule plan(module, kRules);
    if (!plan.fits) return nullptr;
    Emitted emitted;
    write_module(module, plan, assembly != nullptr ? Purpose::List : Purpose::Run, emitted);
    if (assembly != nullptr) *assembly = emitted.log.data();
    // The interpreter serves rather than code with a hole.
    if (!emitted.error.text.empty()) return nullptr;
    const asmjit::CodeBuffer& bytes = emitted.code.textSection()->buffer();
    return finish_kernel(module, "neon",
                         {{bytes.data(), bytes.size()},
                          kGlobalsBytes + plan.stack_bytes,
                          std::move(emitted.lines),
                          std::move(emitted.unwind),
                          start,
                          neon_supported()});
}

std::string check(const Module& module) {
    PlannedModule plan(module, kRules);
    Emitted emitted;
    if (plan.fits) write_module(module, plan, Purpose::Check, emitted);
    if (!emitted.error.text.empty()) return "AsmJit: " + emitted.error.text;
    return plan.check();
}

}  // namespace

}  // namespace a64

bool neon_supported() {
#if defined(__aarch64__)
    return may_execute();
#else
    return false;
#endif
}

std::shared_ptr<Kernel> emit_neon(const Module& module, std::string* assembly) {
    return a64::emit(module, assembly);
}

std::string check_neon(const Module& module) {
    return a64::check(module);
}

}  // namespace kinora::jit
