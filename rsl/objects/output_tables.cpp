// rsl/objects/output_tables.cpp: writeaov() and readaov() of names that are known at run time
// alone.
#include "rsl/objects/output_tables.h"

#include <algorithm>
#include <utility>

#include "rsl/objects/build_tree.h"

namespace kinora::rsl {

namespace {

// Names that no source can have.
constexpr std::string_view kWrite = "writeaov@", kRead = "readaov@";
constexpr std::string_view kName = "name of output", kValue = "value of output";
constexpr std::string_view kTurn = "turn of search";

bool is_call(std::string_view name) {
    return name == "writeaov" || name == "readaov";
}

// The texts that an expression may give: '*' stands for any.
std::string pattern_of(const Expr& e) {
    if (const auto* text = as_if<StringExpr>(&e)) return std::string(text->value);
    const auto* call = as_if<CallExpr>(&e);
    std::string pattern;
    if (call && call->name == "concat") {
        for (const Expr* part : call->args) pattern += pattern_of(*part);
        return pattern;
    }
    const auto* form =
        call && (call->name == "format" || call->name == "sprintf") && !call->args.empty()
            ? as_if<StringExpr>(call->args[0])
            : nullptr;
    if (!form) return "*";
    for (size_t k = 0; k < form->value.size(); ++k) {
        bool value = form->value[k] == '%' && k + 1 < form->value.size();
        pattern += value ? '*' : form->value[k];
        k += value;
    }
    return pattern;
}

ReturnStmt* give(Ast& ast, SourceSpan span, Expr* value) {
    auto* node = ast.make<ReturnStmt>(span);
    node->value = value;
    return node;
}

}  // namespace

bool OutputTables::are_in(const Ast& ast) {
    const auto& tokens = ast.tokens.tokens;
    for (size_t k = 0; k + 3 < tokens.size(); ++k)
        if (tokens[k].kind == TokenKind::Identifier && is_call(tokens[k].text) &&
            tokens[k + 1].punct == Punct::LeftParen &&
            (tokens[k + 2].kind != TokenKind::String || tokens[k + 3].punct != Punct::Comma))
            return true;
    return false;
}

void OutputTables::begin(const ShaderDefinition* shader) {
    auto own = [](const Function* f) { return is_call(f->name); };
    if (are_in(ast_) && std::none_of(ast_.functions.begin(), ast_.functions.end(), own))
        shader_ = shader;
}

bool OutputTables::declares(std::string_view name) const {
    return std::any_of(shader_->parameters.begin(), shader_->parameters.end(),
                       [&](const Symbol* p) { return p->output && p->name == name; });
}

bool OutputTables::rewrite(CallExpr& e) {
    if (!shader_ || !is_call(e.name) || e.args.size() != 2) return false;
    const auto* name = as_if<StringExpr>(e.args[0]);
    if (name && declares(name->value)) return false;
    if (!std::exchange(used_, true)) span_ = e.span;
    bool writes = e.name == "writeaov";
    if (writes) writes_.push_back({ast_.arena.copy(pattern_of(*e.args[0])), &e});
    e.name = writes ? kWrite : kRead;
    return true;
}

NamedTable OutputTables::add_table(BaseType type, SourceSpan span, std::vector<Stmt*>& front) {
    TreeBuilder make(ast_, span);
    auto list = [&](const char* what, BaseType element) {
        Symbol* symbol =
            make.symbol(SymbolKind::Local, std::string(type_name(type)) + " " + what, {element, 0});
        symbol->resizable = symbol->kept = ast_.resizable_arrays = true;
        symbol->length = make.number(0);
        return symbol;
    };
    NamedTable table{list("names", BaseType::String), list("values", type)};
    front.push_back(make.declare({table.names, table.values}));
    return table;
}

// if (name == "declared") { declared = value; return; }
std::vector<Stmt*> OutputTables::declared_outputs(const NamedTable& table, bool writes) {
    TreeBuilder make(ast_, span_);
    std::vector<Stmt*> tests;
    bool triples = is_triple(table.values->type.base);
    for (const Symbol* p : shader_->parameters) {
        bool fits = triples ? is_triple(p->type) : p->type == Type{BaseType::Float, -1};
        if (!p->output || !fits || p->structure || p->handle) continue;
        Expr *output = make.variable(p->name), *value = make.variable(kValue);
        std::vector<Stmt*> body{writes ? make.assign(output, value) : make.assign(value, output),
                                give(ast_, span_, writes ? nullptr : make.number(1))};
        tests.push_back(make.branch(
            make.binary(Op::Equal, make.variable(kName), make.text(p->name)), std::move(body)));
    }
    return tests;
}

// while (turn < arraylength(names)) { if (names[turn] == name) { ...; return; } turn += 1; }
Stmt* OutputTables::search(const NamedTable& table, bool writes) {
    TreeBuilder make(ast_, span_);
    size_t nodes = 0;
    auto turn = [&] { return make.variable(kTurn); };
    auto element = [&](const Symbol* list) { return make.element(list->name, *turn(), &nodes); };
    Expr *kept = element(table.values), *value = make.variable(kValue);
    std::vector<Stmt*> body{writes ? make.assign(kept, value) : make.assign(value, kept),
                            give(ast_, span_, writes ? nullptr : make.number(1))};
    IfStmt* test = make.branch(make.binary(Op::Equal, element(table.names), make.variable(kName)),
                               std::move(body));
    auto* loop = ast_.make<WhileStmt>(span_);
    loop->condition =
        make.binary(Op::Less, turn(), make.call("arraylength", {make.variable(table.names->name)}));
    loop->body =
        make.block({test, make.assign(turn(), make.binary(Op::Add, turn(), make.number(1)))});
    return loop;
}

Function* OutputTables::function(std::string_view name, const NamedTable& table, bool writes) {
    TreeBuilder make(ast_, span_);
    auto* f = ast_.arena.make<Function>();
    f->name = name;
    f->result = {writes ? BaseType::Void : BaseType::Float, -1};
    f->span = span_;
    f->id = ast_.function_count++;
    Symbol* text = make.symbol(SymbolKind::FunctionParameter, kName, {BaseType::String, -1});
    Symbol* value =
        make.symbol(SymbolKind::FunctionParameter, kValue, table.values->type.element());
    value->output = !writes;
    Symbol* turn = make.symbol(SymbolKind::Local, kTurn, {BaseType::Float, -1});
    turn->initial = make.number(0);
    for (Symbol* symbol : {text, value, turn}) symbol->function = f;
    f->parameters = ast_.arena.copy(std::vector<Symbol*>{text, value});
    std::vector<Stmt*> body = declared_outputs(table, writes);
    body.push_back(make.declare({turn}));
    body.push_back(search(table, writes));
    if (writes) {
        body.push_back(make.effect(
            make.call("push", {make.variable(table.names->name), make.variable(kName)})));
        body.push_back(make.effect(
            make.call("push", {make.variable(table.values->name), make.variable(kValue)})));
    } else {
        body.push_back(give(ast_, span_, make.number(0)));
    }
    f->returns = !writes;
    f->body = make.block(std::move(body));
    return f;
}

void OutputTables::end(ShaderDefinition& shader) {
    if (!used_) return;
    std::vector<Stmt*> front;
    std::vector<NamedTable> tables;
    for (BaseType type : {BaseType::Float, BaseType::Color})
        tables.push_back(add_table(type, span_, front));
    for (const NamedTable& table : tables)
        for (bool writes : {true, false}) {
            auto* definition = ast_.make<FunctionStmt>(span_);
            definition->function = function(writes ? kWrite : kRead, table, writes);
            front.push_back(definition);
        }
    front.insert(front.end(), shader.body->body.begin(), shader.body->body.end());
    shader.body->body = ast_.arena.copy(front);
    shader.named_tables = ast_.arena.copy(tables);
    shader.named_writes = ast_.arena.copy(writes_);
    ast_.resizes = true;
}

}  // namespace kinora::rsl
