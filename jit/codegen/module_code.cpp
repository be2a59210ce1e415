// jit/codegen/module_code.cpp: what every code generator needs to know of a module as a whole.
#include "jit/codegen/module_code_p.h"

#include <fmt/format.h>

#include <optional>

#include "jit/codegen/code_memory.h"
#include "jit/ir/analysis.h"
#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

struct CodeKernel final : Kernel {
    void run(const KernelArgs& args) const override {
        CHECK(runs_here);
        entry(&args);
    }

    std::shared_ptr<const CodeMemory> memory;
    std::optional<UnwindRegistration> unwind;
    KernelFn entry = nullptr;
    bool runs_here = false;
};

// Tells callers of the kernel about the module; everything but the code.
void describe(const Module& module, const char* target, Kernel& kernel) {
    kernel.name = module.name;
    kernel.inputs = module.inputs;
    kernel.outputs = module.outputs;
    kernel.services = module.services;
    kernel.fault_sites = module.fault_sites;
    kernel.frame_slots = module.frame_slots;
    kernel.target = target;
}

}  // namespace

std::vector<size_t> reached_functions(const Module& module) {
    std::vector<size_t> order = {0};
    std::vector<bool> seen(module.functions.size());
    for (size_t k = 0; k < order.size(); ++k)
        for (const Inst& inst : module.functions[order[k]].insts) {
            if (inst.op != Op::Call || seen[static_cast<size_t>(inst.imm)]) continue;
            seen[static_cast<size_t>(inst.imm)] = true;
            order.push_back(static_cast<size_t>(inst.imm));
        }
    return order;
}

PlannedModule::PlannedModule(const Module& module, const CodeRules& rules) {
    std::vector<size_t> frames(module.functions.size(), 0);
    for (size_t index : reached_functions(module)) {
        const FunctionCode& code = functions.emplace_back(module, index, rules);
        frames[index] = code.frame_bytes;
        fits = fits && code.fits();
        uses_valid_lanes = uses_valid_lanes || code.uses_valid_lanes();
    }
    stack_bytes = deepest_stack(module, frames);
}

std::string PlannedModule::check() const {
    for (const FunctionCode& code : functions)
        if (std::string fault = code.check(); !fault.empty()) return fault;
    return "";
}

std::shared_ptr<Kernel> finish_kernel(const Module& module, const char* target, FinishedCode code) {
    auto kernel = std::make_shared<CodeKernel>();
    kernel->memory = make_executable(code.bytes);
    if (kernel->memory == nullptr) return nullptr;
    describe(module, target, *kernel);
    kernel->scratch_bytes = code.scratch_bytes;
    kernel->code_bytes = code.bytes.size();
    kernel->machine_code = {kernel->memory->data(), code.bytes.size()};
    kernel->lines = std::move(code.lines);
    kernel->eh_frame = code.unwind.eh_frame(kernel->memory->data(), code.bytes.size());
    if (code.runs_here) kernel->unwind.emplace(kernel->eh_frame);
    kernel->entry = reinterpret_cast<KernelFn>(reinterpret_cast<uintptr_t>(kernel->memory->data()));
    kernel->runs_here = code.runs_here;
    std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - code.begun;
    kernel->compile_ms = took.count();
    return kernel;
}

std::string text_of(const Function& function, Value at, bool fused) {
    const Inst& i = function.insts[at];
    std::string text = fmt::format("%{} = {}", at, op_info(i.op).name);
    for (Value v : {i.a, i.b, i.c})
        if (v != kNone) text += fmt::format(" %{}", v);
    return fused ? text + " (fused)" : text;
}

void note_line(std::vector<CodeLine>& lines, size_t offset, const Location& where) {
    auto same = [&](const Location& known) {
        return known.file == where.file && known.begin == where.begin && known.end == where.end;
    };
    if (!lines.empty() && same(lines.back().where)) return;
    if (!lines.empty() && lines.back().offset == offset) lines.pop_back();
    lines.push_back({static_cast<uint32_t>(offset), where});
}

}  // namespace kinora::jit
