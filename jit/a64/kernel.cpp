// jit/a64/kernel.cpp: from a module to a kernel: an entry, the functions it reaches, the
// pool.
#include <chrono>
#include <deque>

#include "jit/a64/a64.h"
#include "jit/a64/emit_p.h"
#include "jit/codegen/code_memory.h"
#include "jit/codegen/module_code_p.h"
#include "jit/ir/analysis.h"

namespace kinora::jit {

namespace a64 {

namespace {

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
    size_t scratch_bytes = 0;
    bool fits = true;  // false: a frame is too large for code, which is not written
    std::vector<CodePlace> places;
    UnwindWriter unwind{kUnwindA64};
    std::string fault;  // of the register allocation, if asked for
};

void emit_module(const Module& module, bool listing, bool check, Emitted& out) {
    out.code.init(asmjit::Environment(asmjit::Arch::kAArch64));
    out.code.setErrorHandler(&out.error);
    if (listing) out.code.setLogger(&out.log);
    arm::Assembler a(&out.code);
    if (check) a.addDiagnosticOptions(asmjit::DiagnosticOptions::kValidateAssembler);
    ModuleState state{module, a, {}, {}};
    std::vector<size_t> functions = reached_functions(module);
    state.entries.resize(module.functions.size());
    for (size_t index : functions) state.entries[index] = a.newLabel();

    std::deque<Emit> emits;
    std::vector<size_t> frames(module.functions.size(), 0);
    for (size_t index : functions) {
        const Emit& emit = emits.emplace_back(state, index);
        frames[index] = emit.frame_bytes();
        out.fits = out.fits && emit.fits();
        state.uses_valid = state.uses_valid || emit.uses_valid_lanes();
        state.saves_registers = state.saves_registers || emit.uses_saved_registers();
        if (check && out.fault.empty()) out.fault = emit.check();
    }
    out.scratch_bytes = kGlobalsBytes + deepest_stack(module, frames);
    if (!out.fits) return;
    // The code is entered at its start, by way of its end: there adr reaches the pool, however long
    // the code is.
    Label end = a.newLabel(), pool = a.newLabel();
    a.b(end);
    for (Emit& emit : emits) emit.emit_function(listing);
    a.bind(end);
    state.unwind.begin_function(a.offset());
    a.adr(arm::x9, pool);
    a.b(state.entries[0]);
    state.places.push_back({static_cast<uint32_t>(a.offset()), Location{}});
    a.align(asmjit::AlignMode::kData, 64);
    a.bind(pool);
    state.pool.place(a);
    out.places = std::move(state.places);
    out.unwind = std::move(state.unwind);
}

std::shared_ptr<Kernel> emit(const Module& module, std::string* assembly) {
    auto start = std::chrono::steady_clock::now();
    Emitted emitted;
    emit_module(module, assembly != nullptr, false, emitted);
    if (assembly != nullptr) *assembly = emitted.log.data();
    // The interpreter serves rather than code with a hole.
    if (!emitted.fits || !emitted.error.text.empty()) return nullptr;
    const asmjit::CodeBuffer& bytes = emitted.code.textSection()->buffer();
    return finish_kernel(module, "neon",
                         {{bytes.data(), bytes.size()},
                          emitted.scratch_bytes,
                          std::move(emitted.places),
                          std::move(emitted.unwind),
                          start,
                          neon_supported()});
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
    a64::Emitted emitted;
    a64::emit_module(module, false, true, emitted);
    if (!emitted.error.text.empty()) return "AsmJit: " + emitted.error.text;
    return emitted.fault;
}

}  // namespace kinora::jit
