// jit/passes/dce.cpp: drops what nothing needs: values, regions, arrays, functions, inputs,
// services.
#include "jit/codegen/liveness_p.h"
#include "jit/ir/analysis.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

// Renumbers a list by which of its entries are used; order is kept, so neighbours stay neighbours.
class Compaction {
  public:
    explicit Compaction(size_t count) : used_(count, false), number_(count, 0) {}
    void use(int32_t k) { used_[static_cast<size_t>(k)] = true; }
    bool is_used(int32_t k) const { return used_[static_cast<size_t>(k)]; }

    template <class T>
    void apply(std::vector<T>& list) {
        size_t next = 0;
        for (size_t k = 0; k < list.size(); ++k) {
            number_[k] = static_cast<int32_t>(next);
            if (!used_[k]) continue;
            if (next != k) list[next] = std::move(list[k]);
            ++next;
        }
        list.resize(next);
    }
    int32_t operator()(int32_t k) const { return number_[static_cast<size_t>(k)]; }

  private:
    std::vector<bool> used_;
    std::vector<int32_t> number_;
};

void drop_arrays(Function& function) {
    Compaction arrays(function.arrays.size());
    auto names_array = [](Op op) { return op == Op::ArrayLoad || op == Op::ArrayStore; };
    for (const Inst& inst : function.insts)
        if (names_array(inst.op)) arrays.use(inst.imm);
    arrays.apply(function.arrays);
    for (Inst& inst : function.insts)
        if (names_array(inst.op)) inst.imm = arrays(inst.imm);
}

void drop_functions(Module& module) {
    Compaction functions(module.functions.size());
    std::vector<int32_t> work = {0};
    functions.use(0);
    while (!work.empty()) {
        int32_t index = work.back();
        work.pop_back();
        for (const Inst& inst : module.functions[static_cast<size_t>(index)].insts) {
            if (inst.op != Op::Call || functions.is_used(inst.imm)) continue;
            functions.use(inst.imm);
            work.push_back(inst.imm);
        }
    }
    functions.apply(module.functions);
    for (Function& function : module.functions)
        for (Inst& inst : function.insts)
            if (inst.op == Op::Call) inst.imm = functions(inst.imm);
}

void drop_inputs_and_services(Module& module) {
    Compaction inputs(module.inputs.size()), services(module.services.size());
    for (const Function& function : module.functions)
        for (const Inst& inst : function.insts) {
            if (inst.op == Op::Service) services.use(inst.imm);
            int32_t count = inst.op == Op::Input ? 1 : inst.op == Op::InputGather ? inst.imm2 : 0;
            for (int32_t k = 0; k < count; ++k) inputs.use(inst.imm + k);
        }
    inputs.apply(module.inputs);
    services.apply(module.services);
    for (Function& function : module.functions)
        for (Inst& inst : function.insts) {
            if (inst.op == Op::Service) inst.imm = services(inst.imm);
            if (inst.op == Op::Input || inst.op == Op::InputGather) inst.imm = inputs(inst.imm);
        }
}

}  // namespace

void dce(Module& module) {
    drop_functions(module);
    std::vector<bool> effects = has_effects(module);
    for (Function& function : module.functions) {
        Liveness live(module, function, effects);
        live.mark_effects();
        keep_live(function, live);
        drop_arrays(function);
    }
    drop_functions(module);
    drop_inputs_and_services(module);
}

}  // namespace kinora::jit
