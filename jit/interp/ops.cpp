// jit/interp/ops.cpp: the interpreter's step for every op, sixteen lanes at a time.
#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "jit/interp/interp_p.h"
#include "jit/ir/analysis.h"
#include "jit/ir/scalar_p.h"

namespace kinora::jit::interp {

namespace {

template <class T>
T read(int32_t bits, const Inst& inst) {
    if constexpr (std::is_same_v<T, scalar::Imm>)
        return scalar::Imm{inst.imm};
    else
        return std::bit_cast<T>(bits);
}

// The lane loop around a scalar meaning; operands by the function's own signature.
template <auto fn, class R, class A>
void lanes(R (*)(A), Row& out, const Row& a, const Row&, const Row&, const Inst& inst) {
    for (int k = 0; k < kLanes; ++k)
        out.lane[k] = std::bit_cast<int32_t>(fn(read<A>(a.lane[k], inst)));
}
template <auto fn, class R, class A, class B>
void lanes(R (*)(A, B), Row& out, const Row& a, const Row& b, const Row&, const Inst& inst) {
    for (int k = 0; k < kLanes; ++k)
        out.lane[k] =
            std::bit_cast<int32_t>(fn(read<A>(a.lane[k], inst), read<B>(b.lane[k], inst)));
}
template <auto fn, class R, class A, class B, class C>
void lanes(R (*)(A, B, C), Row& out, const Row& a, const Row& b, const Row& c, const Inst& inst) {
    for (int k = 0; k < kLanes; ++k)
        out.lane[k] = std::bit_cast<int32_t>(
            fn(read<A>(a.lane[k], inst), read<B>(b.lane[k], inst), read<C>(c.lane[k], inst)));
}

template <auto fn>
Value arithmetic(const Frame& frame, const Inst& inst, Value at) {
    const Row& a = frame.row(inst.a);
    const Row& b = frame.row(inst.b == kNone ? inst.a : inst.b);
    const Row& c = frame.row(inst.c == kNone ? inst.a : inst.c);
    lanes<fn>(fn, frame.row(at), a, b, c, inst);
    return at + 1;
}

void fill(Row& out, int32_t bits) {
    std::fill_n(out.lane, kLanes, bits);
}

Value step_const(const Frame& frame, const Inst& inst, Value at) {
    fill(frame.row(at), inst.imm);
    return at + 1;
}

Value step_const_m(const Frame& frame, const Inst& inst, Value at) {
    fill(frame.row(at), -static_cast<int32_t>(inst.imm != 0));
    return at + 1;
}

const float* input_points(const Frame& frame, int32_t input) {
    return frame.args.in[input] + frame.first;
}

Value step_input(const Frame& frame, const Inst& inst, Value at) {
    std::memcpy(&frame.row(at), input_points(frame, inst.imm), sizeof(Row));
    return at + 1;
}

Value step_input_gather(const Frame& frame, const Inst& inst, Value at) {
    const Row& index = frame.row(inst.a);
    Row& out = frame.row(at);
    for (int k = 0; k < kLanes; ++k) {
        int32_t element = std::clamp(index.lane[k], 0, inst.imm2 - 1);
        out.lane[k] = bits_of(input_points(frame, inst.imm + element)[k]);
    }
    return at + 1;
}

Value step_frame_load(const Frame& frame, const Inst& inst, Value at) {
    fill(frame.row(at), bits_of(frame.args.frame[inst.imm]));
    return at + 1;
}

Value step_frame_gather(const Frame& frame, const Inst& inst, Value at) {
    const Row& index = frame.row(inst.a);
    Row& out = frame.row(at);
    for (int k = 0; k < kLanes; ++k) {
        int32_t element = std::clamp(index.lane[k], 0, inst.imm2 - 1);
        out.lane[k] = bits_of(frame.args.frame[inst.imm + element]);
    }
    return at + 1;
}

Value step_lookup(const Frame& frame, const Inst& inst, Value at) {
    const Row& index = frame.row(inst.a);
    Row& out = frame.row(at);
    const float* table = frame.program.module.table.data() + inst.imm;
    for (int k = 0; k < kLanes; ++k) out.lane[k] = bits_of(table[index.lane[k] & inst.imm2]);
    return at + 1;
}

// The set's number agrees in all lanes; lane 0 always holds a point.
const RecordSet& record_set(const Frame& frame, const Inst& inst) {
    return frame.args.record_sets[frame.row(inst.a).lane[0]];
}

Value step_record_count(const Frame& frame, const Inst& inst, Value at) {
    fill(frame.row(at), record_set(frame, inst).count);
    return at + 1;
}

// Lanes that run agree on the record; others may hold anything, so the index is held in range.
template <class Read>
Value step_record(const Frame& frame, const Inst& inst, Value at, Read read_lane) {
    const RecordSet& set = record_set(frame, inst);
    const Row& index = frame.row(inst.b);
    Row& out = frame.row(at);
    for (int k = 0; k < kLanes; ++k) {
        int32_t record = std::clamp(index.lane[k], 0, std::max(set.count - 1, 0));
        out.lane[k] = set.count == 0 ? 0 : bits_of(read_lane(set.records[record], k));
    }
    return at + 1;
}

Value step_record_field(const Frame& frame, const Inst& inst, Value at) {
    return step_record(frame, inst, at, [&](const Record& record, int k) {
        return record.columns[inst.imm][frame.first + k];
    });
}

Value step_record_uniform(const Frame& frame, const Inst& inst, Value at) {
    return step_record(frame, inst, at,
                       [&](const Record& record, int) { return record.uniforms[inst.imm]; });
}

Row* array_rows(const Frame& frame, const Inst& inst) {
    return frame.rows + frame.code.array_row[static_cast<size_t>(inst.imm)];
}

int32_t array_last(const Frame& frame, const Inst& inst) {
    return frame.code.function->arrays[static_cast<size_t>(inst.imm)].length - 1;
}

Value step_array_load(const Frame& frame, const Inst& inst, Value at) {
    const Row* elements = array_rows(frame, inst);
    const Row& index = frame.row(inst.a);
    int32_t last = array_last(frame, inst);
    for (int k = 0; k < kLanes; ++k)
        frame.row(at).lane[k] = elements[std::clamp(index.lane[k], 0, last)].lane[k];
    return at + 1;
}

Value step_array_store(const Frame& frame, const Inst& inst, Value at) {
    Row* elements = array_rows(frame, inst);
    const Row& index = frame.row(inst.a);
    int32_t last = array_last(frame, inst);
    for (int k = 0; k < kLanes; ++k) {
        if (frame.row(inst.c).lane[k] == 0) continue;
        elements[std::clamp(index.lane[k], 0, last)].lane[k] = frame.row(inst.b).lane[k];
    }
    return at + 1;
}

void select(Row& out, const Row& mask, const Row& a, const Row& b) {
    for (int k = 0; k < kLanes; ++k)
        out.lane[k] = (a.lane[k] & mask.lane[k]) | (b.lane[k] & ~mask.lane[k]);
}

Value step_if(const Frame& frame, const Inst& inst, Value at) {
    return mask_bits(frame.row(inst.a)) != 0 ? at + 1 : frame.code.match[at];
}

Value step_next(const Frame&, const Inst&, Value at) {
    return at + 1;
}

Value step_merge(const Frame& frame, const Inst& inst, Value at) {
    const Inst& begin = frame.code.function->insts[static_cast<size_t>(inst.imm)];
    select(frame.row(at), frame.row(begin.a), frame.row(inst.a), frame.row(inst.b));
    return at + 1;
}

// The row of EndLoop, which has no value, counts iterations in lane 0.
Value step_loop(const Frame& frame, const Inst& inst, Value at) {
    Row& running = frame.row(at);
    // Padding lanes never loop: what they hold may be anything, and would only run to the budget.
    for (int k = 0; k < kLanes; ++k)
        running.lane[k] = (frame.valid >> k & 1) != 0 ? frame.row(inst.a).lane[k] : 0;
    const auto& insts = frame.code.function->insts;
    for (Value v = at + 1; insts[v].op == Op::LoopVar; ++v) frame.row(v) = frame.row(insts[v].a);
    Value end = frame.code.match[at];
    frame.row(end).lane[0] = 0;
    return mask_bits(running) != 0 ? at + 1 : end + 1;
}

Value step_end_loop(const Frame& frame, const Inst& inst, Value at) {
    Value begin = frame.code.match[at];
    Row& running = frame.row(begin);
    std::span<const Value> next = frame.code.function->args_of(inst);
    // All are read before any is written: one variable's next may be another variable.
    Row* swap = frame.rows + frame.code.swap_row;
    for (size_t k = 0; k < next.size(); ++k) swap[k] = frame.row(next[k]);
    const Row& again = frame.row(inst.a);
    Row old = running;
    for (int k = 0; k < kLanes; ++k) running.lane[k] &= again.lane[k];
    for (size_t k = 0; k < next.size(); ++k) {
        Row& variable = frame.row(begin + 1 + static_cast<Value>(k));
        select(variable, old, swap[k], variable);
    }
    bool stopped = frame.args.stop->load(std::memory_order_relaxed) != 0;
    if (stopped || mask_bits(running) == 0) return at + 1;
    if (++frame.row(at).lane[0] < frame.program.module.loop_budget) return begin + 1;
    frame.args.fault[frame.code.function->insts[begin].imm] = 1;
    return at + 1;
}

Value step_loop_out(const Frame& frame, const Inst& inst, Value at) {
    frame.row(at) = frame.row(inst.a);
    return at + 1;
}

Value step_param(const Frame& frame, const Inst& inst, Value at) {
    frame.row(at) = frame.params[inst.imm];
    return at + 1;
}

Value step_return(const Frame& frame, const Inst& inst, Value) {
    std::span<const Value> values = frame.code.function->args_of(inst);
    for (size_t k = 0; k < values.size(); ++k) frame.results[k] = frame.row(values[k]);
    return kNone;
}

Row* gather_args(const Frame& frame, const Inst& inst) {
    std::span<const Value> values = frame.code.function->args_of(inst);
    for (size_t k = 0; k < values.size(); ++k) frame.free_rows[k] = frame.row(values[k]);
    return frame.free_rows;
}

// Results follow their call, so their rows are the callee's result rows.
Value step_call(const Frame& frame, const Inst& inst, Value at) {
    if (mask_bits(frame.row(inst.a)) == 0) return at + 1;
    const Row* params = gather_args(frame, inst);
    const Code& callee = frame.program.codes[static_cast<size_t>(inst.imm)];
    Row* rows = frame.free_rows + inst.arg_count;
    run_function({frame.program, frame.args, callee, rows, rows + callee.rows, frame.first,
                  frame.valid, params, &frame.row(at + 1)});
    return at + 1;
}

Value step_service(const Frame& frame, const Inst& inst, Value at) {
    uint32_t mask = mask_bits(frame.row(inst.a)) & frame.valid;
    // Record sets are read by all lanes: where none asks, the handle is 0 all the same.
    if (gives_handle(frame.program.module.services[static_cast<size_t>(inst.imm)]))
        fill((&frame.row(at))[1], 0);
    if (mask == 0) return at + 1;
    const Row* params = gather_args(frame, inst);
    ServiceCall call;
    call.grid = frame.args.grid;
    call.args = reinterpret_cast<const float*>(params);
    call.results = reinterpret_cast<float*>(&frame.row(at) + 1);
    call.mask = mask;
    call.first = frame.first;
    call.lanes = kLanes;
    frame.args.services[inst.imm](call);
    return at + 1;
}

Value step_fault(const Frame& frame, const Inst& inst, Value at) {
    if ((mask_bits(frame.row(inst.a)) & frame.valid) != 0) frame.args.fault[inst.imm] = 1;
    return at + 1;
}

// std::fma and std::floor are calls, a lane each, on the baseline x86-64; these are the same
// functions, correctly rounded alike, as one instruction.
#if defined(__x86_64__)
#define KINORA_WIDE __attribute__((target("avx2,fma")))
KINORA_WIDE Value wide_fma(const Frame& frame, const Inst& inst, Value at) {
    const Row &a = frame.row(inst.a), &b = frame.row(inst.b), &c = frame.row(inst.c);
    Row& out = frame.row(at);
    for (int k = 0; k < kLanes; ++k)
        out.lane[k] =
            bits_of(__builtin_fmaf(float_of(a.lane[k]), float_of(b.lane[k]), float_of(c.lane[k])));
    return at + 1;
}
#define WIDE_ROUNDING(name, function)                                                          \
    KINORA_WIDE Value name(const Frame& frame, const Inst& inst, Value at) {                   \
        const Row& a = frame.row(inst.a);                                                      \
        Row& out = frame.row(at);                                                              \
        for (int k = 0; k < kLanes; ++k) out.lane[k] = bits_of(function(float_of(a.lane[k]))); \
        return at + 1;                                                                         \
    }
WIDE_ROUNDING(wide_floor, __builtin_floorf)
WIDE_ROUNDING(wide_ceil, __builtin_ceilf)
WIDE_ROUNDING(wide_trunc, __builtin_truncf)
WIDE_ROUNDING(wide_round, __builtin_nearbyintf)
#endif

struct Steps {
    StepTable table{};
    std::array<bool, std::tuple_size_v<StepTable>> given{};
};
constexpr Steps make_steps() {
    Steps steps;
    auto row = [&](Op op, Step step) {
        steps.table[static_cast<size_t>(op)] = step;
        steps.given[static_cast<size_t>(op)] = true;
    };
#define ROW(name) row(Op::name, arithmetic<&scalar::name>);
    KINORA_SCALAR_OPS(ROW)
#undef ROW
    row(Op::ConstF, step_const);
    row(Op::ConstI, step_const);
    row(Op::ConstM, step_const_m);
    row(Op::Input, step_input);
    row(Op::InputGather, step_input_gather);
    row(Op::FrameLoad, step_frame_load);
    row(Op::FrameGather, step_frame_gather);
    row(Op::Lookup, step_lookup);
    row(Op::RecordCount, step_record_count);
    row(Op::RecordField, step_record_field);
    row(Op::RecordUniform, step_record_uniform);
    row(Op::ArrayLoad, step_array_load);
    row(Op::ArrayStore, step_array_store);
    row(Op::If, step_if);
    row(Op::EndIf, step_next);
    row(Op::Merge, step_merge);
    row(Op::Loop, step_loop);
    row(Op::LoopVar, step_next);
    row(Op::EndLoop, step_end_loop);
    row(Op::LoopOut, step_loop_out);
    row(Op::Param, step_param);
    row(Op::Return, step_return);
    row(Op::Call, step_call);
    row(Op::Service, step_service);
    row(Op::Result, step_next);
    row(Op::Fault, step_fault);
    return steps;
}
constexpr Steps kSteps = make_steps();

// The pass differentiate() leaves none of these.
constexpr bool only_before_passes(Op op) {
    return op == Op::Du || op == Op::Dv || op == Op::WithSlope;
}
constexpr bool has_all_steps() {
    for (size_t op = 0; op < kSteps.given.size(); ++op)
        if (!kSteps.given[op] && !only_before_passes(static_cast<Op>(op))) return false;
    return true;
}
static_assert(has_all_steps(), "an op of jit/ir/ops.def has no step of the interpreter");

// The steps that this CPU runs fastest.
StepTable best_steps() {
    StepTable table = kSteps.table;
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return table;
    auto row = [&](Op op, Step step) { table[static_cast<size_t>(op)] = step; };
    row(Op::Fma, wide_fma);
    row(Op::Floor, wide_floor);
    row(Op::Ceil, wide_ceil);
    row(Op::Trunc, wide_trunc);
    row(Op::Round, wide_round);
#endif
    return table;
}

}  // namespace

const StepTable& steps() {
    static const StepTable table = best_steps();
    return table;
}

uint32_t mask_bits(const Row& mask) {
    uint32_t bits = 0;
    for (int k = 0; k < kLanes; ++k) bits |= static_cast<uint32_t>(mask.lane[k] & 1) << k;
    return bits;
}

void run_function(const Frame& frame) {
    const Function& function = *frame.code.function;
    for (const ArrayInfo& array : function.arrays) {
        auto index = static_cast<size_t>(&array - function.arrays.data());
        Row* rows = frame.rows + frame.code.array_row[index];
        std::memset(rows, 0, sizeof(Row) * static_cast<size_t>(array.cleared));
    }
    const StepTable& table = steps();
    for (Value at = 0; at != kNone;) {
        const Inst& inst = function.insts[at];
        at = table[static_cast<size_t>(inst.op)](frame, inst, at);
    }
}

}  // namespace kinora::jit::interp
