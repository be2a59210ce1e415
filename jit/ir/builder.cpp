// jit/ir/builder.cpp: appends instructions, folding on the way.
#include "jit/ir/builder.h"

#include <algorithm>
#include <cstdio>

#include "jit/ir/fold_inst.h"
#include "jit/ir/normalize.h"
#include "runtime/base/check.h"

namespace kinora::jit {

size_t add_function(Module& module, std::string name, std::vector<Type> results) {
    Function function;
    function.name = std::move(name);
    function.results = std::move(results);
    module.functions.push_back(std::move(function));
    return module.functions.size() - 1;
}

Builder::Builder(Module& module, size_t function_index) : module_(&module), index_(function_index) {
    CHECK_LT(function_index, module.functions.size());
}

void Builder::set_location(Location where) {
    if (where.file == kNoFile) {
        where_ = 0;
        return;
    }
    const Location& last = module_->locations.back();
    bool equal = last.file == where.file && last.begin == where.begin && last.end == where.end;
    if (!equal) module_->locations.push_back(where);
    where_ = static_cast<uint32_t>(module_->locations.size() - 1);
}

Value Builder::append(Inst inst) {
    inst.where = where_;
    function().insts.push_back(inst);
    return static_cast<Value>(function().insts.size() - 1);
}

Value Builder::append_control(Op op, Type type, Value a, int32_t imm, std::span<const Value> args) {
    Inst inst{.op = op, .type = type, .a = a, .imm = imm};
    Function& f = function();
    CHECK_LT(args.size(), size_t{65536});
    inst.args = static_cast<uint32_t>(f.args.size());
    inst.arg_count = static_cast<uint16_t>(args.size());
    f.args.insert(f.args.end(), args.begin(), args.end());
    return append(inst);
}

Value Builder::constant(Type type, int32_t bits) {
    auto& known = constants_[static_cast<int>(type) - 1];
    if (auto found = known.find(bits); found != known.end()) return found->second;
    Value value = append({.op = constant_op(type), .type = type, .imm = bits});
    // Inside a region the value is not seen by all that follows; finish() merges the copies.
    if (open_.empty()) known.emplace(bits, value);
    return value;
}

Value Builder::f(float value) {
    return constant(Type::F, bits_of(value));
}
Value Builder::i(int32_t value) {
    return constant(Type::I, value);
}
Value Builder::m(bool value) {
    return constant(Type::M, value ? 1 : 0);
}

bool Builder::constant_f(Value v, float* out) {
    if (inst(v).op != Op::ConstF) return false;
    if (out != nullptr) *out = float_of(inst(v).imm);
    return true;
}
bool Builder::constant_i(Value v, int32_t* out) {
    if (inst(v).op != Op::ConstI) return false;
    if (out != nullptr) *out = inst(v).imm;
    return true;
}
bool Builder::constant_m(Value v, bool* out) {
    if (inst(v).op != Op::ConstM) return false;
    if (out != nullptr) *out = inst(v).imm != 0;
    return true;
}

int Builder::declare_input(const InputInfo& info) {
    for (size_t k = 0; k < module_->inputs.size(); ++k) {
        if (module_->inputs[k].name != info.name) continue;
        CHECK(module_->inputs[k].type == info.type);
        return static_cast<int>(k);
    }
    module_->inputs.push_back(info);
    return static_cast<int>(module_->inputs.size() - 1);
}

Value Builder::input(const InputInfo& info) {
    auto k = static_cast<size_t>(declare_input(info));
    if (k < input_values_.size() && input_values_[k] != kNone) return input_values_[k];
    Value value = append({.op = Op::Input, .type = info.type, .imm = static_cast<int32_t>(k)});
    if (open_.empty()) {
        if (k >= input_values_.size()) input_values_.resize(k + 1, kNone);
        input_values_[k] = value;
    }
    return value;
}

Value Builder::input_gather(int first, int count, Value index) {
    CHECK_GE(first, 0);
    CHECK_GT(count, 0);
    CHECK_LE(static_cast<size_t>(first + count), module_->inputs.size());
    CHECK(type(index) == Type::I);
    return append({.op = Op::InputGather,
                   .type = module_->inputs[static_cast<size_t>(first)].type,
                   .a = index,
                   .imm = first,
                   .imm2 = count});
}

// The type of a 'T' result: that of the operands, or what the immediates say.
Value Builder::lookup(std::span<const float> values, Value index) {
    CHECK_LE(values.size(), size_t{16});
    std::vector<float> row(values.begin(), values.end());
    row.resize(values.size() <= 8 ? 8 : 16, values.back());
    auto mask = static_cast<int32_t>(row.size()) - 1;
    int32_t known = 0;
    if (constant_i(index, &known)) return f(row[static_cast<size_t>(known & mask)]);
    std::vector<float>& table = module_->table;
    auto same = [](float a, float b) { return bits_of(a) == bits_of(b); };
    auto at = std::search(table.begin(), table.end(), row.begin(), row.end(), same);
    auto first = static_cast<int32_t>(at - table.begin());
    if (at == table.end()) table.insert(table.end(), row.begin(), row.end());
    return op(Op::Lookup, index, kNone, kNone, first, mask);
}

Type Builder::any_type(const Inst& inst) {
    switch (inst.op) {
        case Op::ArrayLoad:
            return function().arrays[static_cast<size_t>(inst.imm)].type;
        case Op::Input:
            return module_->inputs[static_cast<size_t>(inst.imm)].type;
        case Op::RecordField:
        case Op::RecordUniform:
            return inst.imm2 == 0 ? Type::F : static_cast<Type>(inst.imm2);
        case Op::Select:
            return type(inst.b);
        default:
            return Type::F;
    }
}

Value Builder::op(Op op, Value a, Value b, Value c, int32_t imm, int32_t imm2) {
    const OpInfo& info = op_info(op);
    CHECK(!(info.flags & kControl));
    Inst inst{.op = op, .a = a, .b = b, .c = c, .imm = imm, .imm2 = imm2};
    inst.type = info.result == 'T' ? any_type(inst) : type_of_letter(info.result);
    if (op == Op::RecordField || op == Op::RecordUniform) inst.imm2 = 0;
    const Value operands[] = {a, b, c};
    for (int k = 0; k < info.operand_count; ++k) {
        CHECK_LT(operands[k], function().insts.size());
        Type wanted = type_of_letter(info.operands[k]);
        if (wanted == Type::None)
            wanted =
                op == Op::ArrayStore ? function().arrays[static_cast<size_t>(imm)].type : inst.type;
        if (type(operands[k]) != wanted) {
            fprintf(stderr, "operand %d of %s has the wrong type\n", k, info.name);
            CHECK_EQ(static_cast<int>(type(operands[k])), static_cast<int>(wanted));
        }
    }
    Folded folded = fold_inst(inst, function().insts);
    if (folded.kind == Folded::Same) return folded.same;
    if (folded.kind == Folded::Constant) return constant(inst.type, folded.bits);
    return append(inst);
}

void Builder::begin_if(Value mask) {
    CHECK(type(mask) == Type::M);
    open_.push_back({append_control(Op::If, Type::None, mask, 0), false});
}

void Builder::end_if() {
    CHECK(!open_.empty() && !open_.back().loop);
    last_if_ = open_.back().begin;
    open_.pop_back();
    append_control(Op::EndIf, Type::None, kNone, static_cast<int32_t>(last_if_));
}

Value Builder::merge(Value inner, Value outer) {
    CHECK_NE(last_if_, kNone);
    CHECK(type(inner) == type(outer));
    if (inner == outer) return outer;
    return append({.op = Op::Merge,
                   .type = type(inner),
                   .a = inner,
                   .b = outer,
                   .imm = static_cast<int32_t>(last_if_)});
}

Value Builder::begin_loop(Value mask, int site) {
    CHECK(type(mask) == Type::M);
    CHECK(site >= 0 && static_cast<size_t>(site) < module_->fault_sites.size());
    open_.push_back({append_control(Op::Loop, Type::M, mask, site), true});
    return open_.back().begin;
}

Value Builder::loop_var(Value init) {
    CHECK(!open_.empty() && open_.back().loop);
    ++open_.back().vars;
    return append_control(Op::LoopVar, type(init), init, static_cast<int32_t>(open_.back().begin));
}

void Builder::end_loop(Value next_mask, std::span<const Value> next) {
    CHECK(!open_.empty() && open_.back().loop);
    CHECK(type(next_mask) == Type::M);
    CHECK_EQ(next.size(), open_.back().vars);
    append_control(Op::EndLoop, Type::None, next_mask, static_cast<int32_t>(open_.back().begin),
                   next);
    open_.pop_back();
}

Value Builder::loop_out(Value loop_var) {
    CHECK(inst(loop_var).op == Op::LoopVar);
    return append_control(Op::LoopOut, type(loop_var), loop_var, 0);
}

Value Builder::param(Type type) {
    Function& f = function();
    f.params.push_back(type);
    return append_control(Op::Param, type, kNone, static_cast<int32_t>(f.params.size() - 1));
}

void Builder::ret(std::span<const Value> results) {
    CHECK(open_.empty());
    CHECK_EQ(results.size(), function().results.size());
    for (size_t k = 0; k < results.size(); ++k) CHECK(type(results[k]) == function().results[k]);
    append_control(Op::Return, Type::None, kNone, 0, results);
    normalize(function());
}

std::vector<Value> Builder::append_results(Value call, const std::vector<Type>& types) {
    std::vector<Value> results;
    for (size_t k = 0; k < types.size(); ++k)
        results.push_back(append_control(Op::Result, types[k], call, static_cast<int32_t>(k)));
    return results;
}

std::vector<Value> Builder::call(size_t function_index, Value mask, std::span<const Value> args) {
    CHECK_LT(function_index, module_->functions.size());
    const Function& callee = module_->functions[function_index];
    CHECK_EQ(args.size(), callee.params.size());
    for (size_t k = 0; k < args.size(); ++k) CHECK(type(args[k]) == callee.params[k]);
    CHECK(type(mask) == Type::M);
    Value at =
        append_control(Op::Call, Type::None, mask, static_cast<int32_t>(function_index), args);
    return append_results(at, callee.results);
}

std::vector<Value> Builder::service(int slot, Value mask, std::span<const Value> args) {
    const ServiceInfo& info = module_->services.at(static_cast<size_t>(slot));
    CHECK_EQ(args.size(), info.params.size());
    for (size_t k = 0; k < args.size(); ++k) CHECK(type(args[k]) == info.params[k]);
    CHECK(type(mask) == Type::M);
    Value at = append_control(Op::Service, Type::None, mask, slot, args);
    return append_results(at, info.results);
}

int Builder::declare_service(const ServiceInfo& info) {
    for (size_t k = 0; k < module_->services.size(); ++k) {
        if (module_->services[k].name != info.name) continue;
        CHECK(module_->services[k].params == info.params);
        CHECK(module_->services[k].results == info.results);
        return static_cast<int>(k);
    }
    module_->services.push_back(info);
    return static_cast<int>(module_->services.size() - 1);
}

int Builder::declare_array(std::string name, Type type, int length, int cleared) {
    CHECK_GT(length, 0);
    function().arrays.push_back(
        {std::move(name), type, length, cleared < 0 ? length : std::min(cleared, length)});
    return static_cast<int>(function().arrays.size() - 1);
}

int Builder::fault_site(Location where, std::string message) {
    module_->fault_sites.push_back({where, std::move(message)});
    return static_cast<int>(module_->fault_sites.size() - 1);
}

void Builder::fault(int site, Value mask) {
    CHECK(site >= 0 && static_cast<size_t>(site) < module_->fault_sites.size());
    op(Op::Fault, mask, kNone, kNone, site);
}

void Builder::output(OutputInfo info, Value value) {
    CHECK_EQ(index_, size_t{0});
    CHECK(type(value) == info.type);
    module_->outputs.push_back(std::move(info));
    output_values_.push_back(value);
}

void Builder::finish() {
    CHECK(open_.empty());
    function().results.clear();
    for (const OutputInfo& info : module_->outputs) function().results.push_back(info.type);
    ret(output_values_);
}

}  // namespace kinora::jit
