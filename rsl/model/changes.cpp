// rsl/model/changes.cpp: what lowering must know of a piece of source before it writes code for
// it.
#include "rsl/model/changes.h"

#include <algorithm>
#include <utility>

#include "jit/ir/kernel.h"
#include "rsl/model/builtin.h"
#include "rsl/model/pairs.h"
#include "rsl/model/shader.h"

namespace kinora::rsl {

namespace {

template <class T>
void add_once(std::vector<T>& list, T item) {
    if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

}  // namespace

void ChangeFinder::note_use(const Symbol* symbol) {
    if (seen_symbols_[symbol->id] & 1) return;
    seen_symbols_[symbol->id] |= 1;
    used.push_back(symbol);
}

void ChangeFinder::written(const Expr* target) {
    while (target) {
        if (auto* variable = as_if<VariableExpr>(target)) {
            const Symbol* symbol = variable->symbol;
            if (!(seen_symbols_[symbol->id] & 2)) changes.symbols.push_back(symbol);
            seen_symbols_[symbol->id] |= 2;
            return;
        }
        if (auto* index = as_if<IndexExpr>(target))
            target = index->array;
        else if (auto* component = as_if<ComponentExpr>(target))
            target = component->operand;
        else
            return;
    }
}

void ChangeFinder::add(const Expr* expr) {
    if (!expr) return;
    for_each_operand(*expr, [&](const Expr* operand) { add(operand); });
    if (auto* variable = as_if<VariableExpr>(expr)) note_use(variable->symbol);
    if (auto* assign = as_if<AssignExpr>(expr)) written(assign->target);
    auto* call = as_if<CallExpr>(expr);
    if (!call) return;
    if (call->function) {
        changes.calls = true;
        for (size_t i = 0; i < call->args.size(); ++i)
            if (call->function->parameters[i]->output) written(call->args[i]);
        add(*call->function);
    } else if (call->builtin) {
        changes.effects |= call->builtin->effects;
        if (call->name == "random" || (call->builtin->effects & kTraces)) changes.random = true;
        for (size_t i = call->pairs + 1; i < call->args.size(); i += 2)
            if (is_output_pair(*call, i)) written(call->args[i]);
        auto& arguments = call->signature->arguments;
        for (size_t i = 0; i < call->args.size() && i < arguments.size(); ++i)
            if (arguments[i].output) written(call->args[i]);
    }
}

void ChangeFinder::add(const Function& function) {
    if (seen_functions_[function.id]) return;
    seen_functions_[function.id] = 1;
    bool returns = changes.returns;
    add(function.body);
    changes.returns = returns;  // a return of the callee stays in it
}

void ChangeFinder::add(const Stmt* stmt) {
    if (!stmt) return;
    for_each_part(
        *stmt, [&](const Expr* expr) { add(expr); }, [&](const Stmt* part) { add(part); });
    if (stmt->kind == StmtKind::Return) changes.returns = true;
    if (auto* jump = as_if<BreakStmt>(stmt)) add_once(changes.breaks, (const Stmt*)jump->loop);
    if (auto* jump = as_if<ContinueStmt>(stmt))
        add_once(changes.continues, (const Stmt*)jump->loop);
    if (stmt->kind == StmtKind::Illuminate || stmt->kind == StmtKind::Solar)
        add_once(changes.light_sources, stmt);
    auto results = [&](std::span<Expr* const> pairs, bool (*is_output)(std::string_view)) {
        for (size_t k = 1; k < pairs.size(); k += 2)
            if (is_output(pair_name(pairs, k))) written(pairs[k]);
    };
    if (auto* lights = as_if<IlluminanceStmt>(stmt)) {
        changes.effects |= kLights;
        results(lights->pairs, is_light_output);
    }
    if (auto* gather = as_if<GatherStmt>(stmt)) {
        changes.effects |= kService | kTraces;
        changes.random = true;
        results(gather->pairs, is_gather_output);
    }
}

namespace {

// Walks everything of an Ast once, looking at how arrays are indexed and passed on.
class ArrayWalk {
  public:
    explicit ArrayWalk(const Ast& ast)
        : marks(ast.symbol_count), capacities(ast.symbol_count), unlimited_(ast.symbol_count) {
        for (const Function* function : ast.functions) visit(*function);
        for (const ShaderDefinition* shader : ast.shaders) {
            for (const Symbol* parameter : shader->parameters)
                if (parameter->initial) visit(parameter->initial);
            visit(shader->body);
        }
    }

    // A parameter that lies in memory puts its arguments there, and the other way round.
    void spread() {
        for (bool again = true; again;) {
            again = false;
            for (auto [parameter, argument] : passed) {
                if (marks[parameter->id] == marks[argument->id]) continue;
                marks[parameter->id] = marks[argument->id] = 1;
                again = true;
            }
        }
    }

    // Arrays that are handed on have room for what either side needs.
    void spread_capacities() {
        spread(capacities);
        spread(unlimited_);
        share_memory();
    }

    std::vector<uint8_t> marks;
    std::vector<int> capacities;

  private:
    static constexpr int kLongest = 64;    // elements kept as values
    static constexpr int kCustomary = 64;  // elements of a resizable array that says nothing
    // docs/decisions.md#strings-and-arrays: what all arrays share whose lengths are known at run
    // time alone, the widest of them, and what is enough for any, for 16 points.
    static constexpr int kSharedBytes = 2 << 20, kWidestBytes = 1 << 20, kEnough = 4096;

    template <class T>
    void spread(std::vector<T>& values) {
        for (bool again = true; again;) {
            again = false;
            for (auto [a, b] : passed) {
                T most = std::max(values[a->id], values[b->id]);
                again = again || values[a->id] != most || values[b->id] != most;
                values[a->id] = values[b->id] = most;
            }
        }
    }

    void need(const Symbol* symbol, double count) {
        int& room = capacities[symbol->id];
        room = std::max(room, int(std::clamp(count, 1.0, 1e6)));
    }
    void need(const Symbol* symbol, const Expr* count) {
        auto* number = as_if<NumberExpr>(count);
        need(symbol, number ? number->value : kCustomary);
        if (!number) grows(symbol);
    }
    // Its length is known at run time alone.
    void grows(const Symbol* symbol) {
        if (symbol->length && symbol->length->kind == ExprKind::Number) return;
        unlimited_[symbol->id] = 1;
    }
    // As many elements for each as fit, so that arrays that grow together end together. Below a
    // function that calls itself there are as many copies of each as it may nest: those stay small.
    void share_memory() {
        if (recursive_) return;
        int64_t all = 0, widest = 1;
        for (const Symbol* symbol : resizable_) {
            if (!unlimited_[symbol->id]) continue;
            int64_t bytes = int64_t(component_count(symbol->type.base)) * 4 * jit::kMaxLanes;
            all += bytes;
            widest = std::max(widest, bytes);
        }
        int64_t count = std::min(
            {kSharedBytes / std::max<int64_t>(all, 1), kWidestBytes / widest, int64_t(kEnough)});
        for (size_t id = 0; id < capacities.size(); ++id)
            if (unlimited_[id]) capacities[id] = std::max(capacities[id], int(count));
    }
    // A resizable array: at least as long as its initial value.
    void declared(const Symbol* symbol) {
        marks[symbol->id] = 1;
        resizable_.push_back(symbol);
        if (symbol->length) need(symbol, symbol->length);
        if (auto* literal = as_if<ArrayLiteralExpr>(symbol->initial))
            need(symbol, double(literal->items.size()));
        if (auto* other = as_if<VariableExpr>(symbol->initial)) {
            passed.push_back({symbol, other->symbol});
            if (int length = other->symbol->type.array_length; length > 0) need(symbol, length);
        }
    }
    void assigned(const Expr* target, const Expr* value) {
        auto* variable = as_if<VariableExpr>(target);
        if (!variable || !variable->type.is_array()) return;
        if (auto* literal = as_if<ArrayLiteralExpr>(value))
            need(variable->symbol, double(literal->items.size()));
        auto* other = as_if<VariableExpr>(value);
        if (!other) return;
        if (int length = other->symbol->type.array_length; length > 0)
            need(variable->symbol, length);
        if (other->symbol->resizable || variable->symbol->resizable)
            passed.push_back({variable->symbol, other->symbol});
    }
    // push(), resize() and such of an array.
    void resized(const CallExpr& call) {
        auto* array = as_if<VariableExpr>(call.args[0]);
        if (!array) return;
        bool counts = call.name == "resize" || call.name == "reserve";
        if (counts)
            need(array->symbol, call.args[1]);
        else
            need(array->symbol, kCustomary);
        if (call.name == "push" && repeats_) grows(array->symbol);
    }

    // Questions whose answers decide the length.
    void answered(const CallExpr& call) {
        for (const Expr* argument : call.args)
            if (auto* array = as_if<VariableExpr>(argument); array && array->symbol->resizable) {
                need(array->symbol, kCustomary);
                grows(array->symbol);
            }
    }

    // What stands in it may run any number of times.
    void visit(const Function& function) {
        bool outside = std::exchange(repeats_, true);
        recursive_ = recursive_ || function.recursive;
        for (const Symbol* parameter : function.parameters)
            if (parameter->type.array_length == 0 && parameter->assigned && !parameter->output)
                resizable_.push_back(parameter);  // a copy of the argument
        visit(function.body);
        repeats_ = outside;
    }

    void visit(const Stmt* stmt) {
        bool outside = repeats_;
        repeats_ = repeats_ || is_loop(*stmt);
        for_each_part(
            *stmt, [&](const Expr* expr) { visit(expr); }, [&](const Stmt* part) { visit(part); });
        repeats_ = outside;
        if (auto* declare = as_if<DeclareStmt>(stmt))
            for (const Symbol* symbol : declare->symbols) {
                if (symbol->type.array_length > kLongest) marks[symbol->id] = 1;
                if (symbol->resizable) declared(symbol);
            }
        if (auto* nested = as_if<FunctionStmt>(stmt)) visit(*nested->function);
    }

    void visit(const Expr* expr) {
        for_each_operand(*expr, [&](const Expr* operand) { visit(operand); });
        if (auto* index = as_if<IndexExpr>(expr)) {
            auto* array = as_if<VariableExpr>(index->array);
            if (array && index->index->kind != ExprKind::Number) marks[array->symbol->id] = 1;
        }
        if (auto* assign = as_if<AssignExpr>(expr)) assigned(assign->target, assign->value);
        auto* call = as_if<CallExpr>(expr);
        if (call && call->builtin && (call->builtin->effects & kSetsLength)) resized(*call);
        if (call && call->builtin && (call->builtin->effects & kMessage)) answered(*call);
        if (!call || !call->function) return;
        for (size_t i = 0; i < call->args.size(); ++i) {
            auto* array = as_if<VariableExpr>(call->args[i]);
            if (array && array->type.is_array())
                passed.push_back({call->function->parameters[i], array->symbol});
        }
    }

    static bool is_loop(const Stmt& stmt) {
        return stmt.kind == StmtKind::While || stmt.kind == StmtKind::For ||
               stmt.kind == StmtKind::Illuminance || stmt.kind == StmtKind::Gather;
    }

    std::vector<std::pair<const Symbol*, const Symbol*>> passed;
    std::vector<const Symbol*> resizable_;
    std::vector<uint8_t> unlimited_;  // by Symbol::id
    bool repeats_ = false;            // a loop or function around
    bool recursive_ = false;
};

}  // namespace

std::vector<uint8_t> memory_arrays(const Ast& ast) {
    ArrayWalk walk(ast);
    walk.spread();
    return std::move(walk.marks);
}

std::vector<int> array_capacities(const Ast& ast) {
    if (!ast.resizes && !ast.resizable_arrays) return std::vector<int>(ast.symbol_count);
    ArrayWalk walk(ast);
    walk.spread_capacities();
    return std::move(walk.capacities);
}

}  // namespace kinora::rsl
