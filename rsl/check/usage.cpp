// rsl/check/usage.cpp: globals, statements and built-ins against the shader's kind.
#include "rsl/check/usage.h"

#include <algorithm>
#include <array>
#include <utility>

#include "rsl/model/builtin.h"
#include "rsl/model/pairs.h"
#include "rsl/syntax/ast_parts.h"
#include "rsl/syntax/ast_visit.h"
#include "rsl/text/did_you_mean.h"
#include "rsl/text/literal_names.h"

namespace kinora::rsl {

namespace {

class UsageWalk {
  public:
    UsageWalk(Shader& shader, Ast& ast, Reporter& reporter, const ParseRecovery& recovery,
              std::unordered_set<const void*>& reported)
        : shader_(shader),
          ast_(ast),
          reporter_(reporter),
          recovery_(recovery),
          reported_(reported) {}

    // Nodes that have an error may lack what the checker completes.
    void run() {
        for (const Symbol* p : shader_.definition->parameters)
            if (p->initial) walk(p->initial);
        walk(*shader_.definition->body);
        for (const GlobalInfo& info : globals()) {
            if (read_[size_t(info.id)]) shader_.globals_read.push_back(&info);
            if (written_[size_t(info.id)]) shader_.globals_written.push_back(&info);
        }
    }

  private:
    enum class Inside : uint8_t { Nothing, Illuminance, Light, Function };

    // Null where the node has a finding.
    template <class... Args>
    Finding* report(const FindingInfo& info, const void* node, const SourceSpan& span,
                    const Args&... args) {
        if (!reported_.insert(node).second) return nullptr;
        const Token& token = ast_.tokens.tokens[span.token];
        return &reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }
    void lights(const void* node, const SourceSpan& span, const std::string& name) {
        if (shader_.kind == ShaderKind::Displacement) report(Code::RSL_NO_LIGHTS, node, span, name);
    }
    const char* kind_name() const { return shader_kind_name(shader_.kind); }

    // ---- globals

    void use_global(const VariableExpr& e, bool write) {
        const GlobalInfo& info = *e.symbol->global;
        (write ? written_ : read_)[size_t(info.id)] = true;
        if (!((info.readers | info.writers) & in_kind(shader_.kind)))
            report(Code::RSL_GLOBAL_NOT_READABLE, &e, e.span, info.name, kind_name());
        else if (write && !(info.writers & in_kind(shader_.kind)))
            report(Code::RSL_GLOBAL_NOT_WRITABLE, &e, e.span, info.name, kind_name());
        else
            check_inside(e, info.id);
    }

    // L, Cl and Ol of a surface exist inside illuminance, L of a light inside illuminate and solar.
    // Functions are called from inside, or hold the statement themselves.
    void check_inside(const VariableExpr& e, Global id) {
        if (recovery_.touches(e.span.token)) return;  // where illuminance ends may be unknown
        bool of_light = id == Global::L || id == Global::Cl || id == Global::Ol;
        bool surface = shader_.kind == ShaderKind::Surface;
        if (surface && of_light && inside_ == Inside::Nothing)
            report(Code::RSL_ONLY_IN_ILLUMINANCE, &e, e.span, e.name);
        if (shader_.kind == ShaderKind::Light && id == Global::L && inside_ == Inside::Nothing)
            report(Code::RSL_ONLY_IN_ILLUMINATE, &e, e.span, e.name);
    }

    void read_names(std::string_view names) {
        while (!names.empty()) {
            size_t end = std::min(names.find(' '), names.size());
            if (const GlobalInfo* info = find_global(names.substr(0, end)))
                read_[size_t(info->id)] = true;
            names.remove_prefix(std::min(end + 1, names.size()));
        }
    }

    // ---- expressions

    void walk(const Expr* e) {
        if (e) visit_expr(*e, [&](const auto& node) { at(node); });
    }
    void walk_all(std::span<Expr* const> items) {
        for (const Expr* item : items) walk(item);
    }
    void write(const Expr* target, bool also_read) {
        if (const auto* v = as_if<VariableExpr>(target)) {
            if (!v->symbol || !v->symbol->global) return;
            if (also_read) read_[size_t(v->symbol->global->id)] = true;
            use_global(*v, true);
        } else if (const auto* i = as_if<IndexExpr>(target)) {
            walk(i->index);
            write(i->array, true);
        } else if (const auto* c = as_if<ComponentExpr>(target)) {
            walk(c->index);
            write(c->operand, true);
        }
    }

    void at(const NumberExpr&) {}
    void at(const StringExpr&) {}
    void at(const VariableExpr& e) {
        if (e.symbol && e.symbol->global) use_global(e, false);
    }
    void at(const IndexExpr& e) { walk(e.array), walk(e.index); }
    void at(const ComponentExpr& e) { walk(e.operand), walk(e.index); }
    void at(const UnaryExpr& e) { walk(e.operand); }
    void at(const BinaryExpr& e) {
        for_each_operand(static_cast<const Expr&>(e), [&](const Expr* part) { walk(part); });
    }
    void at(const SelectExpr& e) { walk(e.condition), walk(e.yes), walk(e.no); }
    // A light without direction says "L = 0", which is what L is.
    void at(const AssignExpr& e) {
        walk(e.value);
        const auto* v = as_if<VariableExpr>(e.target);
        bool is_l = v && v->symbol && v->symbol->global && v->symbol->global->id == Global::L;
        if (is_l && e.op == Op::None && shader_.kind == ShaderKind::Light && is_zero(*e.value))
            reported_.insert(v);
        write(e.target, e.op != Op::None);
    }
    static bool is_zero(const Expr& e) {
        if (const auto* number = as_if<NumberExpr>(&e)) return number->value == 0;
        if (const auto* cast = as_if<CastExpr>(&e)) return !cast->space && is_zero(*cast->operand);
        const auto* triple = as_if<TripleExpr>(&e);
        return triple && is_zero(*triple->items[0]) && is_zero(*triple->items[1]) &&
               is_zero(*triple->items[2]);
    }
    void at(const CastExpr& e) {
        if (e.to == BaseType::Color) color_space(e.space);
        walk(e.space), walk(e.operand);
    }
    void at(const TripleExpr& e) { walk_all(e.items); }
    void at(const SixteenExpr& e) { walk_all(e.items); }
    void at(const ArrayLiteralExpr& e) { walk_all(e.items); }
    void at(const CallExpr& e) {
        walk(e.channel);
        if (e.builtin) {
            builtin_call(e);
        } else if (e.function) {
            for (size_t i = 0; i < e.args.size(); ++i)
                argument(e.args[i], e.function->parameters[i]->output);
            reach(*e.function);
        } else {
            walk_all(e.args);  // nobody knows what is called
        }
    }
    void argument(const Expr* e, bool output) {
        if (output)
            write(e, true);
        else
            walk(e);
    }
    // What surfaces may call, displacements and volumes may too, and lights where it is no light
    // loop: compilers never enforced the specification's table, and shaders rely on that.
    static uint8_t legal_kinds(const Builtin& row) {
        uint8_t kinds = row.legal;
        if (kinds & kSurface) kinds |= kDisplacement | kVolume;
        if ((kinds & kSurface) && !(row.effects & (kLights | kDerivative))) kinds |= kLight;
        return kinds;
    }
    // Of names that only the renderer knows nothing is said here.
    void color_space(const Expr* e) {
        const auto* name = as_if<StringExpr>(e);
        if (!name || is_color_space(name->value)) return;
        Finding* finding = report(Code::RSL_COLOR_SPACE_UNKNOWN, e, e->span, name->value);
        if (finding) finding->help = meant_help(name->value, color_space_names());
    }
    void spline_basis(const Expr* e) {
        const auto* name = as_if<StringExpr>(e);
        if (!name || is_spline_basis(name->value)) return;
        Finding* finding = report(Code::RSL_SPLINE_BASIS, e, e->span, name->value);
        if (finding) finding->help = meant_help(name->value, spline_basis_names());
    }
    void literal_names(const CallExpr& e) {
        if (e.name == "ctransform")
            for (const Expr* argument : e.args) color_space(argument);
        if (e.name == "spline" && !e.args.empty()) spline_basis(e.args[0]);
    }
    void builtin_call(const CallExpr& e) {
        literal_names(e);
        if (!(legal_kinds(*e.builtin) & in_kind(shader_.kind))) {
            bool derives = e.builtin->effects & kDerivative;
            report(derives ? Code::RSL_NO_DERIVATIVES : Code::RSL_NOT_LEGAL_HERE, &e, e.span,
                   fmt::format("'{}'", e.name), kind_name());
        }
        if (e.builtin->effects & kLights) lights(&e, e.span, fmt::format("'{}'", e.name));
        read_names(e.builtin->globals);
        if (e.name == "vertexvalue") request_input(e);
        for (size_t i = 0; i < e.args.size(); ++i) {
            bool fixed = i < e.signature->arguments.size();
            argument(e.args[i], fixed ? e.signature->arguments[i].output : is_output_pair(e, i));
        }
    }
    void request_input(const CallExpr& e) {
        BaseType type = e.args.size() > 1 ? e.args[1]->type.base : BaseType::Float;
        const auto* name = as_if<StringExpr>(e.args[0]);
        VertexRequest request{type, name ? std::string(name->value) : ""};
        auto& requests = shader_.vertex_requests;
        if (std::find(requests.begin(), requests.end(), request) == requests.end())
            requests.push_back(std::move(request));
    }
    void reach(Function& f) {
        if (!seen_.insert(&f).second) return;
        f.called = true;
        shader_.functions.push_back(&f);
        Inside before = std::exchange(inside_, Inside::Function);
        walk(*f.body);
        inside_ = before;
    }

    // ---- statements

    void walk(const Stmt& s) {
        visit_stmt(s, [&](const auto& node) { at(node); });
    }
    void walk_inside(const Stmt& body, Inside inside) {
        Inside before = std::exchange(inside_, inside);
        walk(body);
        inside_ = before;
    }
    void legal(const Stmt& s, bool is, const char* name) {
        if (!is) report(Code::RSL_STATEMENT_NOT_LEGAL, &s, s.span, name, kind_name());
    }

    void at(const BlockStmt& s) {
        for (const Stmt* item : s.body) walk(*item);
    }
    void at(const DeclareStmt& s) {
        for (const Symbol* symbol : s.symbols) walk(symbol->length), walk(symbol->initial);
    }
    void at(const ExternStmt&) {}
    void at(const FunctionStmt&) {}
    void at(const ExpressionStmt& s) { walk(s.expression); }
    void at(const IfStmt& s) {
        walk(s.condition);
        walk(*s.yes);
        if (s.no) walk(*s.no);
    }
    void at(const WhileStmt& s) {
        walk(s.condition);
        walk(*s.body);
    }
    void at(const ForStmt& s) {
        for (const Stmt* item : s.init) walk(*item);
        walk(s.condition);
        walk_all(s.step);
        walk(*s.body);
    }
    void at(const BreakStmt&) {}
    void at(const ContinueStmt&) {}
    void at(const ReturnStmt& s) { walk(s.value); }
    void at(const IlluminanceStmt& s) {
        bool lit = shader_.kind == ShaderKind::Surface || shader_.kind == ShaderKind::Volume ||
                   shader_.kind == ShaderKind::Displacement;
        legal(s, lit, "illuminance");
        lights(&s, s.span, "illuminance");
        walk(s.category), walk(s.position), walk(s.axis), walk(s.angle);
        for (size_t k = 0; k < s.pairs.size(); ++k)
            argument(s.pairs[k], k % 2 == 1 && is_light_output(pair_name(s.pairs, k)));
        walk_inside(*s.body, Inside::Illuminance);
    }
    void at(const IlluminateStmt& s) {
        legal(s, shader_.kind == ShaderKind::Light, "illuminate");
        walk(s.position), walk(s.axis), walk(s.angle);
        walk_inside(*s.body, Inside::Light);
    }
    void at(const SolarStmt& s) {
        legal(s, shader_.kind == ShaderKind::Light, "solar");
        walk(s.axis), walk(s.angle);
        walk_inside(*s.body, Inside::Light);
    }
    void at(const GatherStmt& s) {
        constexpr uint8_t kGatherers = kSurface | kVolume | kLight;
        legal(s, kGatherers & in_kind(shader_.kind), "gather");
        walk_all(s.args.first(s.args.size() - s.pairs.size()));
        for (size_t k = 0; k < s.pairs.size(); ++k)
            argument(s.pairs[k], k % 2 == 1 && is_gather_output(pair_name(s.pairs, k)));
        walk(*s.body);
        if (s.missed) walk(*s.missed);
    }

    Shader& shader_;
    Ast& ast_;
    Reporter& reporter_;
    const ParseRecovery& recovery_;
    std::unordered_set<const void*>& reported_;
    std::unordered_set<const Function*> seen_;
    std::array<bool, size_t(Global::Count)> read_{}, written_{};
    Inside inside_ = Inside::Nothing;
};

}  // namespace

void find_usage(Shader& shader, Ast& ast, Reporter& reporter, const ParseRecovery& recovery,
                std::unordered_set<const void*>& reported) {
    UsageWalk(shader, ast, reporter, recovery, reported).run();
}

}  // namespace kinora::rsl
