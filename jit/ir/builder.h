// jit/ir/builder.h: writes a function of IR, one call an instruction.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "jit/ir/ir.h"

namespace kinora::jit {

// Appends to module.functions[index]. References to the module stay the caller's; several builders
// may be open on different functions of one module. Operand types are checked (CHECK). The builder
// folds what is exact and certain on the way (constants, x*1, select on a constant, same operands
// of and/or), and reuses equal constants and inputs, so callers write the plain formula. A builder
// may be moved aside while another writes through the same variable.
class Builder {
  public:
    Builder(Module& module, size_t function_index);

    Module& module() { return *module_; }
    Function& function() { return module_->functions[index_]; }
    const Inst& inst(Value v) { return function().insts[v]; }
    Type type(Value v) { return inst(v).type; }

    // The source location given to instructions from now on.
    void set_location(Location where);

    // Constants and inputs.
    Value f(float value);
    Value i(int32_t value);
    Value m(bool value);
    bool constant_f(Value v, float* out = nullptr);  // is v a ConstF; its value
    bool constant_i(Value v, int32_t* out = nullptr);
    bool constant_m(Value v, bool* out = nullptr);
    // Declares the input in the module on first use, by name.
    Value input(const InputInfo& info);
    // An array input: `first` and the following count-1 inputs were declared in order.
    int declare_input(const InputInfo& info);  // index in Module::inputs
    Value input_gather(int first, int count, Value index);

    // values[index & (n - 1)], n = 8 or 16: the smallest that holds the values, at most 16 (the
    // rest is free). Constants stand in the module's table, each list once.
    Value lookup(std::span<const float> values, Value index);

    // Any op of ops.def without control or extra operands. RecordField and RecordUniform give
    // floats, or ints when imm2 is int(Type::I).
    Value op(Op op, Value a = kNone, Value b = kNone, Value c = kNone, int32_t imm = 0,
             int32_t imm2 = 0);

    Value add(Value a, Value b) { return op(Op::Add, a, b); }
    Value sub(Value a, Value b) { return op(Op::Sub, a, b); }
    Value mul(Value a, Value b) { return op(Op::Mul, a, b); }
    Value div(Value a, Value b) { return op(Op::Div, a, b); }
    Value fma(Value a, Value b, Value c) { return op(Op::Fma, a, b, c); }
    Value min(Value a, Value b) { return op(Op::Min, a, b); }
    Value max(Value a, Value b) { return op(Op::Max, a, b); }
    Value neg(Value a) { return op(Op::Neg, a); }
    Value abs(Value a) { return op(Op::Abs, a); }
    Value sqrt(Value a) { return op(Op::Sqrt, a); }
    Value floor(Value a) { return op(Op::Floor, a); }
    Value iadd(Value a, Value b) { return op(Op::IAdd, a, b); }
    Value isub(Value a, Value b) { return op(Op::ISub, a, b); }
    Value imul(Value a, Value b) { return op(Op::IMul, a, b); }
    Value iand(Value a, Value b) { return op(Op::IAnd, a, b); }
    Value ior(Value a, Value b) { return op(Op::IOr, a, b); }
    Value ixor(Value a, Value b) { return op(Op::IXor, a, b); }
    Value shl(Value a, int n) { return op(Op::IShl, a, kNone, kNone, n); }
    Value shr(Value a, int n) { return op(Op::IShr, a, kNone, kNone, n); }
    Value sar(Value a, int n) { return op(Op::ISar, a, kNone, kNone, n); }
    Value ftoi(Value a) { return op(Op::FToI, a); }
    Value itof(Value a) { return op(Op::IToF, a); }
    Value bits(Value a) { return op(Op::BitsFI, a); }
    Value from_bits(Value a) { return op(Op::BitsIF, a); }
    Value lt(Value a, Value b) { return op(Op::Lt, a, b); }
    Value le(Value a, Value b) { return op(Op::Le, a, b); }
    Value gt(Value a, Value b) { return op(Op::Lt, b, a); }
    Value ge(Value a, Value b) { return op(Op::Le, b, a); }
    Value eq(Value a, Value b) { return op(Op::Eq, a, b); }
    Value ne(Value a, Value b) { return logical_not(eq(a, b)); }
    Value logical_and(Value a, Value b) { return op(Op::MAnd, a, b); }
    Value logical_or(Value a, Value b) { return op(Op::MOr, a, b); }
    Value and_not(Value a, Value b) { return op(Op::MAndNot, a, b); }
    Value logical_not(Value a) { return op(Op::MNot, a); }
    Value select(Value mask, Value a, Value b) { return op(Op::Select, mask, a, b); }

    // If: begin_if(m); ...; end_if(); then merge(inner, outer) for each value that differs; outer
    // is a constant, an input, or defined before the If. (Constants and inputs may be made
    // anywhere: finish() and ret() move them to the function's start, and Merges, LoopVars and
    // LoopOuts to where they belong; Values are void after that.)
    void begin_if(Value mask);
    void end_if();
    Value merge(Value inner, Value outer);

    // Loop: m = begin_loop(mask); x = loop_var(x0)...; body; end_loop(next_mask, {next...});
    // then loop_out(x) for each value wanted after. Lanes of `mask` beyond the grid never run.
    // `site` from fault_site() for the budget.
    Value begin_loop(Value mask, int site);
    Value loop_var(Value init);
    void end_loop(Value next_mask, std::span<const Value> next);
    Value loop_out(Value loop_var);

    // Functions.
    Value param(Type type);  // appends a parameter
    void ret(std::span<const Value> results);
    // Calls and services give back one value per declared result.
    std::vector<Value> call(size_t function_index, Value mask, std::span<const Value> args);
    std::vector<Value> service(int slot, Value mask, std::span<const Value> args);
    int declare_service(const ServiceInfo& info);  // slot; the same name gives the same slot
    // `cleared`: ArrayInfo::cleared; all elements unless it is given.
    int declare_array(std::string name, Type type, int length, int cleared = -1);
    int fault_site(Location where, std::string message);  // index in Module::fault_sites
    void fault(int site, Value mask);
    void output(OutputInfo info, Value value);  // kernel only; finish() writes the Return
    void finish();

  private:
    Value append(Inst inst);
    Value constant(Type type, int32_t bits);
    Type any_type(const Inst& inst);
    std::vector<Value> append_results(Value call, const std::vector<Type>& types);
    Value append_control(Op op, Type type, Value a, int32_t imm, std::span<const Value> args = {});

    Module* module_;
    size_t index_;
    uint32_t where_ = 0;
    struct Open {
        Value begin;
        bool loop;
        size_t vars = 0;
    };
    std::vector<Open> open_;  // enclosing Ifs and Loops
    Value last_if_ = kNone;   // the If whose Merges may follow
    std::vector<Value> output_values_;
    std::unordered_map<int32_t, Value> constants_[3];  // by type and bits, at function entry depth
    std::vector<Value> input_values_;
};

// A new function in `module`; returns its index.
size_t add_function(Module& module, std::string name, std::vector<Type> results);

}  // namespace kinora::jit
