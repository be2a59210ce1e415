// rsl/lower/builtin_call.cpp: calls of built-ins: their arguments, pairs and outputs.
#include "rsl/lower/builtin_call.h"

#include <algorithm>

#include "rsl/model/pairs.h"

namespace kinora::rsl {

LowerCall::LowerCall(const BuiltinTools& tools, const CallExpr& expr)
    : BuiltinTools(tools),
      b(tools.e.b),
      call(expr),
      result(zero(tools.e, expr.type.base == BaseType::Void ? BaseType::Float : expr.type.base)) {}

void report_idle_pair(Emitter& e, LoweringContext& context, std::string_view callee,
                      std::string_view name, const Lowered& value, Location where) {
    const std::string* text =
        value.type == BaseType::String ? e.constant_text(value.c[0]) : nullptr;
    if (is_idle_option(callee, name, text))
        context.report(Code::RSL_PAIR_IDLE, where, name, callee);
}

Lowered lower_builtin(const BuiltinTools& tools, const CallExpr& e) {
    LowerCall call(tools, e);
    Variables& variables = tools.variables;
    TreeWalk& tree = tools.tree;
    size_t plain = e.signature->pairs ? std::min<size_t>(e.pairs, e.args.size()) : e.args.size();
    auto& declared = e.signature->arguments;
    for (size_t k = 0; k < plain; ++k) {
        bool output = k < declared.size() && declared[k].output;
        bool array = e.args[k]->type.is_array();
        call.targets.push_back(output && !array ? variables.target(*e.args[k]) : LValue{});
        call.args.push_back(array    ? Lowered{}
                            : output ? variables.load(call.targets.back())
                                     : tree.expr(*e.args[k]));
    }
    for (size_t k = plain; k + 1 < e.args.size(); k += 2) {
        const std::string* name = tools.e.constant_text(tree.value(*e.args[k]));
        if (name && is_output_pair(e, k + 1))
            call.output_pairs.push_back({*name, variables.target(*e.args[k + 1])});
        else if (name && e.args[k + 1]->type.is_array()) {
            report_idle_pair(tools.e, tools.context, e.name, *name, {}, e.args[k]->span.where);
        } else if (name) {
            call.pairs.push_back({*name, tree.expr(*e.args[k + 1])});
            report_idle_pair(tools.e, tools.context, e.name, *name, call.pairs.back().second,
                             e.args[k]->span.where);
        }
    }
    e.builtin->lower(call);
    return call.result;
}

void LowerCall::set_output(int i, const Lowered& value) {
    variables.store(targets[size_t(i)], value);
}

const std::string* LowerCall::text(int i) const {
    const std::string* text = e.constant_text(args[size_t(i)].c[0]);
    if (!text)
        context.error(Code::RSL_STRING_NOT_CONSTANT, call.args[size_t(i)]->span.where, call.name);
    return text;
}

bool LowerCall::has_pair(std::string_view name) const {
    for (auto& [key, value] : pairs)
        if (key == name) return true;
    return false;
}

Value LowerCall::pair(std::string_view name, float otherwise) const {
    CHECK(takes_option(call.name, name));
    for (auto& [key, value] : pairs)
        if (key == name && value.type != BaseType::String) return value.c[0];
    return b.f(otherwise);
}

Value LowerCall::largest_pair(std::string_view name, float otherwise) const {
    CHECK(takes_option(call.name, name));
    for (auto& [key, value] : pairs) {
        if (key != name || value.type == BaseType::String) continue;
        if (!is_triple(value.type)) return value.c[0];
        return b.max(b.max(value.c[0], value.c[1]), value.c[2]);
    }
    return b.f(otherwise);
}

Value LowerCall::text_pair(std::string_view name) const {
    CHECK(takes_option(call.name, name));
    for (auto& [key, value] : pairs)
        if (key == name && value.type == BaseType::String) return value.c[0];
    return b.i(0);
}

void LowerCall::report_unknown_pairs() const {
    for (size_t k = call.pairs; k + 1 < call.args.size(); k += 2) {
        std::string_view key = pair_name(call.args, k + 1);
        if (!takes_option(call.name, key) && !is_output_pair(call, k + 1))
            context.report(Code::RSL_PAIR_UNKNOWN, call.args[k]->span.where, key, call.name);
    }
}

LValue* LowerCall::output_pair(std::string_view name) {
    for (auto& [key, target] : output_pairs)
        if (key == name) return &target;
    return nullptr;
}

}  // namespace kinora::rsl
