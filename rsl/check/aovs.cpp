// rsl/check/aovs.cpp: writeaov() and readaov(): outputs that a shader has without declaring them.
#include "rsl/check/aovs.h"

#include <algorithm>

#include "rsl/check/convert.h"

namespace kinora::rsl {

void NamedOutputs::begin() {
    for (const ShaderDefinition* shader : ast_.shaders)
        for (Symbol* parameter : shader->parameters)
            if (parameter->output && !parameter->type.is_array())
                outputs_.emplace(parameter->name, parameter);
}

Expr* NamedOutputs::named(Symbol& symbol, const SourceSpan& span) {
    auto* node = ast_.make<VariableExpr>(span);
    node->name = symbol.name;
    node->symbol = &symbol;
    node->type = symbol.type;
    return node;
}

Expr* NamedOutputs::assign(Expr* target, Expr* value, const SourceSpan& span) {
    auto* node = ast_.make<AssignExpr>(span);
    node->target = target;
    node->value = value;
    node->type = target->type;
    return node;
}

void NamedOutputs::bind(Expr*& slot, CallExpr& e) {
    const auto* name = e.args.size() == 2 ? as_if<StringExpr>(e.args[0]) : nullptr;
    Type type = e.args.size() == 2 ? e.args[1]->type : Type{};
    if (!name || type.is_array() || type.base == BaseType::Void) {
        Finding& finding = reporter_.report(Code::RSL_ARGUMENT_FORM, e.span, e.name,
                                            "a constant string and one value or variable");
        if (!name && e.args.size() == 2 && ast_.shaders.size() > 1)
            finding.help = "names made at run time need a source of one shader";
        return;
    }
    if (type.base == BaseType::Invalid) return;
    if (type.base == BaseType::Bool) type.base = BaseType::Float;
    auto found = outputs_.find(name->value);
    bool reads = e.name == "readaov";
    if (found == outputs_.end() && reads) {
        auto* none = ast_.make<NumberExpr>(e.span);
        none->type = {BaseType::Float, -1};
        slot = none;
        return;
    }
    if (found == outputs_.end()) {
        auto* symbol = ast_.arena.make<Symbol>();
        symbol->kind = SymbolKind::Parameter;
        symbol->name = name->value;
        symbol->type = type;
        symbol->detail = Detail::Varying;
        symbol->output = true;
        symbol->id = ast_.symbol_count++;
        symbol->span = e.span;
        found = outputs_.emplace(symbol->name, symbol).first;
    }
    Symbol& output = *found->second;
    Expr* aov = named(output, e.span);
    if (!reads) {
        if (!convert(ast_, e.args[1], output.type.base))
            reporter_.report(Code::RSL_TYPE_MISMATCH, e.args[1]->span,
                             fmt::format("output '{}'", output.name), type_name(output.type),
                             type_name(type));
        assignments_.mark(output, e.span);
        slot = assign(aov, e.args[1], e.span);
        return;
    }
    Expr* value = aov;
    if (!convert(ast_, value, type.base) || !assignments_.assign(*e.args[1])) {
        reporter_.report(Code::RSL_OUTPUT_TYPE, e.args[1]->span, 2, e.name, type_name(output.type),
                         type_name(type));
        return;
    }
    // The value is 1: the variable is what it was given.
    auto* same = ast_.make<BinaryExpr>(e.span);
    same->op = Op::Equal;
    same->left = assign(e.args[1], value, e.span);
    same->right = named(output, e.span);
    convert(ast_, same->right, type.base);
    same->type = {BaseType::Bool, -1};
    auto* yes = ast_.make<NumberExpr>(e.span);
    yes->value = 1;
    yes->type = {BaseType::Float, -1};
    Expr* always = yes;
    convert_to_condition(ast_, always);
    auto* either = ast_.make<BinaryExpr>(e.span);
    either->op = Op::Or;
    either->left = same;
    either->right = always;
    either->type = {BaseType::Bool, -1};
    slot = either;
}

void NamedOutputs::end(ShaderDefinition& shader) {
    std::vector<Symbol*> parameters(shader.parameters.begin(), shader.parameters.end());
    for (auto& [name, symbol] : outputs_) {
        // Clang 14 captures no structured binding.
        auto same_name = [&wanted = name](const Symbol* p) { return p->name == wanted; };
        if (std::none_of(parameters.begin(), parameters.end(), same_name))
            parameters.push_back(symbol);
    }
    if (parameters.size() != shader.parameters.size())
        shader.parameters = ast_.arena.copy(parameters);
}

}  // namespace kinora::rsl
