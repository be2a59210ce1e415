// jit/interp/interp.cpp: the target "interp": prepares a module for walking and runs it group by
// group.
#include "jit/interp/interp.h"

#include <algorithm>
#include <cstring>

#include "jit/interp/interp_p.h"
#include "jit/ir/analysis.h"
#include "runtime/base/check.h"

namespace kinora::jit {

namespace interp {

namespace {

// Where each region ends, and how many values the widest loop carries.
void match_regions(const Function& function, Code& code, uint32_t* carried) {
    code.match.assign(function.insts.size(), kNone);
    for (Value v = 0; v < function.insts.size(); ++v) {
        const Inst& inst = function.insts[v];
        if (inst.op != Op::EndIf && inst.op != Op::EndLoop) continue;
        code.match[static_cast<Value>(inst.imm)] = v;
        code.match[v] = static_cast<Value>(inst.imm);
        if (inst.op == Op::EndLoop) *carried = std::max<uint32_t>(*carried, inst.arg_count);
    }
}

Code prepare(const Function& function) {
    Code code;
    code.function = &function;
    uint32_t carried = 0;
    match_regions(function, code, &carried);
    code.rows = function.insts.size();
    for (const ArrayInfo& array : function.arrays) {
        code.array_row.push_back(code.rows);
        code.rows += static_cast<size_t>(array.length);
    }
    code.swap_row = code.rows;
    code.rows += carried;
    return code;
}

// Rows that one activation of a function takes: its own, and the arguments of a callee.
size_t activation_rows(const Program& program, size_t index) {
    size_t arguments = 0;
    for (const Inst& inst : program.module.functions[index].insts)
        if (inst.op == Op::Call || inst.op == Op::Service)
            arguments = std::max<size_t>(arguments, inst.arg_count);
    return program.codes[index].rows + arguments;
}

class InterpKernel final : public Kernel {
  public:
    explicit InterpKernel(const Module& module) {
        program_.module = module;
        for (const Function& function : program_.module.functions)
            program_.codes.push_back(prepare(function));
        std::vector<size_t> rows;
        for (size_t k = 0; k < program_.codes.size(); ++k)
            rows.push_back(activation_rows(program_, k));
        result_row_ = deepest_stack(program_.module, rows);
        program_.scratch_rows = result_row_ + module.outputs.size();

        name = module.name;
        inputs = module.inputs;
        outputs = module.outputs;
        services = module.services;
        fault_sites = module.fault_sites;
        frame_slots = module.frame_slots;
        scratch_bytes = program_.scratch_rows * sizeof(Row);
        target = "interp";
    }

    void run(const KernelArgs& args) const override {
        Row* rows = reinterpret_cast<Row*>(args.scratch);
        for (int32_t first = 0; first < args.count; first += kLanes) run_group(args, rows, first);
    }

  private:
    void run_group(const KernelArgs& args, Row* rows, int32_t first) const {
        int32_t points = std::min(args.count - first, kLanes);
        const Code& code = program_.codes[0];
        Row* results = rows + result_row_;
        run_function({program_, args, code, rows, rows + code.rows, first, (1u << points) - 1,
                      nullptr, results});
        for (size_t k = 0; k < outputs.size(); ++k)
            std::memcpy(args.out[k] + first, &results[k], sizeof(Row));
    }

    Program program_;
    size_t result_row_ = 0;
};

}  // namespace

}  // namespace interp

std::shared_ptr<Kernel> emit_interp(const Module& module, std::string* assembly) {
    if (assembly != nullptr) *assembly = print(module);
    return std::make_shared<interp::InterpKernel>(module);
}

}  // namespace kinora::jit
