// rsl/lower/recursion.cpp: functions that call themselves. Each becomes a function of the IR that
// takes the mask, how deep the call stands, how many calls are left, its parameters and the
// variables outside it that it names; it gives its result, its output parameters and those
// variables that it writes. A call beyond the limits is not made: a fault, and 0.
#include <fmt/format.h>

#include <algorithm>

#include "rsl/lower/lower_p.h"
#include "rsl/model/limits.h"

namespace kinora::rsl {

namespace {

constexpr int kMaxValues = 1024;  // numbers handed to a call

// The function itself, or one that it is nested in?
bool encloses(const Function* outer, const Function* inner) {
    for (; inner; inner = inner->parent)
        if (inner == outer) return true;
    return false;
}

void append(std::vector<Value>& list, const Lowered& value) {
    list.insert(list.end(), value.c.begin(), value.c.begin() + value.size());
}

// Where calls may still go deeper; lanes that may not report it.
Value calls_allowed(Emitter& at, const CallExpr& e, Value depth, Value left) {
    jit::Builder& b = at.b;
    Value shallow = b.op(jit::Op::ILt, depth, b.i(kMaxCallDepth));
    Value allowed = b.logical_and(shallow, b.op(jit::Op::ILt, b.i(0), left));
    std::string text =
        fmt::format("function '{}' calls itself more than {} levels deep, or {} times", e.name,
                    kMaxCallDepth, kMaxRecursiveCalls);
    b.fault(b.fault_site(e.span.where, text), b.and_not(at.running, allowed));
    return allowed;
}

}  // namespace

Value Lowering::path_value() {
    if (path_handed_in == jit::kNone) return b.i(int32_t(inline_path));
    return b.iadd(b.imul(path_handed_in, b.i(int32_t(path_factor))), b.i(int32_t(inline_path)));
}

void Lowering::enter_path(uint32_t site) {
    inline_path = inline_path * 31 + site + 1;
    path_factor *= 31;
}

// ---- variables outside the function -------------------------------------------------------------

int Lowering::outside_slot(const Outside& outside) const {
    return outside.symbol ? slot_of(*outside.symbol) : int(outside.id);
}

Lowered Lowering::read_outside(const Outside& outside) {
    return outside.symbol ? read(*outside.symbol) : read_global(outside.id);
}

// One value, or those of an array's elements.
std::vector<Lowered> Lowering::outside_values(const Outside& outside) {
    if (outside.array_length < 0) return {read_outside(outside)};
    std::vector<Lowered> values;
    int array = array_of(*outside.symbol);
    for (int k = 0; k < outside.array_length; ++k) values.push_back(load_element(array, b.i(k)));
    return values;
}

void Lowering::store_outside(const Outside& outside, const std::vector<Lowered>& values) {
    if (outside.array_length < 0) return write_slot(outside_slot(outside), values[0]);
    int array = array_of(*outside.symbol);
    for (int k = 0; k < outside.array_length; ++k) store_element(array, b.i(k), values[size_t(k)]);
}

// What the function names from outside, and the globals that hold something else than the kernel's
// inputs, which built-ins may read. Constants and strings are read again inside: they stay known.
void Lowering::find_outside(Recursive& r, const CallExpr& e) {
    ChangeFinder finder(ast());
    finder.add(*r.function);
    const Changes& changes = finder.changes;
    r.random = changes.random;
    r.record = (changes.effects & kMessage) && current_record != jit::kNone;
    if (!changes.light_sources.empty())
        error(Code::RSL_RECURSION, e.span.where, e.name, "holds illuminate or solar");
    auto written = [&](const Symbol* symbol) {
        return std::find(changes.symbols.begin(), changes.symbols.end(), symbol) !=
               changes.symbols.end();
    };
    bool seen[size_t(Global::Count)] = {};
    for (const Symbol* symbol : finder.used) {
        bool inside = symbol->function &&
                      !(symbol->function != r.function && encloses(symbol->function, r.function));
        if (inside) continue;
        const ParamBinding* bound = binding(symbol->name);
        bool known = bound && bound->kind == ParamBinding::Kind::Constant;
        bool again = symbol->kind == SymbolKind::Parameter && !symbol->assigned &&
                     (known || symbol->type.base == BaseType::String || symbol->type.is_array());
        if (again) continue;
        if (symbol->global) seen[size_t(symbol->global->id)] = true;
        int length = symbol->type.is_array() ? arrays_[size_t(array_of(*symbol))].length : -1;
        r.outside.push_back({symbol, Global::Count, length, written(symbol)});
    }
    for (size_t g = 0; g < size_t(Global::Count); ++g) {
        bool color = Global(g) == Global::Ci || Global(g) == Global::Oi;
        if (live(Global(g)) && !seen[g] && !color)
            r.outside.push_back({nullptr, Global(g), -1, false});
    }
}

// ---- calls --------------------------------------------------------------------------------------

Lowered Lowering::call_recursive(const CallExpr& e, const CallArguments& arguments) {
    size_t known = recursive_function(e, arguments);
    if (failed) return zero(e.type.base == BaseType::Void ? BaseType::Float : e.type.base);
    const Recursive r = recursive_[known];
    const Function& f = *r.function;

    bool outermost = call_depth_ == jit::kNone;
    Value depth = outermost ? b.i(0) : call_depth_;
    Value left = outermost ? b.i(kMaxRecursiveCalls) : read_slot(calls_left_).c[0];
    Value allowed = outermost ? b.m(true) : calls_allowed(*this, e, depth, left);
    Value mask = b.logical_and(running, allowed);
    std::vector<Value> args = {mask, b.iadd(depth, b.i(1)), b.isub(left, b.i(1))};
    if (r.random) {
        Value path = b.iadd(b.imul(path_value(), b.i(31)), b.i(int32_t(e.site + 1)));
        for (Value counter : loop_counters) path = b.iadd(b.imul(path, b.i(31)), counter);
        args.push_back(path);
    }
    if (r.record) args.insert(args.end(), {current_set, current_record});
    std::vector<std::vector<Lowered>> before;  // of all that comes back, then
    for (size_t k = 0; k < f.parameters.size(); ++k) {
        std::vector<Lowered> values = {arguments.values[k]};
        if (int array = arguments.arrays[k]; array >= 0) {
            values.clear();
            for (int i = 0; i < r.lengths[k]; ++i) values.push_back(load_element(array, b.i(i)));
        }
        for (const Lowered& value : values) append(args, value);
        if (f.parameters[k]->output) before.push_back(std::move(values));
    }
    for (const Outside& outside : r.outside) {
        std::vector<Lowered> values = outside_values(outside);
        for (const Lowered& value : values) append(args, value);
        if (outside.written) before.push_back(std::move(values));
    }
    std::vector<Value> results = b.call(r.index, mask, args);

    // Where the call was not made everything is as before.
    auto next = results.begin();
    auto take = [&](Lowered value) {
        for (size_t c = 0; c < size_t(value.size()); ++c)
            value.c[c] = b.select(allowed, *next++, value.c[c]);
        return value;
    };
    if (calls_left_ >= 0) {
        Lowered rest = read_slot(calls_left_);
        write_slot(calls_left_, take(rest));
    } else {
        ++next;
    }
    Lowered result = zero(f.result.base == BaseType::Void ? BaseType::Float : f.result.base);
    if (f.result.base != BaseType::Void) result = take(result);
    size_t back = 0;
    for (size_t k = 0; k < f.parameters.size(); ++k) {
        if (!f.parameters[k]->output) continue;
        std::vector<Lowered>& values = before[back++];
        for (size_t i = 0; i < values.size(); ++i)
            if (arguments.arrays[k] >= 0)
                store_element(arguments.arrays[k], b.i(int(i)), take(values[i]));
            else
                store(arguments.targets[k], take(values[i]));
    }
    for (const Outside& outside : r.outside) {
        if (!outside.written) continue;
        std::vector<Lowered>& values = before[back++];
        for (Lowered& value : values) value = take(value);
        store_outside(outside, values);
    }
    return result;
}

// The function for arrays of these lengths, written now if it is new. Its head is known before its
// body, which may call it.
size_t Lowering::recursive_function(const CallExpr& e, const CallArguments& arguments) {
    bool lit = current_record != jit::kNone;
    Recursive r{e.function, {}, lit, 0, {}, false, false};
    for (int array : arguments.arrays)
        r.lengths.push_back(array < 0 ? -1 : arrays_[size_t(array)].length);
    for (size_t k = 0; k < recursive_.size(); ++k)
        if (recursive_[k].function == r.function && recursive_[k].lengths == r.lengths &&
            recursive_[k].lit == lit)
            return k;
    find_outside(r, e);

    std::vector<jit::Type> results = {jit::Type::I};
    int count = 0;
    auto add = [&](BaseType type, int length, bool given) {
        int values = component_count(type) * (length < 0 ? 1 : length);
        count += values;
        if (given) results.insert(results.end(), size_t(values), ir_type(type));
    };
    if (r.function->result.base != BaseType::Void) add(r.function->result.base, -1, true);
    for (size_t k = 0; k < r.lengths.size(); ++k)
        add(r.function->parameters[k]->type.base, r.lengths[k], r.function->parameters[k]->output);
    for (const Outside& outside : r.outside)
        add(outside.symbol ? outside.symbol->type.base : global_info(outside.id).type.base,
            outside.array_length, outside.written);
    if (count > kMaxValues)
        error(Code::RSL_RECURSION, e.span.where, e.name,
              fmt::format("works on {} numbers, at most {}", count, kMaxValues));
    r.index = jit::add_function(b.module(), std::string(r.function->name), results);
    b.module().call_depth = kMaxCallDepth + 1;
    size_t at = recursive_.size();
    recursive_.push_back(r);
    if (!failed) write_recursive(r);
    return at;
}

// All that belongs to the function being written, put aside for the life of the guard.
struct Lowering::Activation {
    explicit Activation(Lowering& lowering, size_t index)
        : low(lowering),
          builder(std::move(lowering.b)),
          slots(lowering.slots_),
          array_of(lowering.array_of_),
          lent_slot(lowering.lent_slot_) {
        low.b = jit::Builder(builder.module(), index);
        for (Slot& slot : low.slots_) slot.live = false;
        std::fill(low.array_of_.begin(), low.array_of_.end(), -1);
        std::fill(low.lent_slot_.begin(), low.lent_slot_.end(), -1);
        swap();
        low.in_loop_ = false;
        low.current_set = low.current_record = low.path_handed_in = jit::kNone;
        low.inline_path = 0;
        low.path_factor = 1;
    }
    ~Activation() {
        low.b = std::move(builder);
        swap();
        low.slots_ = std::move(slots);
        low.array_of_ = std::move(array_of);
        low.lent_slot_ = std::move(lent_slot);
        low.in_loop_ = in_loop;
        low.current_set = set, low.current_record = record, low.path_handed_in = path;
        low.inline_path = inline_path;
        low.path_factor = factor;
        low.running = running, low.region_ = region;
        low.call_depth_ = depth, low.calls_left_ = left;
    }
    void swap() {
        std::swap(low.trail_, trail);
        std::swap(low.loops_, loops);
        std::swap(low.asked_, asked);
        std::swap(low.frames_, frames);
        std::swap(low.light_sources_, sources);
        std::swap(low.loop_counters, counters);
        std::swap(low.messages, messages);
    }

    Lowering& low;
    jit::Builder builder;
    std::vector<Slot> slots;
    std::vector<int> array_of, lent_slot;
    std::vector<Undo> trail;
    std::vector<Loop> loops;
    std::vector<Asked> asked;
    std::vector<FunctionFrame> frames;
    std::vector<LightSource> sources;
    std::vector<Value> counters;
    std::vector<Message> messages;
    bool in_loop = low.in_loop_;
    Value set = low.current_set, record = low.current_record, path = low.path_handed_in;
    uint32_t inline_path = low.inline_path, factor = low.path_factor;
    Value running = low.running, region = low.region_;
    Value depth = low.call_depth_;
    int left = low.calls_left_;
};

void Lowering::write_recursive(const Recursive& r) {
    const Function& f = *r.function;
    Activation activation(*this, r.index);
    running = region_ = b.param(jit::Type::M);
    call_depth_ = b.param(jit::Type::I);
    Value left = b.param(jit::Type::I);
    if (r.random) path_handed_in = b.param(jit::Type::I);
    if (r.record) current_set = b.param(jit::Type::I), current_record = b.param(jit::Type::I);
    auto parameters = [&](BaseType type, int length) {
        std::vector<Lowered> values(size_t(length < 0 ? 1 : length), Lowered{type, {}});
        for (Lowered& value : values)
            for (size_t c = 0; c < size_t(value.size()); ++c) value.c[c] = b.param(ir_type(type));
        return values;
    };
    // All parameters stand before anything else.
    std::vector<std::vector<Lowered>> own, outer;
    for (size_t k = 0; k < f.parameters.size(); ++k)
        own.push_back(parameters(f.parameters[k]->type.base, r.lengths[k]));
    for (const Outside& outside : r.outside)
        outer.push_back(parameters(
            outside.symbol ? outside.symbol->type.base : global_info(outside.id).type.base,
            outside.array_length));
    calls_left_ = new_slot(lowered(BaseType::String, left));
    for (size_t k = 0; k < f.parameters.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (r.lengths[k] < 0) {
            write_slot(slot_of(parameter), own[k][0]);
            continue;
        }
        int array = make_array(parameter, {parameter.type.base, r.lengths[k]});
        for (int i = 0; i < r.lengths[k]; ++i) store_element(array, b.i(i), own[k][size_t(i)]);
    }
    for (size_t k = 0; k < r.outside.size(); ++k) {
        const Outside& outside = r.outside[k];
        if (outside.array_length >= 0)
            make_array(*outside.symbol, {outside.symbol->type.base, outside.array_length});
        store_outside(outside, outer[k]);
    }
    Lowered result = run_function(f);

    std::vector<Value> results = {read_slot(calls_left_).c[0]};
    if (f.result.base != BaseType::Void) append(results, result);
    for (size_t k = 0; k < f.parameters.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (!parameter.output) continue;
        if (r.lengths[k] < 0) append(results, slots_[size_t(slot_of(parameter))].value);
        for (int i = 0; i < r.lengths[k]; ++i)
            append(results, load_element(array_of_[parameter.id], b.i(i)));
    }
    for (const Outside& outside : r.outside)
        if (outside.written)
            for (const Lowered& value : outside_values(outside)) append(results, value);
    if (!failed) b.ret(results);
}

}  // namespace kinora::rsl
