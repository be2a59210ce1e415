// rsl/objects/expand.cpp: rewrites the functions and shaders of a source without structs.
#include "rsl/objects/expand.h"

#include <algorithm>
#include <utility>

#include "rsl/objects/objects.h"
#include "rsl/syntax/copy_tree.h"
#include "rsl/text/did_you_mean.h"

namespace kinora::rsl {

namespace {

constexpr std::string_view kArrow = "->";

std::string_view first_name(std::string_view path) {
    return path.substr(0, path.find(kArrow));
}
bool is_member(std::string_view path) {
    return path.find(kArrow) != std::string_view::npos;
}

// Methods and functions of struct arguments have names that no source can have: the checker then
// needs to know nothing of structs. The part that the user wrote comes first.
std::string method_name(const StructDefinition& owner, std::string_view name) {
    return std::string(owner.name) + "->" + std::string(name);
}

}  // namespace

template <class... Args>
Finding& ObjectExpander::report(const FindingInfo& info, const SourceSpan& span,
                                const Args&... args) {
    const Token& token = ast_.tokens.tokens[span.token];
    return reporter_.report(info, span.where, token.macro, token.spelling, args...);
}

// ---- names --------------------------------------------------------------------------------------

const Symbol* ObjectExpander::find(std::string_view name) const {
    for (size_t i = scopes_.size(); i-- > 0;)
        for (size_t k = scopes_[i].symbols.size(); k-- > 0;)
            if (scopes_[i].symbols[k]->name == name) return scopes_[i].symbols[k];
    return nullptr;
}

// A member named alone in a method; null where something nearer has the name.
const Symbol* ObjectExpander::member_of_object(std::string_view name) const {
    return owner_ && !find(name) ? find_member(*owner_, name) : nullptr;
}

bool ObjectExpander::is_local_function(std::string_view name) const {
    for (const Scope& scope : scopes_)
        if (std::find(scope.functions.begin(), scope.functions.end(), name) !=
            scope.functions.end())
            return true;
    return false;
}

void ObjectExpander::want(std::string_view name, const StructDefinition* owner) {
    for (Candidate& candidate : candidates_)
        if (candidate.name == name && candidate.owner == owner) candidate.wanted = true;
}

// The last member of the path; *value is set where that is of struct type.
const Symbol* ObjectExpander::resolve(std::string_view path, const SourceSpan& span,
                                      StructValue* value) {
    std::string_view first = first_name(path);
    const Symbol* symbol = first == "this" ? nullptr : find(first);
    const StructDefinition* structure = symbol ? symbol->structure : nullptr;
    std::string name(path);
    bool array = symbol && symbol->type.is_array();
    if (const Symbol* member = symbol ? nullptr : member_of_object(first)) {
        symbol = member;
        structure = member->structure;
        array = member->type.is_array();
        name = "this->" + name;
    } else if (first == "this" && owner_) {
        structure = owner_;
    }
    if (!structure) {
        if (first == "this" && !find("this"))
            report(Code::RSL_2, span, "'this' as a shader's handle");
        else if (!symbol)
            report(Code::RSL_UNKNOWN_VARIABLE, span, first);
        else
            report(Code::RSL_NOT_STRUCT, span, first);
        return nullptr;
    }
    std::string_view rest = path.substr(first.size());
    while (!rest.empty()) {
        rest.remove_prefix(kArrow.size());
        std::string_view next = first_name(rest);
        symbol = structure ? find_member(*structure, next) : nullptr;
        if (!symbol && structure) {
            std::vector<std::string_view> names;
            for (const Symbol* member : structure->members) names.push_back(member->name);
            report(Code::RSL_NO_MEMBER, span, structure->name, next).help = meant_help(next, names);
            return nullptr;
        }
        if (!symbol) {
            report(Code::RSL_NOT_STRUCT, span, path.substr(0, path.size() - rest.size() - 2));
            return nullptr;
        }
        array = array || symbol->type.is_array();
        structure = symbol->structure;
        rest.remove_prefix(next.size());
    }
    if (structure && value) *value = {structure, name, nullptr, array};
    return symbol;
}

// The members of a value; an error where they are too many.
std::vector<Expr*> ObjectExpander::parts(const StructValue& value, const SourceSpan& span) {
    bool room = copied_ <= kMostCopiedNodes;
    std::vector<Expr*> made = parts_of(ast_, value, span, &copied_);
    if (room && copied_ > kMostCopiedNodes) report(Code::RSL_TOO_DEEP, span);
    made.resize(leaves_of(*value.structure).size(), TreeBuilder(ast_, span).number(0));
    return made;
}

// What an expression names of struct type; nothing where it is plain.
StructValue ObjectExpander::struct_value(Expr& e) {
    StructValue value;
    auto* element = as_if<IndexExpr>(&e);
    auto* named = as_if<VariableExpr>(element ? element->array : &e);
    if (!named) return value;
    std::string_view first = first_name(named->name);
    const Symbol* symbol = find(first);
    if (!symbol) symbol = member_of_object(first);
    bool object = first == "this" && owner_;
    if (!object && (!symbol || !symbol->structure)) return value;
    if (object && !is_member(named->name)) return {owner_, "this", nullptr, false};
    resolve(named->name, named->span, &value);
    if (element && value.structure) {
        expr(element->index);
        value.index = element->index;
        value.array = false;
    }
    return value;
}

// ---- definitions --------------------------------------------------------------------------------

void ObjectExpander::run() {
    for (Function* f : ast_.functions) candidates_.push_back({f, f->name, nullptr});
    for (const StructDefinition* structure : ast_.structs)
        for (Function* method : structure->methods)
            candidates_.push_back({method, method->name, structure});
    scopes_.emplace_back();
    for (ShaderDefinition* s : ast_.shaders) shader(*s);
    for (bool again = true; again;) {
        again = false;
        for (size_t i = 0; i < candidates_.size(); ++i) {
            Candidate& candidate = candidates_[i];
            if (!candidate.wanted || candidate.done) continue;
            candidate.done = again = true;
            function(*candidate.function, candidate.owner);
        }
    }
    ast_.functions.clear();
    for (const Candidate& candidate : candidates_)
        if (candidate.done) ast_.functions.push_back(candidate.function);
}

// Parameters of struct types become their members; a method has those of its object before.
void ObjectExpander::formals(Function& f, const StructDefinition* owner) {
    std::vector<Symbol*> parameters;
    auto add_object = [&](std::string_view name, const StructDefinition& structure) {
        Symbol object;
        object.kind = SymbolKind::FunctionParameter;
        object.name = name;
        object.structure = &structure;
        object.span = f.span;
        object.function = &f;
        for (Symbol* part : expanded(ast_, object)) parameters.push_back(part);
    };
    std::string mangled;
    if (owner) add_object("this", *owner);
    for (Symbol* parameter : f.parameters) {
        declare(*parameter);
        if (parameter->structure) {
            mangled += " " + std::string(parameter->structure->name);
            for (Symbol* part : expanded(ast_, *parameter)) parameters.push_back(part);
        } else {
            if (parameter->initial) expr(parameter->initial);
            parameters.push_back(parameter);
        }
    }
    if (f.result_structure) add_object("return", *f.result_structure);
    if (f.result_structure) mangled += " return";
    f.parameters = ast_.arena.copy(parameters);
    std::string name = owner ? method_name(*owner, f.name) : std::string(f.name);
    if (owner || !mangled.empty()) f.name = ast_.arena.copy(name + mangled);
}

void ObjectExpander::function(Function& f, const StructDefinition* owner) {
    const StructDefinition* owner_before = owner_;
    const StructDefinition* result_before = std::exchange(result_, f.result_structure);
    Function* function_before = std::exchange(function_, &f);
    if (owner) owner_ = owner;
    scopes_.emplace_back();
    formals(f, owner);
    f.body->body = list(f.body->body);
    scopes_.pop_back();
    function_ = function_before;
    owner_ = owner_before;
    result_ = result_before;
}

void ObjectExpander::shader(ShaderDefinition& shader) {
    scopes_.emplace_back();
    for (Symbol* parameter : shader.parameters) {
        if (parameter->structure)
            report(Code::RSL_2, parameter->span, "a parameter of a shader that is a struct");
        if (parameter->initial) expr(parameter->initial);
        declare(*parameter);
    }
    if (shader.shader_class) {
        ClassDefinition& c = *shader.shader_class;
        class_ = &shader;
        for (Function* method : c.methods) scopes_.back().functions.push_back(method->name);
        for (Function* method : c.methods)
            if (method->result_structure) results_[method] = method->result_structure;
        Stmts members;
        for (Stmt* member : c.members) statement(member, members);
        c.members = ast_.arena.copy(members);
        for (Function* method : c.methods) function(*method, nullptr);
        class_ = nullptr;
    } else {
        shader.body->body = list(shader.body->body);
    }
    scopes_.pop_back();
}

// ---- statements ---------------------------------------------------------------------------------

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
            exprs(s.args);
            s.body = single(s.body);
            s.missed = single(s.missed);
            break;
        }
        case StmtKind::Extern:
            for (Symbol* symbol : as<ExternStmt>(*stmt).symbols)
                if (symbol->structure) return;  // the name means the variable outside anyway
            break;
        case StmtKind::Break:
        case StmtKind::Continue:
            break;
    }
    out.push_back(stmt);
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
            if (symbol->initial) expr(symbol->initial);
            if (symbol->length) expr(symbol->length);
            declare(*symbol);
            out.push_back(make.declare({symbol}));
            continue;
        }
        if (symbol->length) expr(symbol->length);
        if (symbol->type.is_array())
            for (const Leaf& leaf : leaves_of(*symbol->structure))
                if (leaf.member->type.is_array())
                    return void(
                        report(Code::RSL_STRUCT_ARRAYS, symbol->span, symbol->structure->name));
        out.push_back(make.declare(expanded(ast_, *symbol)));
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
    expr(s.expression);
    out.push_back(&s);
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

// a = b of structs: member by member.
bool ObjectExpander::assign_struct(AssignExpr& e, Stmts& out) {
    StructValue target = struct_value(*e.target);
    if (!target.structure) return false;
    std::vector<Expr*> targets = parts(target, e.target->span);
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
        assign_parts(targets, parts(result, e.span), e.span, out);
        return true;
    }
    StructValue value = struct_value(*e.value);
    if (value.structure != target.structure || value.array != target.array || e.op != Op::None) {
        report(Code::RSL_STRUCT_VALUE, e.value->span, target.structure->name);
        return true;
    }
    assign_parts(targets, parts(value, e.value->span), e.span, out);
    return true;
}

// resize(), push() and such of an array of structs: of each member's array.
bool ObjectExpander::array_call(CallExpr& e, Stmts& out) {
    bool counts = e.name == "resize" || e.name == "reserve";
    if ((!counts && e.name != "push" && e.name != "pop") || e.args.empty()) return false;
    StructValue array = struct_value(*e.args[0]);
    if (!array.structure || !array.array) return false;
    TreeBuilder make(ast_, e.span);
    std::vector<Expr*> arrays = parts(array, e.args[0]->span), values(arrays.size());
    if (counts && e.args.size() > 1) {
        expr(e.args[1]);
        for (Expr*& value : values) value = copy_tree(ast_, *e.args[1]);
    } else if (e.name == "push" && e.args.size() > 1) {
        StructValue value = struct_value(*e.args[1]);
        if (value.structure != array.structure) {
            report(Code::RSL_STRUCT_VALUE, e.args[1]->span, array.structure->name);
            return true;
        }
        values = parts(value, e.args[1]->span);
    }
    for (size_t k = 0; k < arrays.size(); ++k) {
        std::vector<Expr*> args{arrays[k]};
        if (values[k]) args.push_back(values[k]);
        out.push_back(make.effect(make.call(e.name, args)));
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

// ---- expressions --------------------------------------------------------------------------------

void ObjectExpander::exprs(std::span<Expr*> items) {
    for (Expr*& item : items) expr(item);
}

void ObjectExpander::expr(Expr*& slot) {
    switch (slot->kind) {
        case ExprKind::Number:
        case ExprKind::String:
            return;
        case ExprKind::Variable:
            return variable(as<VariableExpr>(*slot));
        case ExprKind::Index: {
            auto& e = as<IndexExpr>(*slot);
            expr(e.array);
            return expr(e.index);
        }
        case ExprKind::Component:
            expr(as<ComponentExpr>(*slot).operand);
            return expr(as<ComponentExpr>(*slot).index);
        case ExprKind::Unary:
            return expr(as<UnaryExpr>(*slot).operand);
        case ExprKind::Binary:
            expr(as<BinaryExpr>(*slot).left);
            return expr(as<BinaryExpr>(*slot).right);
        case ExprKind::Select:
            expr(as<SelectExpr>(*slot).condition);
            expr(as<SelectExpr>(*slot).yes);
            return expr(as<SelectExpr>(*slot).no);
        case ExprKind::Assign:
            if (StructValue target = struct_value(*as<AssignExpr>(*slot).target); target.structure)
                return void(report(Code::RSL_STRUCT_AS_VALUE, slot->span));
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
    } else if (const Symbol* symbol = find(e.name)) {
        value.structure = symbol->structure;
    } else if (const Symbol* member = member_of_object(e.name)) {
        value.structure = member->structure;
        e.name = ast_.arena.copy("this->" + std::string(e.name));
    } else if (e.name == "this") {
        report(Code::RSL_2, e.span, "'this' as a shader's handle");
    } else if (e.name == "null") {
        report(Code::RSL_2, e.span, "'null' (no co-shader)");
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
        if (named && named->name == "this")
            report(Code::RSL_2, object->span, "'this' as a shader's handle");
        else if (named && !is_member(named->name) && !find(named->name) &&
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

// Arguments of struct types become their members; `results` are behind them all.
void ObjectExpander::call(CallExpr& e, std::vector<Expr*> results) {
    std::vector<Expr*> args;
    bool own =
        owner_ && !e.method && !is_local_function(e.name) &&
        std::any_of(owner_->methods.begin(), owner_->methods.end(), [&](const Function* method) {
            return method_name(*owner_, e.name) == method->name || method->name == e.name ||
                   method->name.starts_with(method_name(*owner_, e.name) + " ");
        });
    if (e.method) {
        if (!object_call(e, args)) return;
    } else if (own) {
        args = parts({owner_, "this", nullptr, false}, e.span);
        want(e.name, owner_);
        e.name = ast_.arena.copy(method_name(*owner_, e.name));
    } else {
        want(e.name, nullptr);
    }
    std::string mangled;
    for (Expr*& argument : e.args) {
        StructValue value = struct_value(*argument);
        if (!value.structure) {
            expr(argument);
            args.push_back(argument);
            continue;
        }
        std::vector<Expr*> members = parts(value, argument->span);
        if (value.array && (e.name == "arraylength" || e.name == "capacity")) {
            args.push_back(members[0]);
            continue;
        }
        mangled += " " + std::string(value.structure->name);
        args.insert(args.end(), members.begin(), members.end());
    }
    if (e.channel) expr(e.channel);
    if (!results.empty()) mangled += " return";
    args.insert(args.end(), results.begin(), results.end());
    e.args = ast_.arena.copy(args);
    if (!mangled.empty()) e.name = ast_.arena.copy(std::string(e.name) + mangled);
}

// -------------------------------------------------------------------------------------------------

bool expand_objects(Ast& ast, Reporter& reporter) {
    auto arrow = [](const Token& token) { return token.punct == Punct::Arrow; };
    const auto& tokens = ast.tokens.tokens;
    bool classes = std::any_of(ast.shaders.begin(), ast.shaders.end(),
                               [](const ShaderDefinition* s) { return s->shader_class; });
    if (ast.structs.empty() && !classes && std::none_of(tokens.begin(), tokens.end(), arrow))
        return true;
    int errors = reporter.errors();
    if (!check_structs(ast, reporter)) return false;
    ObjectExpander(ast, reporter).run();
    for (ShaderDefinition* shader : ast.shaders)
        if (shader->shader_class) make_pipeline(ast, reporter, *shader);
    return reporter.errors() == errors;
}

}  // namespace kinora::rsl
