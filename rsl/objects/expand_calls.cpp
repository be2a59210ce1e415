// rsl/objects/expand_calls.cpp: expressions; calls of methods, and calls with structs.
#include "rsl/objects/expand.h"

#include <algorithm>

#include "rsl/text/did_you_mean.h"

namespace kinora::rsl {

void ObjectExpander::exprs(std::span<Expr*> items) {
    for (Expr*& item : items) expr(item);
}

// A constant member is set by its first value and in construct().
void ObjectExpander::judge_constant(const Expr& target) {
    const auto* element = as_if<IndexExpr>(&target);
    const auto* named = as_if<VariableExpr>(element ? element->array : &target);
    const Symbol* symbol = named ? find(named->name) : nullptr;
    if (symbol && symbol->constant && class_ && function_ && function_->name != "construct")
        report(Code::RSL_CONSTANT_CHANGED, target.span, symbol->name);
}

void ObjectExpander::expr(Expr*& slot) {
    handles_.check(*slot);
    if (handles_.rewrite(slot)) return;
    switch (slot->kind) {
        case ExprKind::Number:
        case ExprKind::String:
            return;
        case ExprKind::Variable:
            return variable(as<VariableExpr>(*slot));
        case ExprKind::Index: {
            auto& e = as<IndexExpr>(*slot);
            auto* element = as_if<IndexExpr>(e.array);
            if (int length = element ? inner_length(*element) : 0) {  // a[i]->list[j]
                expr(element->array);
                expr(element->index);
                expr(e.index);
                e.array = element->array;
                e.index = flat_index(ast_, e.span, element->index, length, e.index);
                return;
            }
            if (inner_length(e) > 0)
                return void(report(Code::RSL_STRUCT_ELEMENT, e.span,
                                   fmt::format("'{}'", as<VariableExpr>(*e.array).name)));
            expr(e.array);
            return expr(e.index);
        }
        case ExprKind::Component:
            expr(as<ComponentExpr>(*slot).operand);
            return expr(as<ComponentExpr>(*slot).index);
        case ExprKind::Unary:
            return expr(as<UnaryExpr>(*slot).operand);
        case ExprKind::Binary:
            return operators(as<BinaryExpr>(*slot));
        case ExprKind::Select:
            expr(as<SelectExpr>(*slot).condition);
            expr(as<SelectExpr>(*slot).yes);
            return expr(as<SelectExpr>(*slot).no);
        case ExprKind::Assign:
            if (StructValue target = struct_value(*as<AssignExpr>(*slot).target); target.structure)
                return void(report(Code::RSL_STRUCT_AS_VALUE, slot->span));
            judge_constant(*as<AssignExpr>(*slot).target);
            expr(as<AssignExpr>(*slot).target);
            return expr(as<AssignExpr>(*slot).value);
        case ExprKind::Call:
            if (function_giving_struct(*slot))
                return void(report(Code::RSL_STRUCT_AS_VALUE, slot->span));
            return call(as<CallExpr>(*slot));
        case ExprKind::Cast:
            if (as<CastExpr>(*slot).space) expr(as<CastExpr>(*slot).space);
            return expr(as<CastExpr>(*slot).operand);
        case ExprKind::Triple:
            return exprs(as<TripleExpr>(*slot).items);
        case ExprKind::Sixteen:
            return exprs(as<SixteenExpr>(*slot).items);
        case ExprKind::ArrayLiteral:
            return exprs(as<ArrayLiteralExpr>(*slot).items);
    }
}

// Along the chain: what is left of "object.member" is not looked at.
void ObjectExpander::operators(BinaryExpr& last) {
    std::vector<BinaryExpr*> chain;
    for (BinaryExpr* node = &last; node; node = as_if<BinaryExpr>(node->left)) {
        if (node != &last) handles_.check(*node);
        if (node->op == Op::Dot && struct_value(*node->left).structure) {
            report(Code::RSL_STRUCT_AS_VALUE, node->span).help =
                "members and methods of a struct follow '->'";
            break;
        }
        chain.push_back(node);
        if (node->left->kind != ExprKind::Binary) expr(node->left);
    }
    for (size_t i = chain.size(); i-- > 0;) expr(chain[i]->right);
}

// A member's name is that of the variable in its place; alone in a method it is the object's.
void ObjectExpander::variable(VariableExpr& e) {
    StructValue value;
    if (is_member(e.name)) {
        std::string_view first = first_name(e.name);
        if (first == "this" && !owner_ && class_) {  // the class's own
            e.name.remove_prefix(first.size() + kArrow.size());
            return variable(e);
        }
        if (!resolve(e.name, e.span, &value)) return;
        if (!find(first) && first != "this")
            e.name = ast_.arena.copy("this->" + std::string(e.name));
        else
            e.name = placed(e.name);
    } else if (const Symbol* symbol = find(e.name)) {
        value.structure = symbol->structure;
        e.name = placed(e.name);
    } else if (const Symbol* member = member_of_object(e.name)) {
        value.structure = member->structure;
        e.name = ast_.arena.copy("this->" + std::string(e.name));
    }
    if (value.structure) report(Code::RSL_STRUCT_AS_VALUE, e.span);
}

// object->method(...): the object's members become the first arguments. False after a finding.
bool ObjectExpander::object_call(CallExpr& e, std::vector<Expr*>& args) {
    Expr* object = e.args[0];
    e.args = e.args.subspan(1);
    e.method = false;
    const auto* named = as_if<VariableExpr>(object);
    if (named && named->name == "this" && !owner_ && class_) return true;  // the class's own
    StructValue value = struct_value(*object);
    if (!value.structure) {
        if (named && !is_member(named->name) && !find(named->name) &&
            !member_of_object(named->name))
            report(Code::RSL_UNKNOWN_VARIABLE, object->span, named->name);
        else
            report(Code::RSL_NOT_STRUCT, object->span,
                   named ? named->name : std::string_view("an element"));
        return false;
    }
    if (value.array) return report(Code::RSL_STRUCT_AS_VALUE, object->span), false;
    std::vector<std::string_view> names;
    for (const Function* method : value.structure->methods) names.push_back(method->name);
    if (value.index && has_arrays(*value.structure))
        return report(Code::RSL_STRUCT_ELEMENT, object->span,
                      fmt::format("struct '{}'", value.structure->name)),
               false;
    for (const Candidate& candidate : candidates_)
        if (candidate.owner == value.structure && candidate.name == e.name) {
            args = parts(value, object->span);
            want(e.name, value.structure);
            e.name = ast_.arena.copy(method_name(*value.structure, e.name));
            return true;
        }
    report(Code::RSL_NO_METHOD, e.span, value.structure->name, e.name).help =
        meant_help(e.name, names);
    return false;
}

// They take arrays of handles as they take others.
constexpr std::string_view kArrayFunctions[] = {"arraylength", "capacity", "resize",
                                                "reserve",     "push",     "pop"};

// A member that is no array, if there is one: as many of them as elements.
size_t plain_leaf(const StructDefinition& structure) {
    std::vector<Leaf> leaves = leaves_of(structure);
    for (size_t k = 0; k < leaves.size(); ++k)
        if (!leaves[k].member->type.is_array()) return k;
    return 0;
}

// Arguments of struct types become their members; `results` are behind them all.
void ObjectExpander::call(CallExpr& e, std::vector<Expr*> results) {
    std::vector<Expr*> args;
    auto has = [&](std::string_view name) {
        return std::ranges::any_of(owner_->methods, [&](const Function* method) {
            return method_name(*owner_, name) == method->name || method->name == name ||
                   method->name.starts_with(method_name(*owner_, name) + " ");
        });
    };
    // BASE::f() is f() where no other method stands for it.
    size_t base = e.name.find("::");
    if (owner_ && base != e.name.npos && !has(e.name)) e.name.remove_prefix(base + 2);
    bool own = owner_ && !e.method && !is_local_function(e.name) && has(e.name);
    if (e.method) {
        if (!object_call(e, args)) return;
    } else if (own) {
        args = parts({owner_, "this", nullptr, false}, e.span);
        want(e.name, owner_);
        e.name = ast_.arena.copy(method_name(*owner_, e.name));
    } else {
        e.name = function_name(e.name);
    }
    bool of_array = std::find(std::begin(kArrayFunctions), std::end(kArrayFunctions), e.name) !=
                    std::end(kArrayFunctions);
    std::string mangled;
    for (Expr*& argument : e.args) {
        StructValue value = struct_value(*argument);
        if (!value.structure) {
            if (!of_array && handles_.is_handle(*argument)) mangled += kHandleArgument;
            expr(argument);
            args.push_back(argument);
            continue;
        }
        std::vector<Expr*> members = parts(value, argument->span);
        if (value.array && (e.name == "arraylength" || e.name == "capacity")) {
            args.push_back(members[plain_leaf(*value.structure)]);
            continue;
        }
        if (value.index && has_arrays(*value.structure))
            report(Code::RSL_STRUCT_ELEMENT, argument->span,
                   fmt::format("struct '{}'", value.structure->name));
        mangled += " " + std::string(value.structure->name);
        args.insert(args.end(), members.begin(), members.end());
    }
    if (e.channel) expr(e.channel);
    if (!results.empty()) mangled += " return";
    args.insert(args.end(), results.begin(), results.end());
    e.args = ast_.arena.copy(args);
    if (!mangled.empty()) e.name = ast_.arena.copy(std::string(e.name) + mangled);
    if (top_) called_[top_].insert(e.name);
}

// A function of the unit that is called by its name.
std::string_view ObjectExpander::function_name(std::string_view name) {
    if (is_local_function(name)) return name;
    std::string_view with_prefix = ast_.arena.copy(units_[unit_].prefix() + std::string(name));
    if (is_local_function(with_prefix)) return with_prefix;
    bool own = std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& c) {
        return c.name == name && !c.owner && c.unit == unit_;
    });
    want(name, nullptr);
    return own ? with_prefix : name;
}

// The function of struct result that an expression calls; null for everything else.
const Function* ObjectExpander::function_giving_struct(const Expr& e) {
    const auto* node = as_if<CallExpr>(&e);
    if (!node) return nullptr;
    const StructDefinition* owner = nullptr;
    if (node->method) {
        const auto* object = as_if<VariableExpr>(node->args[0]);
        bool self = object && object->name == "this" && !owner_;
        if (!self) owner = struct_value(*node->args[0]).structure;
    }
    for (const auto& [method, structure] : results_)
        if (!owner && method->name.substr(0, method->name.find(' ')) == node->name) return method;
    for (const Candidate& candidate : candidates_)
        if (candidate.name == node->name && candidate.owner == owner &&
            candidate.function->result_structure)
            return candidate.function;
    return nullptr;
}

}  // namespace kinora::rsl
