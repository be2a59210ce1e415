// rsl/lower/recursion.cpp: functions that call themselves. Each becomes a function of the IR that
// takes the mask, how deep the call stands, how many calls are left, its parameters and the
// variables outside it that it names; it gives its result, its output parameters and those
// variables that it writes. A call beyond the limits is not made: a fault, and 0.
#include <fmt/format.h>

#include <algorithm>

#include "rsl/lower/calls.h"
#include "rsl/lower/values.h"
#include "rsl/model/builtin.h"
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

// ---- variables outside the function -------------------------------------------------------------

int Recursion::outside_slot(const Outside& outside) const {
    return outside.symbol ? variables_.slot_of(*outside.symbol) : int(outside.id);
}

Lowered Recursion::read_outside(const Outside& outside) {
    return outside.symbol ? variables_.read(*outside.symbol) : globals_.read(outside.id);
}

// One value, or those of an array's elements.
std::vector<Lowered> Recursion::outside_values(const Outside& outside) {
    if (outside.array_length < 0) return {read_outside(outside)};
    std::vector<Lowered> values;
    int array = variables_.array_of(*outside.symbol);
    for (int k = 0; k < outside.array_length; ++k) values.push_back(arrays_.load(array, b_.i(k)));
    return values;
}

void Recursion::store_outside(const Outside& outside, const std::vector<Lowered>& values) {
    if (outside.array_length < 0) return slots_.write(outside_slot(outside), values[0]);
    int array = variables_.array_of(*outside.symbol);
    for (int k = 0; k < outside.array_length; ++k) arrays_.store(array, b_.i(k), values[size_t(k)]);
}

// What the function names from outside, and the globals that hold something else than the kernel's
// inputs, which built-ins may read. Constants and strings are read again inside: they stay known.
void Recursion::find_outside(Recursive& r, const CallExpr& e) {
    ChangeFinder finder(context_.ast());
    finder.add(*r.function);
    const Changes& changes = finder.changes;
    r.random = changes.random;
    r.record = (changes.effects & kMessage) && lights_.any_current();
    if (!changes.light_sources.empty())
        context_.error(Code::RSL_RECURSION, e.span.where, e.name, "holds illuminate or solar");
    auto written = [&](const Symbol* symbol) {
        return std::find(changes.symbols.begin(), changes.symbols.end(), symbol) !=
               changes.symbols.end();
    };
    bool seen[size_t(Global::Count)] = {};
    for (const Symbol* symbol : finder.used) {
        bool inside = symbol->function &&
                      !(symbol->function != r.function && encloses(symbol->function, r.function));
        if (inside) continue;
        const ParamBinding* bound = context_.binding(symbol->name);
        bool known = bound && bound->kind == ParamBinding::Kind::Constant;
        bool of_layer = bound && bound->kind == ParamBinding::Kind::Layer;
        bool again = symbol->kind == SymbolKind::Parameter && !symbol->assigned && !of_layer &&
                     (known || symbol->type.base == BaseType::String || symbol->type.is_array());
        if (again) continue;
        if (symbol->global) seen[size_t(symbol->global->id)] = true;
        int array = symbol->type.is_array() ? variables_.array_of(*symbol) : -1;
        if (array >= 0 && arrays_.resizable(array))
            context_.error(Code::RSL_LENGTH_UNKNOWN, e.span.where, symbol->name);
        int length = array >= 0 ? arrays_.length(array) : -1;
        r.outside.push_back({symbol, Global::Count, length, written(symbol)});
    }
    for (size_t g = 0; g < size_t(Global::Count); ++g) {
        bool color = Global(g) == Global::Ci || Global(g) == Global::Oi;
        if (globals_.written(Global(g)) && !seen[g] && !color)
            r.outside.push_back({nullptr, Global(g), -1, false});
    }
}

// ---- calls --------------------------------------------------------------------------------------

Lowered Recursion::call(const CallExpr& e, const CallArguments& arguments) {
    size_t known = function_for(e, arguments);
    if (context_.failed)
        return zero(e_, e.type.base == BaseType::Void ? BaseType::Float : e.type.base);
    const Recursive r = functions_[known];
    const Function& f = *r.function;

    bool outermost = depth_ == jit::kNone;
    Value depth = outermost ? b_.i(0) : depth_;
    Value left = outermost ? b_.i(kMaxRecursiveCalls) : slots_.read(calls_left_).c[0];
    Value allowed = outermost ? b_.m(true) : calls_allowed(e_, e, depth, left);
    Value mask = b_.logical_and(e_.running, allowed);
    std::vector<Value> args = {mask, b_.iadd(depth, b_.i(1)), b_.isub(left, b_.i(1))};
    if (r.random) args.push_back(seeds_.path_into(e.site));
    if (r.record) args.insert(args.end(), {lights_.current().set, lights_.current().record});
    std::vector<std::vector<Lowered>> before;  // of all that comes back, then
    for (size_t k = 0; k < f.parameters.size(); ++k) {
        std::vector<Lowered> values = {arguments.values[k]};
        if (int array = arguments.arrays[k]; array >= 0) {
            values.clear();
            for (int i = 0; i < r.lengths[k]; ++i) values.push_back(arrays_.load(array, b_.i(i)));
        }
        for (const Lowered& value : values) append(args, value);
        if (f.parameters[k]->output) before.push_back(std::move(values));
    }
    for (const Outside& outside : r.outside) {
        std::vector<Lowered> values = outside_values(outside);
        for (const Lowered& value : values) append(args, value);
        if (outside.written) before.push_back(std::move(values));
    }
    std::vector<Value> results = b_.call(r.index, mask, args);

    // Where the call was not made everything is as before.
    auto next = results.begin();
    auto take = [&](Lowered value) {
        for (size_t c = 0; c < size_t(value.size()); ++c)
            value.c[c] = b_.select(allowed, *next++, value.c[c]);
        return value;
    };
    if (calls_left_ >= 0) {
        Lowered rest = slots_.read(calls_left_);
        slots_.write(calls_left_, take(rest));
    } else {
        ++next;
    }
    Lowered result = zero(e_, f.result.base == BaseType::Void ? BaseType::Float : f.result.base);
    if (f.result.base != BaseType::Void) result = take(result);
    size_t back = 0;
    for (size_t k = 0; k < f.parameters.size(); ++k) {
        if (!f.parameters[k]->output) continue;
        std::vector<Lowered>& values = before[back++];
        for (size_t i = 0; i < values.size(); ++i)
            if (arguments.arrays[k] >= 0)
                arrays_.store(arguments.arrays[k], b_.i(int(i)), take(values[i]));
            else
                variables_.store(arguments.targets[k], take(values[i]));
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
size_t Recursion::function_for(const CallExpr& e, const CallArguments& arguments) {
    bool lit = lights_.any_current();
    Recursive r{e.function, {}, lit, 0, {}, false, false};
    for (int array : arguments.arrays) r.lengths.push_back(array < 0 ? -1 : arrays_.length(array));
    for (size_t k = 0; k < functions_.size(); ++k)
        if (functions_[k].function == r.function && functions_[k].lengths == r.lengths &&
            functions_[k].lit == lit)
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
        context_.error(Code::RSL_RECURSION, e.span.where, e.name,
                       fmt::format("works on {} numbers, at most {}", count, kMaxValues));
    r.index = jit::add_function(b_.module(), std::string(r.function->name), results);
    b_.module().call_depth = kMaxCallDepth + 1;
    size_t at = functions_.size();
    functions_.push_back(r);
    if (!context_.failed) write(r);
    return at;
}

// All that belongs to the function being written, put aside for the life of the guard.
class Recursion::Activation {
  public:
    Activation(Recursion& r, size_t index)
        : builder_(r.b_, index),
          running_(r.e_.running),
          slots_(r.slots_),
          regions_(r.regions_),
          arrays_(r.arrays_),
          variables_(r.variables_),
          loops_(r.loops_),
          seeds_(r.seeds_),
          lights_(r.lights_),
          messages_(r.messages_) {}

  private:
    // Puts a value back.
    template <class T>
    class Kept {
      public:
        explicit Kept(T& value) : value_(value), outer_(value) {}
        ~Kept() { value_ = outer_; }
        Kept(const Kept&) = delete;
        Kept& operator=(const Kept&) = delete;

      private:
        T& value_;
        T outer_;
    };
    // Writes another function of the module with the same builder.
    class OtherFunction {
      public:
        OtherFunction(jit::Builder& builder, size_t index)
            : builder_(builder), outer_(std::move(builder)) {
            builder_ = jit::Builder(outer_.module(), index);
        }
        ~OtherFunction() { builder_ = std::move(outer_); }
        OtherFunction(const OtherFunction&) = delete;
        OtherFunction& operator=(const OtherFunction&) = delete;

      private:
        jit::Builder& builder_;
        jit::Builder outer_;
    };

    OtherFunction builder_;
    Kept<Value> running_;
    Apart<Slots> slots_;
    Apart<Regions> regions_;
    Apart<Arrays> arrays_;
    Apart<Variables> variables_;
    Apart<Loops> loops_;
    Apart<SampleSeeds> seeds_;
    Apart<LightRecords> lights_;
    Apart<Messages> messages_;
};

void Recursion::set_calls_left(int slot) {
    calls_left_ = slot;
    loops_.set_written_by_calls(slot);
}

std::vector<Lowered> Recursion::read_parameters(BaseType type, int length) {
    std::vector<Lowered> values(size_t(length < 0 ? 1 : length), Lowered{type, {}});
    for (Lowered& value : values)
        for (size_t c = 0; c < size_t(value.size()); ++c) value.c[c] = b_.param(ir_type(type));
    return values;
}

void Recursion::write(const Recursive& r) {
    const Function& f = *r.function;
    Value outer_depth = depth_;
    int outer_left = calls_left_;
    {
        Activation activation(*this, r.index);
        e_.running = b_.param(jit::Type::M);
        regions_.set_region(e_.running);
        depth_ = b_.param(jit::Type::I);
        Value left = b_.param(jit::Type::I);
        if (r.random) seeds_.hand_in(b_.param(jit::Type::I));
        if (r.record) {
            Value set = b_.param(jit::Type::I);
            lights_.set_current({set, b_.param(jit::Type::I)});
        }
        // All parameters stand before anything else.
        std::vector<std::vector<Lowered>> own, outer;
        for (size_t k = 0; k < f.parameters.size(); ++k)
            own.push_back(read_parameters(f.parameters[k]->type.base, r.lengths[k]));
        for (const Outside& outside : r.outside)
            outer.push_back(read_parameters(
                outside.symbol ? outside.symbol->type.base : global_info(outside.id).type.base,
                outside.array_length));
        set_calls_left(slots_.add(lowered(BaseType::String, left)));
        for (size_t k = 0; k < f.parameters.size(); ++k) {
            const Symbol& parameter = *f.parameters[k];
            if (r.lengths[k] < 0) {
                slots_.write(variables_.slot_of(parameter), own[k][0]);
                continue;
            }
            int array = variables_.make_array(parameter, {parameter.type.base, r.lengths[k]});
            for (int i = 0; i < r.lengths[k]; ++i) arrays_.store(array, b_.i(i), own[k][size_t(i)]);
        }
        for (size_t k = 0; k < r.outside.size(); ++k) {
            const Outside& outside = r.outside[k];
            if (outside.array_length >= 0)
                variables_.make_array(*outside.symbol,
                                      {outside.symbol->type.base, outside.array_length});
            store_outside(outside, outer[k]);
        }
        Lowered result = loops_.run_function(f, [&] { tree_.block(f.body->body); });

        std::vector<Value> results = {slots_.read(calls_left_).c[0]};
        if (f.result.base != BaseType::Void) append(results, result);
        for (size_t k = 0; k < f.parameters.size(); ++k) {
            const Symbol& parameter = *f.parameters[k];
            if (!parameter.output) continue;
            if (r.lengths[k] < 0) append(results, slots_.read(variables_.slot_of(parameter)));
            for (int i = 0; i < r.lengths[k]; ++i)
                append(results, arrays_.load(variables_.known_array(parameter), b_.i(i)));
        }
        for (const Outside& outside : r.outside)
            if (outside.written)
                for (const Lowered& value : outside_values(outside)) append(results, value);
        if (!context_.failed) b_.ret(results);
    }
    depth_ = outer_depth;
    calls_left_ = outer_left;
}

}  // namespace kinora::rsl
