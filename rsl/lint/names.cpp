// rsl/lint/names.cpp: names that are not used, read before they are set, or that hide others.
#include <algorithm>
#include <utility>

#include "rsl/lint/lint_p.h"
#include "rsl/model/builtin.h"
#include "rsl/model/pairs.h"
#include "rsl/text/findings.h"

namespace kinora::rsl {

namespace {

// Walks in the order of the text: what is assigned further up, or anywhere in a loop around, counts
// as set.
class NameWalk {
  public:
    explicit NameWalk(LintSource& source)
        : source_(source), read_(source.ast.symbol_count), set_(source.ast.symbol_count) {}

    void run() {
        for (const Function* f : source_.ast.functions) function(*f);
        for (const ShaderDefinition* shader : source_.ast.shaders) {
            shader_ = shader;
            parameters(shader->parameters);
            walk(*shader->body);
        }
        shader_ = nullptr;
        for (const Symbol* symbol : declared_) report_unused(*symbol);
    }

  private:
    // ---- declarations

    void parameters(std::span<Symbol* const> parameters) {
        for (const Symbol* p : parameters) {
            use(p->initial);
            declared_.push_back(p);
        }
    }
    void function(const Function& f) {
        bool made = f.name.find('@') != std::string_view::npos;  // by rsl/objects
        if (!f.called && !made && source_.is_own(f.span) && !is_method(f))
            source_.reporter.report(Code::RSL_UNUSED_FUNCTION, f.span, f.name);
        const Function* outer = std::exchange(function_, &f);
        auto loops = std::exchange(loops_, {});
        if (!is_method(f)) parameters(f.parameters);  // of methods the caller says which there are
        walk(*f.body);
        loops_ = std::move(loops);
        function_ = outer;
    }
    // Others may call a class's methods and read its members.
    bool is_method(const Function& f) const {
        if (!shader_ || !shader_->shader_class) return false;
        auto methods = shader_->shader_class->methods;
        return std::find(methods.begin(), methods.end(), &f) != methods.end();
    }
    // By rsl/objects: no name of a text has a space in it.
    static bool is_made(const Symbol& symbol) {
        return symbol.name.find(' ') != std::string_view::npos;
    }
    static bool is_member(const Symbol& symbol) {
        return symbol.name.find("->") != std::string_view::npos;
    }
    void declare(const Symbol& symbol) {
        use(symbol.length);
        use(symbol.initial);
        bool of_class = shader_ && shader_->shader_class && !function_;
        if (symbol.initial || of_class || is_member(symbol)) set_[symbol.id] = true;
        if (of_class || is_member(symbol)) return;
        declared_.push_back(&symbol);
        if (source_.is_own(symbol.span)) report_hiding(symbol);
    }

    void report_unused(const Symbol& symbol) {
        bool parameter = symbol.kind != SymbolKind::Local;
        // The renderer reads parameters like __category.
        if (read_[symbol.id] || !source_.is_own(symbol.span) || symbol.name.starts_with("__") ||
            is_made(symbol) || is_read_by_others(symbol))
            return;
        if (parameter && symbol.output) return;
        source_.reporter.report(parameter ? Code::RSL_UNUSED_PARAMETER : Code::RSL_UNUSED_VARIABLE,
                                symbol.span, symbol.name);
    }

    // Others read a co-shader's parameters; and calls of a shader that is null, as parameters are
    // where it is checked alone, are not in the tree any more.
    bool is_read_by_others(const Symbol& symbol) const {
        const auto& shaders = source_.ast.shaders;
        bool of_co_shader = std::any_of(shaders.begin(), shaders.end(), [&](const auto* shader) {
            auto own = shader->parameters;
            return shader->co_shader && std::find(own.begin(), own.end(), &symbol) != own.end();
        });
        if (of_co_shader) return true;
        const auto& tokens = source_.ast.tokens.tokens;
        for (size_t k = 0; k + 2 < tokens.size(); ++k) {
            if (tokens[k].punct != Punct::Arrow || tokens[k + 2].punct != Punct::LeftParen)
                continue;
            int depth = 0;
            for (k += 2; k < tokens.size(); ++k) {
                depth += tokens[k].punct == Punct::LeftParen;
                depth -= tokens[k].punct == Punct::RightParen;
                if (depth == 0) break;
                if (tokens[k].text == symbol.name) return true;
            }
        }
        return false;
    }

    void report_hiding(const Symbol& symbol) {
        constexpr std::string_view kReported[] = {"Ci", "Oi", "Cl", "Ol"};  // RSL_HIDES_OUTPUT
        auto same = [&](const Symbol* p) { return p->name == symbol.name; };
        auto hides = [&](std::span<Symbol* const> parameters) {
            return std::any_of(parameters.begin(), parameters.end(), same);
        };
        bool parameter = shader_ && hides(shader_->parameters);
        for (const Function* f = function_; f; f = f->parent) parameter |= hides(f->parameters);
        bool global = find_global(symbol.name) &&
                      std::find(std::begin(kReported), std::end(kReported), symbol.name) ==
                          std::end(kReported);
        if (parameter || global)
            source_.reporter.report(Code::RSL_HIDES, symbol.span, symbol.name,
                                    parameter ? "a parameter" : "the shader global");
    }

    // ---- expressions

    void use(const Expr* e) {
        if (!e) return;
        if (const auto* variable = as_if<VariableExpr>(e)) return read(variable->symbol, *e);
        if (const auto* assign = as_if<AssignExpr>(e)) return assigned(*assign, true);
        if (const auto* call = as_if<CallExpr>(e)) return called(*call);
        for_each_operand(*e, [&](const Expr* part) { use(part); });
    }
    void read(const Symbol* symbol, const Expr& at) {
        if (!symbol || symbol->global) return;
        read_[symbol->id] = true;
        report_unset(*symbol, at);
    }
    void report_unset(const Symbol& symbol, const Expr& at) {
        bool own = symbol.kind == SymbolKind::Local && symbol.function == function_;
        if (!own || is_made(symbol) || set_[symbol.id] || symbol.type.is_array() ||
            !source_.is_own(at.span))
            return;
        for (const Changes* loop : loops_)
            if (std::find(loop->symbols.begin(), loop->symbols.end(), &symbol) !=
                loop->symbols.end())
                return;
        set_[symbol.id] = true;  // it is said once
        source_.reporter.report(Code::RSL_UNSET, at.span, symbol.name);
    }
    // What an assignment, a call or a loop over lights or rays writes to.
    void write(const Expr* target) {
        if (const auto* variable = as_if<VariableExpr>(target)) {
            if (variable->symbol && !variable->symbol->global) set_[variable->symbol->id] = true;
        } else if (const auto* index = as_if<IndexExpr>(target)) {
            use(index->index);
            write(index->array);
        } else if (const auto* component = as_if<ComponentExpr>(target)) {
            use(component->index);
            write(component->operand);
        }
    }
    static const Symbol* symbol_of(const Expr* target) {
        if (const auto* index = as_if<IndexExpr>(target)) return symbol_of(index->array);
        if (const auto* component = as_if<ComponentExpr>(target))
            return symbol_of(component->operand);
        const auto* variable = as_if<VariableExpr>(target);
        return variable && variable->symbol && !variable->symbol->global ? variable->symbol
                                                                         : nullptr;
    }
    // A variable that only receives results may be there for the others.
    void receive(const Expr* target) {
        write(target);
        if (const Symbol* symbol = symbol_of(target)) read_[symbol->id] = true;
    }
    void assigned(const AssignExpr& e, bool value_used) {
        use(e.value);
        const Symbol* symbol = symbol_of(e.target);
        if (symbol && e.op != Op::None) report_unset(*symbol, *e.target);
        write(e.target);
        // What a macro sets may be a result like that of a call.
        bool by_macro = source_.ast.tokens.tokens[e.span.token].macro != 0;
        if (symbol && (value_used || by_macro)) read_[symbol->id] = true;
    }
    void called(const CallExpr& e) {
        use(e.channel);
        for (size_t i = 0; i < e.args.size(); ++i) {
            bool output = e.function                          ? e.function->parameters[i]->output
                          : i < e.signature->arguments.size() ? e.signature->arguments[i].output
                                                              : is_output_pair(e, i);
            if (output)
                receive(e.args[i]);
            else
                use(e.args[i]);
        }
    }

    // ---- statements

    void pairs(std::span<Expr* const> pairs, bool (*is_output)(std::string_view)) {
        for (size_t k = 0; k < pairs.size(); ++k)
            if (k % 2 == 1 && is_output(pair_name(pairs, k)))
                receive(pairs[k]);
            else
                use(pairs[k]);
    }
    void in_loop(const Stmt& loop, const Stmt& body, std::span<Expr* const> step,
                 const Expr* condition = nullptr, const Stmt* other = nullptr) {
        ChangeFinder finder(source_.ast);
        finder.add(&loop);
        loops_.push_back(&finder.changes);
        use(condition);
        walk(body);
        for (const Expr* e : step) use_statement(e);
        if (other) walk(*other);
        loops_.pop_back();
    }
    void use_statement(const Expr* e) {
        if (const auto* assign = as_if<AssignExpr>(e))
            assigned(*assign, false);
        else
            use(e);
    }
    void walk(const Stmt& stmt) {
        switch (stmt.kind) {
            case StmtKind::Declare:
                for (const Symbol* symbol : as<DeclareStmt>(stmt).symbols) declare(*symbol);
                return;
            case StmtKind::DefineFunction:
                return function(*as<FunctionStmt>(stmt).function);
            case StmtKind::Expression:
                return use_statement(as<ExpressionStmt>(stmt).expression);
            case StmtKind::While: {
                auto& node = as<WhileStmt>(stmt);
                return in_loop(stmt, *node.body, {}, node.condition);
            }
            case StmtKind::For: {
                auto& node = as<ForStmt>(stmt);
                for (const Stmt* item : node.init) walk(*item);
                return in_loop(stmt, *node.body, node.step, node.condition);
            }
            case StmtKind::Illuminance: {
                auto& node = as<IlluminanceStmt>(stmt);
                use(node.category), use(node.position), use(node.axis), use(node.angle);
                pairs(node.pairs, is_light_output);
                return in_loop(stmt, *node.body, {});
            }
            case StmtKind::Gather: {
                auto& node = as<GatherStmt>(stmt);
                for (const Expr* e : node.args.first(node.args.size() - node.pairs.size())) use(e);
                pairs(node.pairs, is_gather_output);
                return in_loop(stmt, *node.body, {}, nullptr, node.missed);
            }
            case StmtKind::Block:
            case StmtKind::Extern:
            case StmtKind::If:
            case StmtKind::Break:
            case StmtKind::Continue:
            case StmtKind::Return:
            case StmtKind::Illuminate:
            case StmtKind::Solar:
                for_each_part(
                    stmt, [&](const Expr* part) { use(part); },
                    [&](const Stmt* part) { walk(*part); });
                return;
        }
    }

    LintSource& source_;
    std::vector<bool> read_, set_;  // by Symbol::id
    std::vector<const Symbol*> declared_;
    std::vector<const Changes*> loops_;  // around, innermost last
    const ShaderDefinition* shader_ = nullptr;
    const Function* function_ = nullptr;
};

}  // namespace

void lint_names(LintSource& source) {
    NameWalk(source).run();
}

}  // namespace kinora::rsl
