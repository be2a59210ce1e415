// rsl/lower/calls.cpp: calls of the source's functions, as their bodies.
#include "rsl/lower/calls.h"

#include "rsl/lower/values.h"
#include "rsl/model/builtin.h"

namespace kinora::rsl {

// Whether there is room for one more body in place of a call: functions that call others twice
// double at each level.
bool Calls::may_grow(const CallExpr& e) {
    constexpr size_t kMostOperations = 1 << 18;
    size_t operations = 0;
    for (const jit::Function& function : b_.module().functions) operations += function.insts.size();
    if (operations > kMostOperations && !context_.failed)
        context_.error(Code::RSL_TOO_LARGE, e.span.where, kMostOperations);
    return !context_.failed;
}

// Functions of the IR have no lengths of arrays among their arguments.
void Calls::refuse_resizable(const Expr& argument) {
    const Symbol& symbol = *as<VariableExpr>(argument).symbol;
    if (arrays_.resizable(variables_.array_of(symbol)))
        context_.error(Code::RSL_LENGTH_UNKNOWN, argument.span.where, symbol.name);
}

CallArguments Calls::evaluate(const CallExpr& e) {
    const Function& f = *e.function;
    CallArguments arguments{std::vector<Lowered>(e.args.size()), std::vector<LValue>(e.args.size()),
                            std::vector<int>(e.args.size(), -1)};
    auto& [values, targets, arrays] = arguments;
    for (size_t k = 0; k < e.args.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (parameter.type.is_array()) {
            if (f.recursive) refuse_resizable(*e.args[k]);
            arrays[k] = f.recursive ? variables_.array_of(*as<VariableExpr>(*e.args[k]).symbol)
                                    : array_argument(e, k);
        } else if (parameter.output) {
            targets[k] = variables_.target(*e.args[k]);
            values[k] = variables_.load(targets[k]);
        } else {
            values[k] = tree_.expr(*e.args[k]);
        }
    }
    return arguments;
}

// The body in place of the call. A variable that is an output argument is the parameter while the
// body runs; elements and components are copied in and out. Other parameters are values.
Lowered Calls::lower(const CallExpr& e) {
    const Function& f = *e.function;
    if (!may_grow(e))
        return zero(e_, e.type.base == BaseType::Void ? BaseType::Float : e.type.base);
    CallArguments arguments = evaluate(e);
    if (f.recursive) return recursion_.call(e, arguments);
    auto& [values, targets, arrays] = arguments;
    for (size_t k = 0; k < e.args.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (arrays[k] >= 0) {
            variables_.lend_array(parameter, arrays[k]);
        } else if (targets[k].lends(parameter)) {
            variables_.lend_slot(parameter, targets[k].slot);
        } else {
            values[k].type = parameter.type.base;
            slots_.write(variables_.slot_of(parameter), values[k]);
        }
    }
    SampleSeeds::Path path = seeds_.enter_call(e.site, is_sample_method(f.name));
    Lowered result = loops_.run_function(f, [&] { tree_.block(f.body->body); });
    seeds_.leave_call(path);
    for (size_t k = 0; k < e.args.size(); ++k) {
        const Symbol& parameter = *f.parameters[k];
        if (arrays[k] >= 0) {
            int given = variables_.array_of(*as<VariableExpr>(*e.args[k]).symbol);
            variables_.lend_array(parameter, -1);
            if (arrays[k] != given && arrays_.resizable(arrays[k]))
                variables_.give_back_copy(parameter, arrays[k]);
        } else if (variables_.is_lent(parameter)) {
            variables_.lend_slot(parameter, -1);
        } else {
            int slot = variables_.slot_of(parameter);
            if (parameter.output) variables_.store(targets[k], Lowered(slots_.read(slot)));
            slots_.kill(slot);
        }
    }
    return result;
}

// An array handed to a function: itself, or a copy where the function writes to a value parameter
// or to the same array by another name.
int Calls::array_argument(const CallExpr& e, size_t k) {
    auto symbol = [&](const Expr* argument) {
        auto* variable = as_if<VariableExpr>(argument);
        return variable ? variable->symbol : nullptr;
    };
    const Expr& argument = *e.args[k];
    const Symbol& parameter = *e.function->parameters[k];
    bool written = parameter.assigned;
    for (size_t i = 0; i < e.args.size(); ++i)
        written |= e.function->parameters[i]->output && symbol(e.args[i]) == symbol(&argument);
    int array = variables_.array_of(*symbol(&argument));
    if (parameter.output || !written) return array;
    if (arrays_.resizable(array) || variables_.room_for(parameter) > 0) {
        int copy = variables_.take_copy(parameter);
        arrays_.copy(copy, array, argument.span.where);
        return copy;
    }
    std::vector<Lowered> values = variables_.array_values(argument);
    int copy = variables_.make_array(parameter, {parameter.type.base, int(values.size())});
    for (size_t i = 0; i < values.size(); ++i) arrays_.store(copy, b_.i(int(i)), values[i]);
    return copy;
}

}  // namespace kinora::rsl
