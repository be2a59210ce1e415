// rsl/check/call.cpp: which function a call means. Overloads are chosen by the arguments first, by
// the type that is wanted of the result second, by the order of the row third.
#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/check/check.h"
#include "rsl/model/pairs.h"
#include "rsl/text/did_you_mean.h"
#include "rsl/text/standard_headers.h"

namespace kinora::rsl {

namespace {

constexpr int kArgumentWeight = 64;  // an argument's conversion outweighs any of the result's
constexpr int kUnwantedResult = 50;  // a result that does not convert to what is wanted

int result_cost(Type result, BaseType wanted) {
    if (wanted == BaseType::Invalid) return 0;
    int cost = conversion_cost(result.base, wanted);
    return cost < 0 ? kUnwantedResult : cost;
}

// What other languages call it, and what RSL has instead.
struct HintRow {
    std::string_view name;
    const char* help;
};
constexpr HintRow kHints[] = {
    {"dot", "write 'a . b'"},
    {"cross", "write 'a ^ b'"},
    {"lerp", "use mix(a, b, x)"},
    {"frac", "use mod(x, 1)"},
    {"fract", "use mod(x, 1)"},
    {"fmod", "use mod(x, y)"},
    {"saturate", "use clamp(x, 0, 1)"},
    {"rsqrt", "use inversesqrt(x)"},
    {"fabs", "use abs(x)"},
    {"rand", "use random()"},
    {"powf", "use pow(x, y)"},
    {"atan2", "use atan(y, x)"},
    {"tex2D", "use texture(name, s, t)"},
    {"texture2D", "use texture(name, s, t)"},
    {"power", "use pow(x, y)"},
    {"int", "use floor(x)"},
    {"trunc", "use floor(x)"},
    {"unit", "use normalize(v)"},
    {"vec3", "write 'vector(x, y, z)'"},
    {"rgb", "write 'color(r, g, b)'"},
    {"not", "write '!'"},
    {"ln", "use log(x)"},
    {"log10", "use log(x, 10)"},
    {"print", "use printf(\"...\", x)"},
};

}  // namespace

void Checker::check(Expr*&, CallExpr& e, BaseType wanted) {
    std::vector<Function*> functions = visible_functions(e.name);
    bool builtin = functions.empty() && !find_builtin(e.name).empty();
    if (builtin) take_channel(e);
    check_arguments(e);
    if (!functions.empty())
        call_function(e, functions, wanted);
    else if (builtin)
        call_builtin(e, wanted);
    else
        unknown_function(e);
}

// name[channel] as first argument of a built-in: the index of a string that is no array.
void Checker::take_channel(CallExpr& e) {
    auto* index = e.args.empty() ? nullptr : as_if<IndexExpr>(e.args[0]);
    if (!index) return;
    const Expr* name = index->array;
    bool literal = name->kind == ExprKind::String;
    bool element = false, variable = false;
    if (const auto* inner = as_if<IndexExpr>(name)) {
        const auto* array = as_if<VariableExpr>(inner->array);
        const Symbol* symbol = array ? find_variable(array->name, false) : nullptr;
        element = symbol && symbol->type.base == BaseType::String && symbol->type.is_array();
    } else if (const auto* v = as_if<VariableExpr>(name)) {
        const Symbol* symbol = find_variable(v->name, false);
        variable = symbol && symbol->type == Type{BaseType::String, -1};
    }
    if (!literal && !element && !variable) return;
    e.channel = index->index;
    e.args[0] = index->array;
    check_number(e.channel, "a channel");
}

// All arguments but those whose type the function will choose.
void Checker::check_arguments(CallExpr& e) {
    for (Expr*& argument : e.args)
        if (!is_flexible(*argument)) expression(argument, BaseType::Invalid);
}

std::vector<Function*> Checker::visible_functions(std::string_view name) const {
    std::vector<Function*> found;
    for (size_t i = scopes_.size(); i-- > 0 && found.empty();)
        for (Function* f : scopes_[i].functions)
            if (f->name == name) found.push_back(f);
    return found;
}

// ---- costs --------------------------------------------------------------------------------------

int Checker::argument_cost(const Expr& argument, Type type, bool output) const {
    if (is_flexible(argument) && argument.type.base == BaseType::Invalid) {
        if (output || type.is_array()) return -1;
        if (type.base == BaseType::Invalid || can_be(argument, type.base)) return 0;
        if (can_be(argument, BaseType::Float)) return conversion_cost(BaseType::Float, type.base);
        // A triple in any case: (x, y, z), or noise(P) beside a color.
        bool triple = can_be(argument, BaseType::Point) || can_be(argument, BaseType::Color);
        return conversion_cost(triple ? BaseType::Point : BaseType::Float, type.base);
    }
    if (argument.type.base == BaseType::Invalid) return 0;  // already reported
    if (type.is_array() || argument.type.is_array()) {
        bool lengths = type.array_length == argument.type.array_length || type.array_length == 0 ||
                       argument.type.array_length == 0;
        bool fits = type.is_array() && argument.type.is_array() && lengths &&
                    type.base == argument.type.base;
        return fits ? 0 : -1;
    }
    if (type.base == BaseType::Invalid) return argument.type.base == BaseType::Void ? -1 : 0;
    if (output) {
        bool triples = is_triple(type) && is_triple(argument.type);
        return argument.type.base == type.base ? 0 : triples ? 1 : -1;
    }
    return conversion_cost(argument.type.base, type.base);
}

int Checker::function_cost(const CallExpr& e, const Function& f, BaseType wanted) const {
    if (e.args.size() != f.parameters.size()) return -1;
    int total = result_cost(f.result, wanted);
    for (size_t i = 0; i < e.args.size(); ++i) {
        int cost = argument_cost(*e.args[i], f.parameters[i]->type, f.parameters[i]->output);
        if (cost < 0) return -1;
        total += cost * kArgumentWeight;
    }
    return total;
}

int Checker::builtin_cost(const CallExpr& e, const Signature& s, BaseType wanted) const {
    size_t fixed = s.arguments.size();
    if (e.args.size() < fixed || (e.args.size() > fixed && !s.repeats && !s.pairs)) return -1;
    int total = result_cost(s.result, wanted);
    for (size_t i = 0; i < e.args.size(); ++i) {
        if (i >= fixed && s.pairs) return pairs_cost(e, i) < 0 ? -1 : total;
        const Signature::Argument& a = i < fixed ? s.arguments[i] : s.repeated;
        int cost = argument_cost(*e.args[i], a.type, a.output);
        if (cost < 0) return -1;
        // abs(noise(P)) is a float, as in the specification, which has no other abs: a
        // componentwise form is for arguments that are triples.
        bool open = is_flexible(*e.args[i]) && e.args[i]->type.base == BaseType::Invalid;
        if (open && a.type.base != BaseType::Float && can_be(*e.args[i], BaseType::Float)) ++cost;
        total += cost * kArgumentWeight;
    }
    return total;
}

// "name", value, "name", value from `first` on.
int Checker::pairs_cost(const CallExpr& e, size_t first) const {
    if ((e.args.size() - first) % 2 != 0) return -1;
    for (size_t i = first; i < e.args.size(); i += 2)
        if (e.args[i]->type != Type{BaseType::String, -1}) return -1;
    return 0;
}

// ---- binding ------------------------------------------------------------------------------------

void Checker::call_function(CallExpr& e, std::span<Function* const> functions, BaseType wanted) {
    Candidate best;
    for (Function* f : functions) {
        int cost = function_cost(e, *f, wanted);
        if (cost >= 0 && (best.cost < 0 || cost < best.cost)) best = {f, nullptr, cost};
    }
    if (best.function) return bind_function(e, *best.function);
    if (fits_builtin(e, wanted)) return call_builtin(e, wanted);
    if (functions.size() > 1) return no_overload(e);
    Function& only = *functions[0];
    if (only.parameters.size() == e.args.size()) return bind_function(e, only);
    e.type = only.result;
    if (only.damaged) return;  // its parameters may be among what is missing
    report(Code::RSL_ARGUMENT_COUNT, e.span, e.name, only.parameters.size(), e.args.size())
        .notes.push_back({only.span.where, "defined here"});
}

// A user's function of the name does not fit, the built-in one does.
bool Checker::fits_builtin(const CallExpr& e, BaseType wanted) const {
    std::span<const Overload> overloads = find_builtin(e.name);
    return std::any_of(overloads.begin(), overloads.end(), [&](const Overload& o) {
        return builtin_cost(e, o.signature, wanted) >= 0;
    });
}

void Checker::bind_function(CallExpr& e, Function& f) {
    e.function = &f;
    e.type = f.result;
    e.pairs = uint32_t(e.args.size());
    for (size_t i = 0; i < e.args.size(); ++i)
        bind_argument(e, i, f.parameters[i]->type, f.parameters[i]->output);
    edges_.push_back({function_, &f, &e});
}

void Checker::call_builtin(CallExpr& e, BaseType wanted) {
    const Overload* best = nullptr;
    int best_cost = -1;
    for (const Overload& o : find_builtin(e.name)) {
        int cost = builtin_cost(e, o.signature, wanted);
        if (cost < 0 || (best && cost >= best_cost)) continue;
        best = &o;
        best_cost = cost;
    }
    if (!best) return no_overload(e);
    bind_builtin(e, *best);
}

void Checker::bind_builtin(CallExpr& e, const Overload& overload) {
    const Signature& s = overload.signature;
    e.builtin = overload.builtin;
    e.signature = &s;
    e.type = s.result;
    size_t fixed = s.arguments.size();
    e.pairs = uint32_t(s.pairs ? fixed : e.args.size());
    for (size_t i = 0; i < e.args.size(); ++i) {
        if (i >= e.pairs) {
            bind_argument(e, i, {BaseType::Invalid, -1}, false);
            if (!is_output_pair(e, i) || e.args[i]->type.base == BaseType::Invalid) continue;
            if (Symbol* symbol = lvalue_symbol(*e.args[i]); symbol && !e.args[i]->type.is_array())
                mark_assigned(*symbol, e.args[i]->span);
            else
                report(Code::RSL_OUTPUT_ARGUMENT, e.args[i]->span, i + 1, e.name);
            continue;
        }
        const Signature::Argument& a = i < fixed ? s.arguments[i] : s.repeated;
        bind_argument(e, i, a.type, a.output);
    }
    bool names_channels = overload.builtin->effects & (kReadsChannels | kWritesChannels);
    if (!names_channels) drop_unfit(e.args, e.pairs, e.name);
    if (overload.builtin->effects & kNamesFile) check_file_name(e);
    if (!overload.builtin->lower && options_.require_implemented)
        report(Code::RSL_NOT_SUPPORTED, e.span, fmt::format("'{}'", e.name));
}

// A file that the shader will not be let to read.
void Checker::check_file_name(const CallExpr& e) {
    const auto* name = e.args.empty() ? nullptr : as_if<StringExpr>(e.args[0]);
    if (name && options_.files.find(name->value).outside)
        report(Code::RSL_FILE_OUTSIDE, name->span, name->value);
}

// Brings an argument to the parameter's type; base Invalid takes any.
void Checker::bind_argument(CallExpr& e, size_t index, Type type, bool output) {
    Expr*& argument = e.args[index];
    bool unchecked = argument->type.base == BaseType::Invalid && is_flexible(*argument);
    if (unchecked) expression(argument, type.base);
    if (argument->type.base == BaseType::Invalid) return;
    if (output) {
        if (argument_cost(*argument, type, true) < 0)
            report(Code::RSL_OUTPUT_TYPE, argument->span, index + 1, e.name, type_name(type),
                   type_name(argument->type));
        else if (!lvalue_symbol(*argument))
            report(Code::RSL_OUTPUT_ARGUMENT, argument->span, index + 1, e.name);
        else
            mark_assigned(*lvalue_symbol(*argument), argument->span);
        return;
    }
    if (type.base == BaseType::Invalid) {
        if (argument->type.base == BaseType::Bool) convert(argument, BaseType::Float);
        return;
    }
    bool fits =
        type.is_array() ? argument_cost(*argument, type, false) >= 0 : convert(argument, type.base);
    if (!fits)
        report(Code::RSL_TYPE_MISMATCH, argument->span,
               fmt::format("argument {} of '{}'", index + 1, e.name), type_name(type),
               type_name(argument->type))
            .help = type.is_array() || argument->type.is_array()
                        ? ""
                        : conversion_help(argument->type.base, type.base);
}

// ---- calls that mean nothing --------------------------------------------------------------------

std::string Checker::argument_types(const CallExpr& e) const {
    std::string text;
    for (const Expr* argument : e.args) {
        if (!text.empty()) text += ", ";
        bool open = argument->type.base == BaseType::Invalid && is_flexible(*argument);
        text += open ? argument->kind == ExprKind::Triple ? "triple" : "float or triple"
                     : type_name(argument->type);
    }
    return text;
}

namespace {

std::string form_text(std::string_view name, const Signature& s) {
    auto argument = [](const Signature::Argument& a) {
        std::string type = a.type.base == BaseType::Invalid ? "any" : type_name(a.type);
        return (a.output ? "output " : "") + type;
    };
    std::string text;
    for (const Signature::Argument& a : s.arguments)
        text += (text.empty() ? "" : ", ") + argument(a);
    if (s.repeats) text += (text.empty() ? "" : ", ") + argument(s.repeated) + " ...";
    if (s.pairs) text += std::string(text.empty() ? "" : ", ") + "\"name\", value ...";
    return fmt::format("{} {}({})", type_name(s.result), name, text);
}

std::string form_text(const Function& f) {
    std::string text;
    for (const Symbol* p : f.parameters)
        text += (text.empty() ? "" : ", ") + std::string(p->output ? "output " : "") +
                type_name(p->type);
    return fmt::format("{} {}({})", type_name(f.result), f.name, text);
}

constexpr size_t kMostForms = 4;  // shown in a finding

}  // namespace

void Checker::no_overload(CallExpr& e) {
    for (const Expr* argument : e.args)
        if (argument->type.base == BaseType::Invalid && !is_flexible(*argument)) return;
    Finding& finding = report(Code::RSL_NO_OVERLOAD, e.span, e.name, argument_types(e));
    std::vector<std::string> forms;
    for (const Function* f : visible_functions(e.name)) forms.push_back(form_text(*f));
    if (forms.empty())
        for (const Overload& o : find_builtin(e.name))
            forms.push_back(form_text(e.name, o.signature));
    for (size_t i = 0; i < std::min(forms.size(), kMostForms); ++i)
        finding.help += (i ? ", " : "forms: ") + forms[i];
    if (forms.size() > kMostForms) finding.help += ", ...";
}

void Checker::unknown_function(CallExpr& e) {
    if (recovery_.hides(e.name, e.span.token) || !unknown_functions_.insert(e.name).second) return;
    std::string_view origin = foreign_builtin(e.name);
    if (origin == "RSL 2.0") {
        report(Code::RSL_2, e.span, fmt::format("'{}()'", e.name));
        reporter_.stop();
        return;
    }
    if (!origin.empty()) {
        report(Code::RSL_FOREIGN_FUNCTION, e.span, e.name, origin);
        return;
    }
    Finding& finding = report(Code::RSL_UNKNOWN_FUNCTION, e.span, e.name);
    for (const HintRow& row : kHints)
        if (row.name == e.name) finding.help = row.help;
    for (const ShaderDefinition* shader : ast_.shaders)
        if (shader->name == e.name) finding.help = "it is a shader, which cannot be called";
    if (const Symbol* symbol = find_symbol(e.name); symbol && finding.help.empty())
        finding.help = symbol->type == Type{BaseType::String, -1}
                           ? fmt::format(
                                 "it is a variable; write 'transform({}, (x, y, z))' for a "
                                 "point in the space that it names",
                                 e.name)
                           : "it is a variable, which cannot be called";
    if (!finding.help.empty()) return;
    if (std::string_view header = header_that_defines(e.name); !header.empty()) {
        finding.help = fmt::format("write '#include \"{}\"' at the beginning", header);
        return;
    }
    std::vector<std::string_view> names = builtin_names();
    for (const Scope& scope : scopes_)
        for (const Function* f : scope.functions) names.push_back(f->name);
    for (int k = 0; k < int(BaseType::Void); ++k) names.push_back(type_name(BaseType(k)));
    finding.help = meant_help(e.name, names);
}

}  // namespace kinora::rsl
