// jit/module_code.cpp: what every code generator needs to know of a module as a whole.
#include "jit/module_code_p.h"

namespace kinora::jit {

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

void describe(const Module& module, const char* target, Kernel& kernel) {
    kernel.name = module.name;
    kernel.inputs = module.inputs;
    kernel.outputs = module.outputs;
    kernel.services = module.services;
    kernel.fault_sites = module.fault_sites;
    kernel.frame_slots = module.frame_slots;
    kernel.target = target;
}

void note_place(std::vector<CodePlace>& places, size_t offset, const Location& where) {
    auto same = [&](const Location& known) {
        return known.file == where.file && known.begin == where.begin && known.end == where.end;
    };
    if (!places.empty() && same(places.back().where)) return;
    if (!places.empty() && places.back().offset == offset) places.pop_back();
    places.push_back({static_cast<uint32_t>(offset), where});
}

}  // namespace kinora::jit
