// jit/codegen/loop_slices.cpp: which loops are long, by the instructions that they may run.
#include "jit/codegen/loop_slices_p.h"

#include <algorithm>

#include "jit/ir/analysis.h"
#include "jit/ir/ieee_scope_p.h"

namespace kinora::jit {

namespace {

// Instructions between two looks: some 30 microseconds for the lanes of a group, so that a launch
// of a whole grid, whose groups each run to their first look, ends within milliseconds.
constexpr int64_t kSlice = 1 << 16;
constexpr int64_t kMostRounds = 1024;  // of a slice
constexpr int64_t kCallCost = 1000;    // a call, in instructions
constexpr int64_t kRecords = 64;       // a set of records is taken to have so many

class Slicer {
  public:
    Slicer(const Module& m, const Function& f, const Structure& s, const FunctionPlan& plan)
        : m_(m), f_(f), s_(s), plan_(plan), slices_(f.insts.size(), 0) {}

    std::vector<int32_t> run() {
        IeeeScope ieee;  // counts rounds as precise kernels do
        for (Value v = 0; v < f_.insts.size(); ++v) {
            Op op = f_.insts[v].op;
            if (op == Op::Loop) work_.push_back(0);
            work_.back() += op == Op::Call || op == Op::Service ? kCallCost : 1;
            if (op == Op::EndLoop) close(static_cast<Value>(f_.insts[v].imm));
        }
        return std::move(slices_);
    }

  private:
    void close(Value loop) {
        int64_t round = work_.back();
        work_.pop_back();
        work_.back() += between_looks(loop, round);
    }

    // Instructions that the loop runs at most until it ends or looks. Sets its slices.
    int64_t between_looks(Value loop, int64_t round) {
        Value end = s_.end_of[loop];
        if (is_over_records(f_.insts[end].a)) return kRecords * round;
        int32_t known = plan_.rounds[loop];
        if (known == 0)
            known = trip_count(f_.insts, f_.args_of(f_.insts[end]), loop, end, m_.loop_budget);
        int64_t all = (known > 0 ? known : m_.loop_budget) * round;
        if (all <= kSlice) return all;
        int64_t rounds = std::clamp<int64_t>(kSlice / round, 1, kMostRounds);
        slices_[loop] = static_cast<int32_t>(rounds);
        return rounds * round;
    }

    // It goes on while an index is below a set's count, and perhaps something else holds. There are
    // no more records than were made before; where a counter is the index it cannot be sliced.
    bool is_over_records(Value condition) const {
        const Inst& inst = f_.insts[condition];
        if (inst.op == Op::MAnd) return is_over_records(inst.a) || is_over_records(inst.b);
        return inst.op == Op::ILt && f_.insts[inst.b].op == Op::RecordCount;
    }

    const Module& m_;
    const Function& f_;
    const Structure& s_;
    const FunctionPlan& plan_;
    std::vector<int32_t> slices_;
    std::vector<int64_t> work_ = {0};  // of the function and the open loops, so far
};

}  // namespace

std::vector<int32_t> loop_slices(const Module& module, const Function& function,
                                 const Structure& structure, const FunctionPlan& plan) {
    const bool loops = std::any_of(function.insts.begin(), function.insts.end(),
                                   [](const Inst& inst) { return inst.op == Op::Loop; });
    if (!loops) return std::vector<int32_t>(function.insts.size(), 0);
    return Slicer(module, function, structure, plan).run();
}

}  // namespace kinora::jit
