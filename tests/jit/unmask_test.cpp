// tests/jit/unmask_test.cpp: loops of known rounds inside masked regions run without a mask of
// their own, other loops keep theirs, and nothing that lanes see changes.
#include <gtest/gtest.h>

#include "jit/compiler.h"
#include "jit/ir/builder.h"
#include "jit/passes/passes.h"
#include "tests/jit/module_difference.h"
#include "tests/jit/random_kernel.h"

namespace kinora::jit::test {
namespace {

// Loops whose mask is a constant: all lanes run them.
int unmasked_loops(const Module& module) {
    const std::vector<Inst>& insts = module.kernel().insts;
    return int(std::count_if(insts.begin(), insts.end(), [&](const Inst& inst) {
        return inst.op == Op::Loop && insts[inst.a].op == Op::ConstM;
    }));
}

// for (k = 0; k < rounds; k += 1) sum = sum * 0.5 + p; lanes also leave where `stay` is false.
// `noted` asks service 1, which logs who asks.
Value sum_loop(Builder& b, Value mask, Value p, Value rounds, Value stay, bool noted) {
    Value running = b.begin_loop(mask, b.fault_site({}, "loop"));
    Value k = b.loop_var(b.i(0)), sum = b.loop_var(b.f(0));
    if (noted) b.service(1, running, std::vector<Value>{sum, k});
    Value next = b.iadd(k, b.i(1)), more = b.op(Op::ILt, next, rounds);
    if (stay != kNone) more = b.logical_and(more, stay);
    b.end_loop(more, std::vector<Value>{next, b.fma(sum, b.f(0.5f), p)});
    return b.loop_out(sum);
}

enum class Shape { Known, LanesLeave, RoundsByPoint, MaskOfItsOwn, PartOfTheMask, NoRegion };

Module loop_of(Shape shape, bool noted = false) {
    Module module;
    declare_world(module);
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value p = b.input(module.inputs[0]), n = b.input(module.inputs[2]);
    Value way = b.lt(p, b.f(1)), other = b.lt(b.f(0), p);
    bool region = shape != Shape::NoRegion;
    Value around = shape == Shape::PartOfTheMask ? b.logical_and(other, way) : way;
    Value mask = shape == Shape::MaskOfItsOwn ? b.logical_and(way, other) : way;
    if (region) b.begin_if(around);
    Value rounds = shape == Shape::RoundsByPoint ? b.op(Op::IMin, n, b.i(5)) : b.i(4);
    Value sum = sum_loop(b, mask, p, rounds, shape == Shape::LanesLeave ? other : kNone, noted);
    if (region) {
        b.end_if();
        sum = b.merge(sum, b.f(-1));
    }
    b.output({"y", Type::F}, sum);
    b.finish();
    return module;
}

int unmasked_loops_after(Module module) {
    unmask_uniform_loops(module);
    EXPECT_EQ(verify(module), "") << print(module);
    return unmasked_loops(module);
}

TEST(Unmask, TakesTheMaskFromLoopsOfKnownRoundsThatTheRegionEntersWhole) {
    EXPECT_EQ(unmasked_loops_after(loop_of(Shape::Known)), 1);
    EXPECT_EQ(unmasked_loops_after(loop_of(Shape::PartOfTheMask)), 1);
}

TEST(Unmask, LeavesItWhereLanesEnterOrLeaveApart) {
    for (Shape shape :
         {Shape::LanesLeave, Shape::RoundsByPoint, Shape::MaskOfItsOwn, Shape::NoRegion})
        EXPECT_EQ(unmasked_loops_after(loop_of(shape)), 0) << int(shape);
}

TEST(Unmask, KeepsTheMaskOfWhatActsInsideTheLoop) {
    Module module = loop_of(Shape::Known, true);
    unmask_uniform_loops(module);
    Value asked = kNone, entered = kNone;
    for (const Inst& inst : module.kernel().insts) {
        if (inst.op == Op::Service) asked = inst.a;
        if (inst.op == Op::If) entered = inst.a;
    }
    EXPECT_NE(asked, kNone);
    EXPECT_EQ(asked, entered);
}

TEST(Unmask, ReachesLoopsInLoops) {
    Module module;
    declare_world(module);
    add_function(module, "kernel", {});
    Builder b(module, 0);
    Value p = b.input(module.inputs[0]);
    // Lanes leave the outer loop apart, but all that run it enter the inner one.
    Value running = b.begin_loop(b.m(true), b.fault_site({}, "loop"));
    Value k = b.loop_var(b.i(0)), x = b.loop_var(p);
    Value sum = sum_loop(b, running, x, b.i(3), kNone, true);
    Value next = b.iadd(k, b.i(1));
    Value more = b.logical_and(b.op(Op::ILt, next, b.i(9)), b.lt(sum, b.f(8)));
    b.end_loop(more, std::vector<Value>{next, sum});
    b.output({"y", Type::F}, b.loop_out(x));
    b.finish();
    EXPECT_EQ(unmasked_loops(module), 1);
    EXPECT_EQ(unmasked_loops_after(module), 2);
}

// Ways and loops in each other, with stores and services for the lanes that run there; values are
// drawn from all that is visible.
class WaysAndLoops : public RandomKernel {
  public:
    explicit WaysAndLoops(uint64_t seed) : RandomKernel(seed, "ways") {
        array_ = b().declare_array("a", Type::F, 3);
        loops_ = b().fault_site({}, "loop");
        running_ = b().m(true);
        floats_ = {b().f(0.5f), b().f(-3), b().input(module.inputs[0]),
                   b().input(module.inputs[1])};
        ints_ = {b().i(0), b().i(2), b().input(module.inputs[2])};
        for (int k = 3 + below(5); k > 0; --k) step(0);
        b().output({"sum", Type::F}, sum(floats_));
        b().output({"last", Type::F}, floats_.back());
        b().output({"count", Type::I}, ints_.back());
        b().finish();
    }

  private:
    Value condition() {
        return below(3) ? b().lt(any(floats_), any(floats_))
                        : b().op(Op::ILt, any(ints_), b().i(2));
    }

    void step(int depth) {
        int kind = below(depth < 3 ? 8 : 4);
        if (kind >= 6) return loop(depth);
        if (kind >= 4) return ways(depth);
        if (kind == 3) return act();
        floats_.push_back(below(2) ? b().fma(any(floats_), b().f(0.75f), any(floats_))
                                   : b().sub(any(floats_), any(floats_)));
    }
    void act() {
        switch (below(3)) {
            case 0:
                ints_.push_back(
                    b().service(1, running_, std::vector<Value>{any(floats_), any(ints_)})[0]);
                return;
            case 1:
                b().op(Op::ArrayStore, any(ints_), any(floats_), running_, array_);
                return;
            default:
                floats_.push_back(
                    b().op(Op::ArrayLoad, any(ints_), kNone, kNone, array_, int(Type::F)));
        }
    }
    void body(int depth) {
        for (int k = 1 + below(4); k > 0; --k) step(depth + 1);
    }

    struct Scope {
        size_t floats, ints, masks;
    };
    Scope enter() const { return {floats_.size(), ints_.size(), masks_.size()}; }
    void leave(const Scope& scope) {
        floats_.resize(scope.floats);
        ints_.resize(scope.ints);
        masks_.resize(scope.masks);
    }

    // if (c) ... else if (d) ... else ...
    void ways(int depth) {
        Value rest = running_, outside = running_;
        for (int k = 1 + below(3); k > 0; --k) {
            Value c = condition(), before = any(floats_), count = any(ints_);
            Value here = b().logical_and(rest, c);
            rest = b().and_not(rest, c);
            masks_.insert(masks_.end(), {c, here, rest});
            Scope scope = enter();
            running_ = below(5) ? here : rest;
            b().begin_if(running_);
            body(depth);
            Value inner = any(floats_), inner_count = any(ints_);
            b().end_if();
            leave(scope);
            floats_.push_back(b().merge(inner, before));
            ints_.push_back(b().merge(inner_count, count));
        }
        running_ = outside;
    }

    // Under the running mask, a part of it, or any mask: what acts inside asks for both.
    void loop(int depth) {
        Value outside = running_, mask = running_;
        int part = below(4);
        if (part == 0) mask = b().logical_and(running_, condition());
        if (part == 1 && !masks_.empty()) mask = any(masks_);
        Value limit = below(4) ? b().i(1 + below(4)) : b().op(Op::IMin, any(ints_), b().i(4));
        Value first = any(floats_), second = any(ints_);
        Scope scope = enter();
        Value looping = b().begin_loop(mask, loops_);
        Value k = b().loop_var(b().i(0)), x = b().loop_var(first), n = b().loop_var(second);
        floats_.push_back(x);
        ints_.insert(ints_.end(), {k, n});
        running_ = mask == outside ? looping : b().logical_and(looping, outside);
        body(depth);
        Value next = b().iadd(k, b().i(1)), more = b().op(Op::ILt, next, limit);
        if (below(4) == 0) more = b().logical_and(more, condition());
        if (below(2)) more = b().logical_and(more, looping);
        b().end_loop(more, std::vector<Value>{next, any(floats_), any(ints_)});
        leave(scope);
        floats_.push_back(b().loop_out(x));
        ints_.push_back(b().loop_out(below(2) ? k : n));
        running_ = outside;
    }

    int array_ = 0, loops_ = 0;
    Value running_ = kNone;
    std::vector<Value> floats_, ints_, masks_;
};

TEST(Unmask, KeepsTheMeaningOfRandomWaysAndLoops) {
    int unmasked = 0;
    for (uint64_t seed = 1; seed <= 1500; ++seed) {
        Module module = WaysAndLoops(seed).module;
        ASSERT_EQ(verify(module), "") << print(module);
        Module changed = module;
        fold(changed);
        unmask_uniform_loops(changed);
        ASSERT_EQ(verify(changed), "") << "seed " << seed << "\n" << print(changed);
        unmasked += unmasked_loops(changed) > unmasked_loops(module);
        World world = world_of(seed);
        auto interp = find_target("interp")->emit(module, nullptr);
        RunResult before = world.run(*interp);
        for (const Target& target : targets()) {
            if (!target.supported()) continue;
            RunResult after = world.run(*target.emit(changed, nullptr));
            ASSERT_EQ(difference(*interp, before, after), "")
                << target.name << " seed " << seed << "\n"
                << print(module) << print(changed);
            ASSERT_EQ(optimized_difference(module, target, seed), "")
                << target.name << " seed " << seed << "\n"
                << print(module);
        }
    }
    EXPECT_GT(unmasked, 400);
}

}  // namespace
}  // namespace kinora::jit::test
