// tests/jit/regalloc_test.cpp: allocations of random programs are proven right, and the checker
// finds every kind of damage done to one.
#include "jit/codegen/regalloc.h"

#include <gtest/gtest.h>

#include "jit/codegen/function_code_p.h"
#include "jit/ir/planted_fault.h"
#include "tests/jit/target_random.h"

namespace kinora::jit {
namespace {

struct Case {
    Module module;
    std::vector<ValuePlan> plan;

    const Function& function() const { return module.kernel(); }
};

// A plain target: everything but constants wants a vector register.
Case make_case(uint32_t seed) {
    Case c{test::random_target_module(seed, 80, seed % 2 == 0), {}};
    const Function& f = c.function();
    c.plan.resize(f.insts.size());
    for (Value v = 0; v < f.insts.size(); ++v) {
        const Inst& inst = f.insts[v];
        ValuePlan& p = c.plan[v];
        bool constant = inst.op == Op::ConstF || inst.op == Op::ConstI || inst.op == Op::ConstM;
        if (inst.type != Type::None && !constant && inst.op != Op::LoopOut)
            p.cls = inst.type == Type::M ? RegClass::Mask : RegClass::Vector;
        p.hoist = inst.op == Op::ConstF;
        p.home = inst.op == Op::Input;
        p.masked = true;
        p.clobber = inst.op == Op::Call || inst.op == Op::Service;
    }
    return c;
}

Allocation allocate(const Case& c, const Structure& structure, int vectors, int masks) {
    AllocationLimits limits;
    limits.registers[0] = vectors;
    limits.registers[1] = masks;
    limits.hoist_function = true;
    for (const ValuePlan& p : c.plan) limits.hoist_function &= !p.clobber;
    return allocate_registers(c.function(), structure, c.plan, limits);
}

TEST(RegisterAllocation, IsProvenForAnyNumberOfRegisters) {
    for (uint32_t seed = 1; seed < 400; ++seed) {
        Case c = make_case(seed);
        Structure structure(c.function());
        for (int registers : {1, 2, 3, 5, 8, 14, 30}) {
            Allocation a = allocate(c, structure, registers, 1 + registers / 4);
            ASSERT_EQ(check_allocation(c.function(), structure, c.plan, a), "")
                << "seed " << seed << ", " << registers << " registers\n"
                << print(c.module);
            for (const LiveInterval& p : a.intervals) ASSERT_LT(p.reg, registers);
        }
    }
}

TEST(RegisterAllocation, NeedsNoSlotsWhenRegistersSuffice) {
    Module m;
    add_function(m, "kernel", {});
    Builder b(m, 0);
    Value x = b.input({"x", Type::F, Rate::Point, "", ""});
    Value y = x;
    for (int k = 0; k < 100; ++k) y = b.fma(y, x, y);
    b.output({"y", Type::F}, y);
    b.finish();
    Case c{m, std::vector<ValuePlan>(m.kernel().insts.size())};
    for (Value v = 0; v + 1 < c.plan.size(); ++v) c.plan[v].cls = RegClass::Vector;
    c.plan[0].home = true;
    Structure structure(c.function());
    Allocation a = allocate(c, structure, 2, 0);
    EXPECT_EQ(a.slots[0], 0);
    EXPECT_EQ(check_allocation(c.function(), structure, c.plan, a), "");
}

// for k, for j: what the inner loop computes, while eight values of the outer loop wait for it.
Module waiting_loop() {
    Module m;
    add_function(m, "kernel", {});
    Builder b(m, 0);
    Value x = b.input({"x", Type::F, Rate::Point, "", ""});
    b.begin_loop(b.m(true), b.fault_site({}, "outer"));
    std::vector<Value> outer = {b.loop_var(b.i(0))}, next;
    for (int k = 0; k < 8; ++k) outer.push_back(b.loop_var(b.f(float(k))));
    b.begin_loop(b.m(true), b.fault_site({}, "inner"));
    Value j = b.loop_var(b.i(0)), sum = b.loop_var(x), y = sum;
    for (int k = 0; k < 20; ++k) y = b.fma(b.add(y, sum), y, sum);
    Value next_j = b.iadd(j, b.i(1));
    b.end_loop(b.op(Op::ILt, next_j, b.i(5)), std::vector<Value>{next_j, y});
    for (size_t k = 0; k < outer.size(); ++k)
        next.push_back(k == 0 ? b.iadd(outer[0], b.i(1)) : b.add(outer[k], b.loop_out(sum)));
    b.end_loop(b.op(Op::ILt, next[0], b.i(5)), next);
    for (size_t k = 1; k < outer.size(); ++k) x = b.add(x, b.loop_out(outer[k]));
    b.output({"y", Type::F}, x);
    b.finish();
    return m;
}

TEST(RegisterAllocation, GivesWhatTheInnermostLoopComputesRegistersBeforeWhatLoopsAroundCarry) {
    Case c{waiting_loop(), {}};
    const std::vector<Inst>& insts = c.function().insts;
    for (const Inst& inst : insts) {
        bool plain = inst.type == Type::F || (inst.type == Type::I && inst.op != Op::ConstI);
        bool value = plain && inst.op != Op::ConstF && inst.op != Op::LoopOut;
        c.plan.push_back({.cls = value ? RegClass::Vector : RegClass::None});
    }
    Structure structure(c.function());
    Allocation a = allocate(c, structure, 8, 0);
    EXPECT_EQ(check_allocation(c.function(), structure, c.plan, a), "");
    int computed = 0;
    for (Value v = 0; v < insts.size(); ++v) {
        if (insts[v].op != Op::Fma) continue;
        ++computed;
        EXPECT_TRUE(a.intervals[v].in_reg(a.intervals[v].end)) << "%" << v;
    }
    EXPECT_EQ(computed, 20);
}

// The last position outside Ifs and Loops that reads v from its register, 0 if none.
Value last_plain_read(const Case& c, const Structure& structure, const Allocation& a, Value v) {
    Value last = 0;
    for (Value at = 0; at < a.intervals.size(); ++at)
        for_each_use(c.function(), structure, c.plan, at, [&](Value used) {
            if (used == v && structure.top[at] == at && a.intervals[v].in_reg(at)) last = at;
        });
    return last;
}

// A value put into the register of another that is still to be read is found.
TEST(RegisterAllocation, CheckerFindsDamage) {
    int damaged = 0;
    for (uint32_t seed = 1; seed < 60; ++seed) {
        Case c = make_case(seed);
        Structure structure(c.function());
        Allocation good = allocate(c, structure, 6, 3);
        for (Value v = 0; v < good.intervals.size(); ++v) {
            if (good.intervals[v].reg < 0 || c.plan[v].cls == RegClass::None) continue;
            Value read = last_plain_read(c, structure, good, v);
            for (Value w = v + 1; w < read; ++w) {
                const LiveInterval &p = good.intervals[v], &q = good.intervals[w];
                bool plain = structure.top[w] == w && c.function().insts[w].op != Op::Merge;
                if (!plain || c.plan[w].cls != c.plan[v].cls || !q.in_reg(w) || q.reg == p.reg)
                    continue;
                if (p.begin >= w || c.plan[w].home) continue;
                Allocation bad = good;
                bad.intervals[w].reg = p.reg;
                EXPECT_NE(check_allocation(c.function(), structure, c.plan, bad), "")
                    << "seed " << seed << ": %" << w << " over %" << v;
                ++damaged;
                break;
            }
        }
    }
    EXPECT_GT(damaged, 100);
}

// What the generators plan with and the registers they have.
struct GeneratorRow {
    const char* name;
    CodeRules rules;
};
const GeneratorRow kGenerators[] = {
    {"avx2", {.plan = {false, true, true}, .limits = {.registers = {14}}, .lanes = 8}},
    {"avx512",
     {.plan = {true, true, true}, .limits = {.registers = {30, 7}, .first = {0, 1}}, .lanes = 16}},
    {"neon", {.plan = {false, false, false}, .limits = {.registers = {29}}, .lanes = 4}},
};

// How many functions of random programs the checker refuses while the allocator has the fault. No
// code is made, let alone run.
int refused(const CodeRules& rules, PlantedFault fault) {
    int found = 0;
    planted_fault = fault;
    for (uint32_t seed = 1; seed <= 60; ++seed) {
        Module module = test::random_target_module(seed, 300, seed % 2 == 0);
        for (size_t k = 0; k < module.functions.size(); ++k)
            found += !FunctionCode(module, k, rules).check().empty();
    }
    planted_fault = PlantedFault::None;
    return found;
}

TEST(RegisterAllocation, FaultsOfTheAllocatorAreFoundByTheCheckerAlone) {
    for (const GeneratorRow& row : kGenerators) {
        EXPECT_EQ(refused(row.rules, PlantedFault::None), 0) << row.name;
        for (PlantedFault fault : {PlantedFault::RangeNotStretched, PlantedFault::SlotFreedEarly,
                                   PlantedFault::MergeTakesLiveRegister})
            EXPECT_GT(refused(row.rules, fault), 0) << row.name << ", fault " << int(fault);
    }
}

}  // namespace
}  // namespace kinora::jit
