// rsl/objects/pipeline.cpp: a class as one shader: its methods are called in the order of the
// pipeline, and its members are variables that live through it.
#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "rsl/objects/expand.h"
#include "rsl/objects/light_samples.h"

namespace kinora::rsl {

namespace {

class Pipeline {
  public:
    Pipeline(Ast& ast, Reporter& reporter, ShaderDefinition& shader)
        : ast_(ast), reporter_(reporter), shader_(shader), make_(ast, shader.span) {}

    void run() {
        if (shader_.shader_class->methods.empty()) {
            const Token& at = ast_.tokens.tokens[shader_.span.token];
            reporter_.report(Code::RSL_CLASS_WITHOUT_METHODS, at, shader_.name);
            return;
        }
        std::optional<ShaderKind> kind = kind_of();
        shader_.kind = kind.value_or(ShaderKind::Surface);
        shader_.displaces = kind == ShaderKind::Surface && has("displacement");
        shader_.co_shader = !kind;
        if (kind)
            for (const Function* method : shader_.shader_class->methods) judge(*method);
        const ClassDefinition& c = *shader_.shader_class;
        out_.assign(c.members.begin(), c.members.end());
        for (Function* method : c.methods) {
            auto* definition = ast_.make<FunctionStmt>(method->span);
            definition->function = method;
            out_.push_back(definition);
        }
        stages();
        shader_.body->body = ast_.arena.copy(out_);
    }

  private:
    const Function* find(std::string_view name) const {
        for (const Function* method : shader_.shader_class->methods)
            if (method->name == name) return method;
        return nullptr;
    }
    bool has(std::string_view name) const { return find(name) != nullptr; }

    template <class... Args>
    void report(const FindingInfo& info, const SourceSpan& span, const Args&... args) {
        const Token& token = ast_.tokens.tokens[span.token];
        reporter_.report(info, span.where, token.macro, token.spelling, args...);
    }

    // Methods that nobody calls although their names say who should.
    void judge(const Function& method) {
        if (method.name == shader_.name)
            report(Code::RSL_CLASS_NAME_METHOD, method.span, method.name);
        bool bends = shader_.kind == ShaderKind::Surface && method.name == "displacement";
        for (const auto& row : kKinds)
            if (row.method == method.name && row.kind != shader_.kind && !bends)
                report(Code::RSL_METHOD_NOT_CALLED, method.span, method.name, shader_.name,
                       shader_kind_name(shader_.kind));
    }

    // What the class is bound as: the first of these stages that it has.
    static constexpr struct {
        std::string_view method;
        ShaderKind kind;
    } kKinds[] = {{"light", ShaderKind::Light},
                  {"surface", ShaderKind::Surface},
                  {"lighting", ShaderKind::Surface},
                  {"diffuselighting", ShaderKind::Surface},
                  {"specularlighting", ShaderKind::Surface},
                  {"prelighting", ShaderKind::Surface},
                  {"postlighting", ShaderKind::Surface},
                  {"opacity", ShaderKind::Surface},
                  {"volume", ShaderKind::Volume},
                  {"imager", ShaderKind::Imager},
                  {"transformation", ShaderKind::Transformation},
                  {"displacement", ShaderKind::Displacement}};
    std::optional<ShaderKind> kind_of() const {
        if (shader_.only_displaces) return ShaderKind::Displacement;
        for (const auto& row : kKinds)
            if (has(row.method)) return row.kind;
        if (has(kLightSamples)) return ShaderKind::Light;
        return {};
    }

    void stages() {
        if (shader_.only_displaces) hand_on_rest();
        if (shader_.displaces) keep_given();
        call("construct", {});
        call("begin", {});
        if (shader_.co_shader) return;
        switch (shader_.kind) {
            case ShaderKind::Surface:
                return surface();
            case ShaderKind::Light:
                return light();
            case ShaderKind::Volume:
                return call("volume", {"Ci", "Oi"});
            case ShaderKind::Imager:
                return call("imager", {"Ci", "Oi", "alpha"});
            case ShaderKind::Transformation:
                return call("transformation", {"P", "N"});
            case ShaderKind::Displacement:
                return call("displacement", {"P", "N"});
        }
    }

    // Whether one of the words stands before such a punctuator in the method's text.
    bool has_words(const Function& method, std::initializer_list<std::string_view> words,
                   Punct behind) const {
        const auto& tokens = ast_.tokens.tokens;
        int depth = 0;
        for (size_t i = method.body->span.token; i + 1 < tokens.size(); ++i) {
            depth += tokens[i].punct == Punct::LeftBrace;
            depth -= tokens[i].punct == Punct::RightBrace;
            if (depth == 0) break;
            bool named = std::find(words.begin(), words.end(), tokens[i].text) != words.end();
            if (named && tokens[i + 1].punct == behind) return true;
        }
        return false;
    }

    // A light with sample methods sends its samples. One without illuminate and solar that sets L
    // shines from Ps - L.
    void light() {
        if (has(kLightSamples)) {
            drop_formals("light", {"L", "Cl", "Ol"});
            return call(kLightSamples, {});
        }
        const Function* method = find("light");
        bool aims = has_words(*method, {"illuminate", "solar"}, Punct::LeftParen);
        bool sets_L = method->parameters.size() > 1 &&
                      has_words(*method, {method->parameters[0]->name}, Punct::Assign);
        if (aims || !sets_L) {
            drop_formals("light", {"L", "Cl", "Ol"});
            return call("light", {"L", "Cl", "Ol"});
        }
        out_.push_back(make_.declare({local(BaseType::Vector, "pipeline->L"),
                                      local(BaseType::Color, "pipeline->Cl"),
                                      local(BaseType::Color, "pipeline->Ol")}));
        call("light", {"pipeline->L", "pipeline->Cl", "pipeline->Ol"});
        auto* from = ast_.make<IlluminateStmt>(shader_.span);
        from->position =
            make_.binary(Op::Subtract, make_.variable("Ps"), make_.variable("pipeline->L"));
        from->body =
            make_.block({make_.assign(make_.variable("Cl"), make_.variable("pipeline->Cl"))});
        out_.push_back(from);
    }

    // L and Cl are those of the illuminate or solar statement, so a method's own are those too.
    void drop_formals(std::string_view name, std::initializer_list<std::string_view> globals) {
        for (Function* method : shader_.shader_class->methods) {
            auto named = [&](const Symbol* formal) {
                return std::find(globals.begin(), globals.end(), formal->name) != globals.end();
            };
            auto formals = method->parameters;
            if (method->name == name && std::all_of(formals.begin(), formals.end(), named))
                method->parameters = {};
        }
    }

    // The first method of the name that takes the globals, or as many of them as it likes.
    const Function* fitting(std::string_view name,
                            std::initializer_list<std::string_view> globals) {
        const Function* first = find(name);
        if (!first) return nullptr;
        for (const Function* method : shader_.shader_class->methods)
            if (method->name == name && fits(*method, globals)) return method;
        if (told_.insert(name).second)
            report(Code::RSL_METHOD_PARAMETERS, first->span, name, text_of(globals));
        return nullptr;
    }

    static bool fits(const Function& method, std::initializer_list<std::string_view> globals) {
        if (method.parameters.size() > globals.size()) return false;
        const std::string_view* global = globals.begin();
        for (const Symbol* formal : method.parameters) {
            bool number = *global++ == "alpha";
            if (number ? formal->type != Type{BaseType::Float, -1} : !is_triple(formal->type))
                return false;
        }
        return true;
    }

    static std::string text_of(std::initializer_list<std::string_view> globals) {
        std::string text;
        for (std::string_view global : globals) {
            std::string_view name = global.substr(global.rfind('>') + 1);  // "pipeline->L"
            std::string_view type = name == "P"       ? "point"
                                    : name == "N"     ? "normal"
                                    : name == "L"     ? "vector"
                                    : name == "alpha" ? "float"
                                                      : "color";
            text += fmt::format("{}output {} {}", text.empty() ? "" : "; ", type, name);
        }
        return text;
    }

    // The method with as many of the globals as it takes; they are what it calls P, Ci and so on.
    void call(std::string_view name, std::initializer_list<std::string_view> globals) {
        const Function* method = fitting(name, globals);
        if (!method) return;
        std::vector<Expr*> args;
        for (std::string_view global : globals)
            if (args.size() < method->parameters.size()) args.push_back(make_.variable(global));
        out_.push_back(make_.effect(make_.call(name, args)));
    }

    void surface() {
        if (shader_.displaces) displace();
        out_.push_back(make_.assign(make_.variable("Ci"), make_.number(0)));
        out_.push_back(make_.assign(make_.variable("Oi"), make_.variable("Os")));
        if (!has("opacity")) return shading();
        out_.push_back(opacity_call());
        std::vector<Stmt*> rest = part([&] { shading(); });
        IfStmt* seen = make_.branch(
            make_.binary(Op::NotEqual, make_.call("seenopacity", {make_.variable("Oi")}),
                         make_.number(0)),
            std::move(rest));
        seen->no = make_.assign(make_.variable("Oi"), make_.number(0));
        seen->behind_opacity = true;
        out_.push_back(seen);
    }

    // What `add` appends, by itself.
    template <class F>
    std::vector<Stmt*> part(F&& add) {
        std::vector<Stmt*> before = std::exchange(out_, {});
        add();
        return std::exchange(out_, std::move(before));
    }

    // __computesOpacity = 0 promises that shadow rays need not ask: they then see Os.
    Stmt* opacity_call() {
        std::vector<Stmt*> made = part([&] { call("opacity", {"Oi"}); });
        for (const Symbol* parameter : shader_.parameters) {
            const auto* number = as_if<NumberExpr>(parameter->initial);
            if (parameter->name != "__computesOpacity" || !number || number->value != 0) continue;
            IfStmt* guarded = make_.branch(make_.number(1), std::move(made));
            guarded->behind_opacity = true;
            return guarded;
        }
        return made.empty() ? make_.block({}) : made[0];
    }

    using Names = std::vector<std::string_view>;

    // The first of these lists of which the class has all.
    Names first_of(std::initializer_list<Names> choices) const {
        for (const Names& names : choices)
            if (std::all_of(names.begin(), names.end(), [&](auto name) { return has(name); }))
                return names;
        return {};
    }

    // What lights a point depends on what sees it: see docs/language.md#rsl-20.
    void shading() {
        const Names pair{"diffuselighting", "specularlighting"}, whole{"lighting"},
            alone{"surface"}, diffuse{"diffuselighting"}, specular{"specularlighting"};
        Names camera = first_of({whole, pair, alone, diffuse, specular});
        Names traced = first_of({pair, whole, alone, diffuse, specular});
        Names indirect = has("diffuselighting") ? diffuse : traced;
        if (has("diffuselighting"))
            out_.push_back(make_.declare({local(BaseType::Color, "pipeline->Ii")}));
        call("prelighting", {"Ci", "Oi"});
        auto run = [&](const Names& names) {
            return part([&] {
                for (std::string_view name : names) light_by(name);
            });
        };
        auto unless = [&](double kind, std::vector<Stmt*> body) {
            return make_.branch(
                make_.binary(Op::NotEqual, make_.call("raykind", {}), make_.number(kind)),
                std::move(body));
        };
        if (camera == indirect && camera == traced) {
            for (Stmt* stmt : run(camera)) out_.push_back(stmt);
        } else if (camera == pair) {
            for (Stmt* stmt : run(diffuse)) out_.push_back(stmt);
            out_.push_back(unless(2, run(specular)));
        } else {
            std::vector<Stmt*> direct = run(camera);
            if (camera != traced) {
                IfStmt* behind = unless(0, run(traced));
                behind->no = make_.block(std::move(direct));
                direct = {behind};
            }
            IfStmt* any = unless(2, std::move(direct));
            any->no = make_.block(run(indirect));
            out_.push_back(any);
        }
        call("postlighting", {"Ci", "Oi"});
    }

    void light_by(std::string_view name) {
        if (name == "diffuselighting") return call(name, {"Ci", "Oi", "pipeline->Ii"});
        call(name, {"Ci", "Oi"});
    }

    Symbol* local(BaseType type, std::string_view name) {
        return make_.symbol(SymbolKind::Local, name, {type, -1});
    }

    Expr* displaced_is(double how) {
        return make_.binary(Op::Equal, make_.call("displaced", {}), make_.number(how));
    }

    // A displacement's own P and N before it runs, for the surface of the same class.
    void hand_on_rest() {
        std::vector<Symbol*> parameters(shader_.parameters.begin(), shader_.parameters.end());
        for (Symbol* parameter : parameters) parameter->output = false;
        for (auto [name, rest, type] : {std::tuple{"P", "rest P", BaseType::Point},
                                        std::tuple{"N", "rest N", BaseType::Normal}}) {
            Symbol* left = make_.symbol(SymbolKind::Parameter, rest, {type, -1});
            left->output = true;
            left->detail = Detail::Varying;
            parameters.push_back(left);
            out_.push_back(make_.assign(make_.variable(rest), make_.variable(name)));
        }
        shader_.parameters = ast_.arena.copy(parameters);
    }

    // begin() and displacement() work on the surface as it is without displacement. Where that has
    // moved the vertices, they handed that on.
    void keep_given() {
        std::vector<Symbol*> kept;
        std::vector<Stmt*> back;
        for (auto [name, rest, type, move] :
             {std::tuple{"P", "rest P", BaseType::Point, "transform"},
              std::tuple{"N", "rest N", BaseType::Normal, "ntransform"}}) {
            kept.push_back(local(type, ast_.arena.copy(std::string("pipeline->") + name)));
            kept.back()->initial = make_.variable(name);
            back.push_back(make_.effect(
                make_.call("displacementvalue", {make_.text(rest), make_.variable(name)})));
            back.push_back(make_.assign(
                make_.variable(name), make_.call(move, {make_.text("object"), make_.text("current"),
                                                        make_.variable(name)})));
        }
        out_.push_back(make_.declare(kept));
        out_.push_back(make_.branch(displaced_is(1), std::move(back)));
    }

    // Where the vertices have moved, P and N are given. Else the normal is bent, as by a
    // displacement that is joined with a surface: the points stay.
    void displace() {
        call("displacement", {"P", "N"});
        auto is = [&](Op op, std::string_view name) {
            return make_.binary(op, make_.variable(name), given(name));
        };
        Expr* moved = make_.call("calculatenormal", {make_.variable("P")});
        IfStmt* normal =
            make_.branch(make_.binary(Op::And, is(Op::NotEqual, "P"), is(Op::Equal, "N")),
                         {make_.assign(make_.variable("N"), make_.call("normalize", {moved}))});
        out_.push_back(
            make_.branch(displaced_is(0), {normal, make_.assign(make_.variable("P"), given("P"))}));
        out_.push_back(
            make_.branch(displaced_is(1), {make_.assign(make_.variable("P"), given("P")),
                                           make_.assign(make_.variable("N"), given("N"))}));
    }
    Expr* given(std::string_view name) {
        return make_.variable(ast_.arena.copy("pipeline->" + std::string(name)));
    }

    Ast& ast_;
    Reporter& reporter_;
    ShaderDefinition& shader_;
    TreeBuilder make_;
    std::vector<Stmt*> out_;
    std::set<std::string_view> told_;  // methods whose parameters do not fit
};

}  // namespace

void make_pipeline(Ast& ast, Reporter& reporter, ShaderDefinition& shader) {
    Pipeline(ast, reporter, shader).run();
}

}  // namespace kinora::rsl
