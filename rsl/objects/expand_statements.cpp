// rsl/objects/expand_statements.cpp: statements with values of struct types, member by member.
#include "rsl/objects/expand.h"

#include <cmath>

#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

std::span<Stmt*> ObjectExpander::list(std::span<Stmt*> body) {
    scopes_.emplace_back();
    for (Stmt* stmt : body)
        if (auto* nested = as_if<FunctionStmt>(stmt)) {
            scopes_.back().functions.push_back(nested->function->name);
            if (nested->function->result_structure)
                results_[nested->function] = nested->function->result_structure;
        }
    Stmts out;
    for (Stmt* stmt : body) statement(stmt, out);
    scopes_.pop_back();
    return ast_.arena.copy(out);
}

Stmt* ObjectExpander::single(Stmt* stmt) {
    if (!stmt) return nullptr;
    Stmts out;
    statement(stmt, out);
    return out.size() == 1 ? out[0] : TreeBuilder(ast_, stmt->span).block(std::move(out));
}

void ObjectExpander::statement(Stmt* stmt, Stmts& out) {
    switch (stmt->kind) {
        case StmtKind::Block:
            as<BlockStmt>(*stmt).body = list(as<BlockStmt>(*stmt).body);
            break;
        case StmtKind::Declare:
            return declaration(as<DeclareStmt>(*stmt), out);
        case StmtKind::DefineFunction:
            function(*as<FunctionStmt>(*stmt).function, nullptr);
            break;
        case StmtKind::Expression:
            return effect(as<ExpressionStmt>(*stmt), out);
        case StmtKind::If: {
            auto& s = as<IfStmt>(*stmt);
            expr(s.condition);
            s.yes = single(s.yes);
            s.no = single(s.no);
            break;
        }
        case StmtKind::While: {
            auto& s = as<WhileStmt>(*stmt);
            expr(s.condition);
            s.body = single(s.body);
            break;
        }
        case StmtKind::For: {
            auto& s = as<ForStmt>(*stmt);
            scopes_.emplace_back();
            Stmts init;
            for (Stmt* item : s.init) statement(item, init);
            s.init = ast_.arena.copy(init);
            if (s.condition) expr(s.condition);
            exprs(s.step);
            s.body = single(s.body);
            scopes_.pop_back();
            break;
        }
        case StmtKind::Return:
            return give_back(as<ReturnStmt>(*stmt), out);
        case StmtKind::Illuminance:
            exprs(as<IlluminanceStmt>(*stmt).args);
            as<IlluminanceStmt>(*stmt).body = single(as<IlluminanceStmt>(*stmt).body);
            break;
        case StmtKind::Illuminate: {
            auto& s = as<IlluminateStmt>(*stmt);
            for (Expr** part : {&s.position, &s.axis, &s.angle})
                if (*part) expr(*part);
            s.body = single(s.body);
            break;
        }
        case StmtKind::Solar: {
            auto& s = as<SolarStmt>(*stmt);
            for (Expr** part : {&s.axis, &s.angle})
                if (*part) expr(*part);
            s.body = single(s.body);
            break;
        }
        case StmtKind::Gather: {
            auto& s = as<GatherStmt>(*stmt);
            gather_region(s);
            exprs(s.args);
            s.body = single(s.body);
            s.missed = single(s.missed);
            break;
        }
        case StmtKind::Extern:
            for (Symbol* symbol : as<ExternStmt>(*stmt).symbols) {
                if (symbol->structure || symbol->handle)
                    return;  // the name means the variable outside anyway
                symbol->name = placed(symbol->name);
            }
            break;
        case StmtKind::Break:
        case StmtKind::Continue:
            break;
    }
    out.push_back(stmt);
}

// gather(what, P, region, ...) of a filterregion: its direction and angle.
void ObjectExpander::gather_region(GatherStmt& s) {
    StructValue region = s.args.size() > 2 ? struct_value(*s.args[2]) : StructValue();
    if (!region.structure || region.structure->name != "filterregion" || region.index) return;
    TreeBuilder make(ast_, s.args[2]->span);
    std::string_view name = as<VariableExpr>(*s.args[2]).name;
    auto member = [&](const char* which) {
        return make.variable(std::string(name) + "->" + which);
    };
    auto direction = [&] { return make.cast(BaseType::Vector, member("centre")); };
    std::vector<Expr*> args(s.args.begin(), s.args.end());
    args[2] = direction();
    args.insert(args.begin() + 3,
                make.call("atan", {member("radius"), make.call("length", {direction()})}));
    s.args = ast_.arena.copy(args);
}

void ObjectExpander::assign_parts(const std::vector<Expr*>& targets,
                                  const std::vector<Expr*>& values, const SourceSpan& span,
                                  Stmts& out) {
    TreeBuilder make(ast_, span);
    for (size_t k = 0; k < targets.size(); ++k) out.push_back(make.assign(targets[k], values[k]));
}

// A variable of struct type: its members, and where it has a value their assignments.
void ObjectExpander::declaration(DeclareStmt& s, Stmts& out) {
    TreeBuilder make(ast_, s.span);
    for (Symbol* symbol : s.symbols) {
        if (!symbol->structure) {
            const CallExpr* lights = handles_.take_lights(*symbol);
            if (lights && !function_ && class_) report(Code::RSL_LIGHT_QUERY, symbol->span);
            handles_.declaration(*symbol);
            if (symbol->initial) expr(symbol->initial);
            if (symbol->length) expr(symbol->length);
            declare(*symbol);
            out.push_back(make.declare({symbol}));
            if (lights) out.push_back(handles_.fill_with_lights(*lights, symbol->name));
            continue;
        }
        if (symbol->length) expr(symbol->length);
        if (symbol->type.is_array() && has_open_arrays(*symbol->structure))
            return void(report(Code::RSL_STRUCT_ARRAYS, symbol->span, symbol->structure->name));
        std::vector<Symbol*> members = expanded(ast_, *symbol);
        for (Symbol* member : members)
            if (member->initial) expr(member->initial);
        out.push_back(make.declare(members));
        declare(*symbol);
        if (!symbol->initial) continue;
        auto* assign = ast_.make<AssignExpr>(symbol->span);
        assign->target = make.variable(symbol->name);
        assign->value = symbol->initial;
        if (symbol->initial->kind == ExprKind::ArrayLiteral) continue;  // "S a[] = {}"
        if (!assign_struct(*assign, out))
            report(Code::RSL_STRUCT_VALUE, symbol->span, symbol->structure->name);
    }
}

void ObjectExpander::effect(ExpressionStmt& s, Stmts& out) {
    if (auto* assign = as_if<AssignExpr>(s.expression); assign && assign_struct(*assign, out))
        return;
    if (auto* call = as_if<CallExpr>(s.expression); call && array_call(*call, out)) return;
    handles_.list_to_variable(s, out);
    bool call = s.expression->kind == ExprKind::Call;
    expr(s.expression);
    if (call && s.expression->kind == ExprKind::Number) return;  // a call of null
    out.push_back(&s);
}
// a = b of structs: member by member.
bool ObjectExpander::assign_struct(AssignExpr& e, Stmts& out) {
    StructValue target = struct_value(*e.target);
    if (!target.structure) return false;
    if (auto* node = as_if<CallExpr>(e.value);
        node && handles_.is_call(*node) && !handles_.resolve(*node))
        return true;
    bool apart = target.index && has_arrays(*target.structure);
    std::vector<Expr*> targets =
        parts(target, e.target->span, apart ? Parts::Elements : Parts::Whole);
    if (const Function* giver = function_giving_struct(*e.value);
        giver && e.op == Op::None && giver->result_structure == target.structure) {
        // Through a variable of its own: the target may be among the arguments.
        StructValue result{target.structure, fmt::format("result{}->", temporaries_++), nullptr,
                           false};
        Symbol* symbol = TreeBuilder(ast_, e.span)
                             .symbol(SymbolKind::Local, result.name, {BaseType::Invalid, -1});
        symbol->structure = target.structure;
        symbol->function = function_;
        out.push_back(TreeBuilder(ast_, e.span).declare(expanded(ast_, *symbol)));
        auto& node = as<CallExpr>(*e.value);
        call(node, parts(result, e.span));
        out.push_back(TreeBuilder(ast_, e.span).effect(&node));
        assign_parts(targets, parts(result, e.span, apart ? Parts::Elements : Parts::Whole), e.span,
                     out);
        return true;
    }
    StructValue value = struct_value(*e.value);
    if (value.structure != target.structure || value.array != target.array || e.op != Op::None) {
        report(Code::RSL_STRUCT_VALUE, e.value->span, target.structure->name);
        return true;
    }
    if (!apart && value.index && has_arrays(*value.structure)) {
        apart = true;
        targets = parts(target, e.target->span, Parts::Elements);
    }
    assign_parts(targets, parts(value, e.value->span, apart ? Parts::Elements : Parts::Whole),
                 e.span, out);
    return true;
}

// resize(), push() and such of an array of structs: of each member's array.
bool ObjectExpander::array_call(CallExpr& e, Stmts& out) {
    bool counts = e.name == "resize" || e.name == "reserve";
    if ((!counts && e.name != "push" && e.name != "pop") || e.args.empty()) return false;
    StructValue array = struct_value(*e.args[0]);
    if (!array.structure || !array.array) return false;
    TreeBuilder make(ast_, e.span);
    std::vector<Expr*> arrays = parts(array, e.args[0]->span), values;
    Expr* count = counts && e.args.size() > 1 ? e.args[1] : nullptr;
    if (count) expr(count);
    if (e.name == "push" && e.args.size() > 1) {
        StructValue value = struct_value(*e.args[1]);
        if (value.structure != array.structure) {
            report(Code::RSL_STRUCT_VALUE, e.args[1]->span, array.structure->name);
            return true;
        }
        values = parts(value, e.args[1]->span, Parts::Elements);
    }
    std::vector<Leaf> leaves = leaves_of(*array.structure);
    size_t next = 0;
    for (size_t k = 0; k < arrays.size(); ++k) {
        int each = std::max(leaves[k].member->type.array_length, 1);
        Expr* all = count ? copy_tree(ast_, *count) : nullptr;
        if (const auto* number = as_if<NumberExpr>(count); number && each > 1)
            all = make.number(std::floor(number->value) * each);  // known: room for as many
        else if (all && each > 1)
            all = make.binary(Op::Multiply, make.call("floor", {all}), make.number(each));
        for (int i = 0; i < (count ? 1 : each); ++i) {
            std::vector<Expr*> args{i == 0 ? arrays[k] : copy_tree(ast_, *arrays[k])};
            if (all) args.push_back(all);
            if (next < values.size()) args.push_back(values[next++]);
            out.push_back(make.effect(make.call(e.name, args)));
        }
    }
    return true;
}

// return s; of a struct: assigned to what the caller lends.
void ObjectExpander::give_back(ReturnStmt& s, Stmts& out) {
    if (!result_ || !s.value) {
        if (s.value) expr(s.value);
        out.push_back(&s);
        return;
    }
    Symbol lent;
    lent.name = "return";
    lent.structure = result_;
    scopes_.emplace_back();
    declare(lent);
    auto* assign = ast_.make<AssignExpr>(s.span);
    assign->target = TreeBuilder(ast_, s.span).variable("return");
    assign->value = s.value;
    Stmts body;
    assign_struct(*assign, body);
    scopes_.pop_back();
    s.value = nullptr;
    body.push_back(&s);
    out.push_back(TreeBuilder(ast_, s.span).block(std::move(body)));
}

}  // namespace kinora::rsl
