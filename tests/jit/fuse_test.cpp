// tests/jit/fuse_test.cpp: loops over one record set and Ifs of one mask become one, and mean the
// same, alone and on every target.
#include <gtest/gtest.h>

#include "jit/compiler.h"
#include "jit/ir/builder.h"
#include "jit/passes/passes.h"
#include "tests/jit/random_kernel.h"
#include "tests/jit/random_module.h"

namespace kinora::jit::test {
namespace {

int count(const Module& module, Op op) {
    int n = 0;
    for (const Inst& inst : module.kernel().insts) n += inst.op == op;
    return n;
}

void fuse_as_compiler_does(Module& module) {
    cse(module);
    for (int k = 0; k < 2 && fuse(module); ++k) cse(module);
}

// Loops over record sets with Ifs in them, and Ifs outside, some of which may be fused: values are
// drawn from all that is visible, so that they depend on each other in any way.
class RecordLoops : public RandomKernel {
  public:
    explicit RecordLoops(uint64_t seed) : RandomKernel(seed, "fused") {
        visible_ = {b().f(0.5f), b().f(-3), b().input(module.inputs[0])};
        for (int k = 0; k < 3; ++k) masks_.push_back(b().lt(any(), any()));
        int steps = 3 + below(6);
        for (int k = 0; k < steps; ++k) step();
        for (int k = 0; k < 4; ++k)
            b().output({"y" + std::to_string(k), Type::F}, visible_[visible_.size() - 1 - k % 3]);
        b().output({"all", Type::F}, sum(visible_));
        b().finish();
    }

  private:
    // Rather an early one, so that not everything hangs on everything.
    Value any() {
        int n = int(visible_.size());
        return visible_[size_t(std::min({below(n), below(n), below(n)}))];
    }
    void step() {
        switch (below(4)) {
            case 0:
                return arithmetic();
            case 1:
                return conditional(RandomKernel::any(masks_), 2);
            default:
                return loop();
        }
    }
    void arithmetic() {
        visible_.push_back(below(2) ? b().mul(any(), any()) : b().sub(any(), any()));
    }
    // Values inside are seen outside through merges only.
    void conditional(Value mask, int merges) {
        size_t outside = visible_.size();
        std::vector<Value> before, inner;
        for (int k = 0; k < merges; ++k) before.push_back(any());
        b().begin_if(mask);
        for (int k = below(4); k >= 0; --k) arithmetic();
        for (int k = 0; k < merges; ++k) inner.push_back(any());
        b().end_if();
        visible_.resize(outside);
        for (size_t k = 0; k < before.size(); ++k)
            visible_.push_back(b().merge(inner[k], before[k]));
    }
    void loop() {
        Value set = b().i(below(3) ? 1 : 2);
        Value records = b().op(Op::RecordCount, set);
        size_t outside = visible_.size();
        Value first = any(), second = any();
        b().begin_loop(b().op(Op::ILt, b().i(0), records), b().fault_site({}, "loop"));
        Value record = b().loop_var(b().i(0));
        Value x = b().loop_var(first), y = b().loop_var(second);
        visible_.insert(visible_.end(), {x, y});
        for (int k = below(3); k >= 0; --k)
            visible_.push_back(b().op(Op::RecordField, set, record, kNone, below(2), int(Type::F)));
        Value kind = b().op(Op::RecordUniform, set, record, kNone, 0, int(Type::I));
        const float kinds[] = {0.25f, 7.5f, 1e30f};  // tests/jit/world.cpp has some of them
        Value is_ambient = below(2) ? b().op(Op::ILt, kind, b().i(0))
                                    : b().op(Op::IEq, kind, b().i(bits_of(kinds[below(3)])));
        masks_ = {is_ambient, b().logical_not(is_ambient), b().lt(any(), any())};
        for (int k = below(4); k >= 0; --k) conditional(masks_[size_t(below(3))], 1 + below(2));
        Value next = b().iadd(record, b().i(1));
        std::vector<Value> values = {next, any(), any()};
        b().end_loop(b().op(Op::ILt, next, records), values);
        visible_.resize(outside);
        Value outs[] = {b().loop_out(x), b().loop_out(y)};
        visible_.insert(visible_.end(), std::begin(outs), std::end(outs));
        masks_ = {b().lt(any(), any()), b().lt(any(), any())};
    }

    std::vector<Value> visible_, masks_;
};

TEST(Fuse, KeepsTheMeaningOfRandomRecordLoops) {
    int fused = 0;
    for (uint64_t seed = 1; seed <= 1500; ++seed) {
        Module module = RecordLoops(seed).module;
        ASSERT_EQ(verify(module), "") << print(module);
        Module changed = module;
        fuse_as_compiler_does(changed);
        ASSERT_EQ(verify(changed), "") << "seed " << seed << "\n" << print(changed);
        fused += count(changed, Op::Loop) < count(module, Op::Loop);
        World world(seed, 1 + int32_t(seed % 37));
        std::shared_ptr<Kernel> kernel = find_target("interp")->emit(module, nullptr);
        RunResult before = world.run(*kernel);
        for (const Target& target : targets()) {
            if (!target.supported()) continue;
            RunResult after = world.run(*target.emit(changed, nullptr));
            ASSERT_EQ(before.out, after.out) << target.name << " seed " << seed << "\n"
                                             << print(module) << print(changed);
        }
    }
    EXPECT_GT(fused, 300);
}

TEST(Fuse, KeepsTheMeaningOfRandomPrograms) {
    for (uint64_t seed = 1; seed <= 400; ++seed) {
        Module module = random_module(seed, kPolicies[seed % uint64_t(kPolicyCount)], 60);
        Module changed = module;
        fuse_as_compiler_does(changed);
        ASSERT_EQ(verify(changed), "") << "seed " << seed << "\n" << print(changed);
        World world(seed, 1 + int32_t(seed % 37));
        RunResult before = world.run(*find_target("interp")->emit(module, nullptr));
        RunResult after = world.run(*find_target("interp")->emit(changed, nullptr));
        ASSERT_EQ(before.out, after.out) << "seed " << seed << "\n" << print(module);
    }
}

// ambient() + diffuse() of a surface: sums over the records of two kinds.
Module two_sums() {
    Module module;
    add_function(module, "kernel", {});
    Builder b(module, 0);
    std::vector<Value> sums;
    for (int k = 0; k < 3; ++k) {
        Value records = b.op(Op::RecordCount, b.i(0));
        b.begin_loop(b.op(Op::ILt, b.i(0), records), b.fault_site({}, "lights"));
        Value record = b.loop_var(b.i(0)), sum = b.loop_var(b.f(0));
        Value kind = b.op(Op::RecordUniform, b.i(0), record, kNone, 0, int(Type::I));
        Value ambient = b.op(Op::IEq, kind, b.i(0));
        b.begin_if(k == 0 ? ambient : b.logical_not(ambient));
        Value light = b.op(Op::RecordField, b.i(0), record, kNone, 1, int(Type::F));
        Value more = b.add(sum, k == 2 ? b.mul(light, light) : light);
        b.end_if();
        Value merged = b.merge(more, sum), next = b.iadd(record, b.i(1));
        b.end_loop(b.op(Op::ILt, next, records), std::vector{next, merged});
        sums.push_back(b.mul(b.loop_out(sum), b.f(0.5f)));
    }
    b.output({"y", Type::F}, b.add(sums[0], b.add(sums[1], sums[2])));
    b.finish();
    return module;
}

TEST(Fuse, MakesOneLoopAndOneReadOfWhatASurfaceSums) {
    Module module = two_sums();
    fuse_as_compiler_does(module);
    EXPECT_EQ(verify(module), "");
    EXPECT_EQ(count(module, Op::Loop), 1) << print(module);
    EXPECT_EQ(count(module, Op::If), 2) << print(module);
    EXPECT_EQ(count(module, Op::RecordField), 2) << print(module);
    EXPECT_EQ(count(module, Op::RecordUniform), 1) << print(module);
}

TEST(Fuse, LeavesALoopThatNeedsTheOneBefore) {
    Module module;
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value sum = b.f(0);
    for (int k = 0; k < 2; ++k) {
        Value records = b.op(Op::RecordCount, b.i(0));
        b.begin_loop(b.op(Op::ILt, b.i(0), records), b.fault_site({}, "lights"));
        Value record = b.loop_var(b.i(0)), carried = b.loop_var(sum);
        Value light = b.op(Op::RecordField, b.i(0), record, kNone, 1, int(Type::F));
        Value next = b.iadd(record, b.i(1));
        b.end_loop(b.op(Op::ILt, next, records),
                   std::vector{next, b.mul(b.add(carried, light), light)});
        sum = b.loop_out(carried);
    }
    b.output({"y", Type::F}, sum);
    b.finish();
    fuse_as_compiler_does(module);
    EXPECT_EQ(count(module, Op::Loop), 2);
}

}  // namespace
}  // namespace kinora::jit::test
