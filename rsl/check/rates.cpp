// rsl/check/rates.cpp: which values differ from point to point. The shader is walked again and
// again until no variable changes; calls are walked as if expanded, once for each pattern of
// argument rates.
//
// In a source with errors, what could not be typed is uniform, so that nothing follows from it.
//
// Two questions are answered at once. `varying`: does the value differ between points? It decides
// Symbol::varying and Expr::rate. `illegal`: may a declared-uniform variable not take it? A uniform
// that is assigned under varying control is varying, but still legal to assign to another uniform:
// the specification judges by declarations.
#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "rsl/check/flow.h"
#include "rsl/check/lengths.h"
#include "rsl/check/usage.h"
#include "rsl/model/builtin.h"
#include "rsl/model/pairs.h"
#include "rsl/syntax/ast_visit.h"
#include "rsl/syntax/chain.h"

namespace kinora::rsl {

namespace {

// What a function's body does for one pattern of argument rates.
struct CallSummary {
    Flow result;
    std::vector<Flow> outputs;  // by parameter
};

// A function whose body is being walked.
struct Active {
    const Function* function;
    Flow result;   // as far as it is known
    Flow control;  // that some call of it stands under
};

// Hostile source may ask for more walking than it is worth: then what is known is taken.
constexpr int kMostSteps = 2'000'000;

class RateWalk {
  public:
    RateWalk(const ShaderDefinition& shader, Ast& ast, Reporter& reporter)
        : shader_(shader),
          ast_(ast),
          reporter_(reporter),
          flows_(ast.symbol_count),
          known_(ast.symbol_count),
          lengths_(ast.symbol_count),
          locals_(ast.function_count) {}

    void run() {
        for (Symbol* p : shader_.parameters)
            declare(*p, p->detail == Detail::Varying ? kVaryingFlow : kUniform);
        do {
            changed_ = false;
            calls_.clear();
            for (Symbol* p : shader_.parameters)
                if (p->initial) flow(p->initial);
            walk(*shader_.body);
        } while (changed_ && steps_ < kMostSteps);
    }

  private:
    // ---- variables

    void declare(Symbol& s, Flow flow) {
        if (s.detail == Detail::Varying) flow = kVaryingFlow;
        flows_[s.id] = flow;
        s.varying = s.varying || flow.varying;
    }
    // A local starts anew each time its function is walked.
    void declare_local(Symbol& s) {
        if (known_[s.id]) return;
        known_[s.id] = true;
        declare(s, kConstant);
        if (s.function) locals_[s.function->id].push_back(&s);
    }
    static bool declared_uniform(const Symbol& s) { return s.detail == Detail::Uniform; }

    Flow read(const Symbol& s) const {
        if (!s.global) return flows_[s.id];
        // Uniform in other compilers, so shaders hand them to uniform variables.
        if (s.global->id == Global::du || s.global->id == Global::dv) return {false, true, false};
        return s.global->rate == Rate::Varying    ? kVaryingFlow
               : s.global->rate == Rate::Constant ? kConstant
                                                  : kUniform;
    }

    // `value` is stored in the symbol, or in a part of it that `selector` chooses.
    void store(Symbol& s, Flow value, Flow selector, const Expr& at) {
        if (s.global) return;
        // Which lights reach a point is uniform in other compilers.
        if (declared_uniform(s) && value.illegal && !s.handle) complain(s, at);
        Flow& flow = flows_[s.id];
        bool own = walking_ && s.function == walking_;
        Flow after = join(join(flow, value), join(selector, own ? control_.own : control_.any));
        after.constant = false;
        if (declared_uniform(s)) after.illegal = false;
        if (after.varying != flow.varying || after.illegal != flow.illegal ||
            after.constant != flow.constant) {
            note_change(s.function);
        }
        flow = after;
        s.varying = s.varying || after.varying;
    }

    void complain(const Symbol& s, const Expr& at) {
        if (!reported_.insert(&at).second) return;
        const Token& token = ast_.tokens.tokens[at.span.token];
        reporter_
            .report(Code::RSL_UNIFORM_FROM_VARYING, at.span.where, token.macro, token.spelling,
                    s.name)
            .notes.push_back({s.span.where, "declared here"});
    }

    void store_to(const Expr* target, Flow value, const Expr& at) {
        Flow selector = kConstant;
        while (true) {
            if (const auto* i = as_if<IndexExpr>(target)) {
                selector = join(selector, flow(i->index));
                target = i->array;
            } else if (const auto* c = as_if<ComponentExpr>(target)) {
                selector = join(selector, flow(c->index));
                target = c->operand;
            } else {
                break;
            }
        }
        const auto* v = as_if<VariableExpr>(target);
        if (v && v->symbol) store(*v->symbol, value, selector, at);
    }

    // ---- expressions

    Flow flow(Expr* e) {
        if (!e) return kConstant;
        return rated(*e, visit_expr(*e, [&](auto& node) { return at(node); }));
    }
    Flow rated(Expr& e, Flow f) {
        Rate rate = f.varying ? Rate::Varying : f.constant ? Rate::Constant : Rate::Uniform;
        e.rate = e.rated ? std::max(e.rate, rate) : rate;
        e.rated = true;
        return f;
    }
    Flow flow_all(std::span<Expr*> items) {
        Flow all = kConstant;
        for (Expr* item : items) all = join(all, flow(item));
        return all;
    }

    Flow at(NumberExpr&) { return kConstant; }
    Flow at(StringExpr&) { return kConstant; }
    Flow at(VariableExpr& e) { return e.symbol ? read(*e.symbol) : kUniform; }

    // ---- lengths of arrays

    void vary_length(const Expr* array) {
        const Symbol* symbol = VaryingLengths::named(array);
        if (symbol && lengths_.vary(*symbol)) note_change(symbol->function);
    }
    // One array takes the length of another.
    void take_length(const Expr* to, const Expr* from) {
        const Symbol* symbol = VaryingLengths::named(to);
        bool changes = symbol && symbol->type.array_length == 0;
        if (changes && (lengths_.varies(from) || control_.any.varying)) vary_length(to);
    }
    Flow length_of(const Expr* array) const {
        return lengths_.is_fixed(array) ? kConstant : Flow{false, lengths_.varies(array), false};
    }
    void set_length(CallExpr& e) {
        bool by_argument = e.name == "resize" || e.name == "reserve";
        Flow amount = by_argument && e.args.size() > 1 ? flow(e.args[1]) : kConstant;
        if (control_.any.varying || amount.varying) vary_length(e.args[0]);
    }

    Flow at(IndexExpr& e) { return join(flow(e.array), flow(e.index)); }
    Flow at(ComponentExpr& e) { return join(flow(e.operand), flow(e.index)); }
    Flow at(UnaryExpr& e) { return flow(e.operand); }
    // A side that some points skip may assign.
    Flow flow_under(Expr* side, Flow condition) {
        Control before = std::exchange(control_, control_.under(condition));
        Flow f = flow(side);
        control_ = before;
        return f;
    }
    Flow at(BinaryExpr& last) {
        Chain<Expr> chain = chain_of<Expr>(last);
        Flow left = flow(chain.first);
        for (Expr* link : chain.links) {
            if (auto* e = as_if<BinaryExpr>(link)) {
                bool logical = e->op == Op::And || e->op == Op::Or;
                left = join(left, flow_under(e->right, logical ? left : kConstant));
            }
            if (link != &last) rated(*link, left);
        }
        return left;
    }
    Flow at(SelectExpr& e) {
        Flow condition = flow(e.condition);
        Flow yes = flow_under(e.yes, condition), no = flow_under(e.no, condition);
        return join(condition, join(yes, no));
    }
    Flow at(AssignExpr& e) {
        Flow value = flow(e.value);
        if (e.op != Op::None) value = join(value, flow(e.target));
        store_to(e.target, value, e);
        if (e.target->type.is_array()) take_length(e.target, e.value);
        return flow(e.target);
    }
    Flow at(CastExpr& e) {
        Flow f = join(flow(e.space), flow(e.operand));
        // Only "current" space stands still against the shading point's frame.
        if (e.space) f.constant = false;
        return f;
    }
    Flow at(TripleExpr& e) { return flow_all(e.items); }
    Flow at(SixteenExpr& e) { return flow_all(e.items); }
    Flow at(ArrayLiteralExpr& e) { return flow_all(e.items); }
    Flow at(CallExpr& e) {
        if (e.function) return user_call(e);
        if (e.builtin) return builtin_call(e);
        flow_all(e.args);  // nobody knows what is called: reported
        return kUniform;
    }

    // A resizable array that gets as many elements as an answer has.
    static bool takes_answer(const CallExpr& e, size_t argument) {
        return (e.builtin->effects & kMessage) && e.args[argument]->type.array_length == 0;
    }
    Flow builtin_call(CallExpr& e) {
        Flow f = flow(e.channel);
        for (size_t i = 0; i < e.args.size(); ++i) f = join(f, flow(e.args[i]));
        uint32_t effects = e.builtin->effects;
        if (effects & kConstantResult) f = kConstant;
        if (effects & kSetsLength) set_length(e);
        if (effects & kReadsLength) f = length_of(e.args[0]);
        if (effects & kVaryingResult) f = kVaryingFlow;
        // "uniform float r = random()", and lightsource() into a uniform, as real shaders have it.
        if (effects == kVaryingResult || (effects & kMessage)) f.illegal = false;
        if (effects & (kService | kMessage | kDerivative)) f.constant = false;
        if (*e.builtin->globals) f = kVaryingFlow;
        for (size_t i = 0; i < e.signature->arguments.size(); ++i)
            if (e.signature->arguments[i].output) {
                store_to(e.args[i], f, *e.args[i]);
                if (takes_answer(e, i) && (f.varying || control_.any.varying))
                    vary_length(e.args[i]);
            }
        for (size_t i = e.pairs + 1; i < e.args.size(); i += 2)
            if (is_output_pair(e, i)) store_to(e.args[i], f, *e.args[i]);
        return f;
    }

    // ---- user functions

    Flow user_call(CallExpr& e) {
        Function& f = *e.function;
        std::vector<Flow> arguments;
        for (size_t i = 0; i < e.args.size(); ++i) {
            arguments.push_back(flow(e.args[i]));
            const Symbol& p = *f.parameters[i];
            if (declared_uniform(p) && arguments[i].illegal) complain_argument(p, e, *e.args[i]);
            if (p.type.array_length == 0 && lengths_.varies(e.args[i]) && lengths_.vary(p)) {
                note_change(&f);
                calls_.clear();
            }
        }
        CallSummary summary = summarise(f, arguments);
        for (size_t i = 0; i < e.args.size(); ++i) {
            const Symbol& p = *f.parameters[i];
            // Members of an object that the method only reads.
            bool kept = !p.assigned && p.name.find("->") != std::string_view::npos;
            if (!p.output || kept) continue;
            store_to(e.args[i], summary.outputs[i], *e.args[i]);
            if (lengths_.varies(p)) vary_length(e.args[i]);
        }
        return summary.result;
    }

    void complain_argument(const Symbol& p, const CallExpr& call, const Expr& at) {
        if (!reported_.insert(&at).second) return;
        const Token& token = ast_.tokens.tokens[at.span.token];
        reporter_
            .report(Code::RSL_UNIFORM_ARGUMENT, at.span.where, token.macro, token.spelling, p.name,
                    call.name)
            .notes.push_back({p.span.where, "declared here"});
    }

    static char letter(Flow f) { return char('a' + f.constant + 2 * f.varying + 4 * f.illegal); }

    CallSummary summarise(Function& f, const std::vector<Flow>& arguments) {
        for (Active& active : active_)
            if (active.function == &f) return call_again(active, arguments);
        // What a recursive function gives rests on the callers being walked: it is not kept.
        if (f.recursive) return walk_function(f, arguments);
        std::string key = std::to_string(f.id) + letter(control_.any);
        for (Flow a : arguments) key += letter(a);
        auto found = calls_.find(key);
        if (found != calls_.end()) return found->second;
        CallSummary summary = walk_function(f, arguments);
        bool inside_circle = false;
        for (const Active& active : active_)
            inside_circle = inside_circle || active.function->recursive;
        return inside_circle ? summary : calls_[key] = summary;
    }

    // A function that is being walked is called: its arguments join those it is walked with, and
    // what is known of its result so far is the answer; both rise to a fixed point.
    CallSummary call_again(Active& active, const std::vector<Flow>& arguments) {
        const Function& f = *active.function;
        for (size_t i = 0; i < arguments.size(); ++i) {
            Symbol& p = *f.parameters[i];
            Flow joined = join(flows_[p.id], arguments[i]);
            if (declared_uniform(p)) joined.illegal = false;
            if (same(joined, flows_[p.id])) continue;
            flows_[p.id] = joined;
            p.varying = p.varying || joined.varying;
            note_change(&f);
        }
        Flow control = join(active.control, control_.any);
        if (!same(control, std::exchange(active.control, control))) note_change(&f);
        CallSummary summary{active.result, {}};
        for (const Symbol* p : f.parameters) summary.outputs.push_back(flows_[p->id]);
        return summary;
    }
    void note_change(const Function* owner) {
        changed_ = true;
        if (owner != walking_) outside_.push_back(owner);
    }

    // The body's own fixed point: its variables start afresh with each pattern of arguments, those
    // outside it only ever rise.
    CallSummary walk_function(Function& f, const std::vector<Flow>& arguments) {
        for (size_t i = 0; i < arguments.size(); ++i) {
            Flow a = arguments[i];
            if (declared_uniform(*f.parameters[i])) a.illegal = false;
            declare(*f.parameters[i], a);
        }
        for (Symbol* local : locals_[f.id]) declare(*local, kConstant);
        Flow result_before = std::exchange(result_, kConstant);
        Flow returned_before = std::exchange(returned_, kConstant);
        bool changed_before = changed_;
        auto loops_before = std::exchange(loops_, {});
        const Function* caller = std::exchange(walking_, &f);
        size_t level = active_.size();
        active_.push_back({&f, kConstant, control_.any});
        Control control_before = control_;
        do {
            changed_ = false;
            control_ = {active_[level].control, kConstant};
            walk(*f.body);
            if (f.recursive && !same(active_[level].result, result_)) changed_ = true;
            active_[level].result = result_;
        } while (changed_ && steps_ < kMostSteps);
        active_.pop_back();
        control_ = control_before;
        CallSummary summary{result_, {}};
        for (const Symbol* p : f.parameters) summary.outputs.push_back(flows_[p->id]);
        walking_ = caller;
        changed_ = changed_before || std::erase(outside_, caller) > 0;
        loops_ = std::move(loops_before);
        returned_ = returned_before;
        result_ = result_before;
        return summary;
    }

    // ---- statements

    void walk(Stmt& s) {
        if (++steps_ > kMostSteps) return;
        Control before = std::exchange(control_, control_.under(returned_));
        visit_stmt(s, [&](auto& node) { at(node); });
        control_ = before;
    }
    void walk_under(Stmt& s, Flow condition) {
        Control before = std::exchange(control_, control_.under(condition));
        walk(s);
        control_ = before;
    }
    // Points that have left a loop do not take part in what is assigned in it.
    void loop(Stmt& s, Stmt& body, Expr* condition, std::span<Expr*> step, Flow turns) {
        // The condition reads what the body stores: the next round of the fixed point sees to it.
        Control before = control_;
        loops_.push_back(&s);
        control_ = control_.under(join(turns, flow(condition)));
        if (exits_.contains(&s)) control_ = control_.under(kVaryingFlow);
        walk(body);
        flow_all(step);
        loops_.pop_back();
        control_ = before;
    }
    void leave(const Stmt* target) {
        if (!control_.own.varying) return;
        for (size_t i = loops_.size(); i-- > 0;) {
            if (exits_.insert(loops_[i]).second) changed_ = true;
            if (loops_[i] == target) break;
        }
    }

    void at(BlockStmt& s) {
        for (Stmt* item : s.body) walk(*item);
    }
    void at(DeclareStmt& s) {
        for (Symbol* symbol : s.symbols) {
            declare_local(*symbol);
            if (flow(symbol->length).varying) lengths_.vary(*symbol);
            if (!symbol->initial) continue;
            Flow value = flow(symbol->initial);
            if (lengths_.varies(symbol->initial)) lengths_.vary(*symbol);
            store(*symbol, value, kConstant, *symbol->initial);
        }
    }
    void at(ExternStmt&) {}
    void at(FunctionStmt&) {}
    void at(ExpressionStmt& s) { flow(s.expression); }
    void at(IfStmt& s) {
        Flow condition = flow(s.condition);
        walk_under(*s.yes, condition);
        if (s.no) walk_under(*s.no, condition);
    }
    void at(WhileStmt& s) { loop(s, *s.body, s.condition, {}, kConstant); }
    void at(ForStmt& s) {
        for (Stmt* item : s.init) walk(*item);
        loop(s, *s.body, s.condition, s.step, kConstant);
    }
    void at(BreakStmt& s) { leave(s.loop); }
    void at(ContinueStmt& s) { leave(s.loop); }
    void at(ReturnStmt& s) {
        Flow value = s.value ? flow(s.value) : kConstant;
        result_ = join(result_, value);
        if (!control_.own.varying) return;
        result_ = join(result_, control_.own);
        returned_ = join(returned_, control_.own);
        leave(nullptr);
    }
    void at(IlluminanceStmt& s) {
        flow(s.category), flow(s.position), flow(s.axis), flow(s.angle);
        flow_all(s.pairs);
        store_pairs(s.pairs, is_light_output);
        loop(s, *s.body, nullptr, {}, kVaryingFlow);
    }
    void store_pairs(std::span<Expr*> pairs, bool (*is_output)(std::string_view)) {
        for (size_t k = 1; k < pairs.size(); k += 2)
            if (is_output(pair_name(pairs, k))) store_to(pairs[k], kVaryingFlow, *pairs[k]);
    }
    void at(IlluminateStmt& s) {
        flow(s.position), flow(s.axis), flow(s.angle);
        walk_under(*s.body, kVaryingFlow);
    }
    void at(SolarStmt& s) {
        flow(s.axis), flow(s.angle);
        walk_under(*s.body, kVaryingFlow);
    }
    void at(GatherStmt& s) {
        flow_all(s.args);
        store_pairs(s.pairs, is_gather_output);
        loop(s, *s.body, nullptr, {}, kVaryingFlow);
        if (s.missed) loop(s, *s.missed, nullptr, {}, kVaryingFlow);
    }

    const ShaderDefinition& shader_;
    Ast& ast_;
    Reporter& reporter_;
    std::vector<Flow> flows_;  // by Symbol::id
    std::vector<bool> known_;  // by Symbol::id: locals that were met
    VaryingLengths lengths_;
    std::vector<std::vector<Symbol*>> locals_;  // by Function::id
    std::unordered_map<std::string, CallSummary> calls_;
    std::vector<Active> active_;            // functions being walked, outermost first
    const Function* walking_ = nullptr;     // the function whose body is being walked
    std::vector<const Function*> outside_;  // owners of variables that a callee has changed
    int steps_ = 0;
    std::unordered_set<const Expr*> reported_;
    std::unordered_set<const Stmt*> exits_;  // loops that some points leave before others
    std::vector<Stmt*> loops_;
    Flow result_ = kConstant;
    Flow returned_ = kConstant;  // under what some points have returned
    Control control_;
    bool changed_ = false;
};

}  // namespace

void infer_rates(Ast& ast, Reporter& reporter) {
    for (const ShaderDefinition* shader : ast.shaders) RateWalk(*shader, ast, reporter).run();
}

}  // namespace kinora::rsl
