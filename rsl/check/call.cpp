// rsl/check/call.cpp: arguments and results of calls.
#include "rsl/check/call.h"

#include "rsl/builtins/table.h"
#include "rsl/check/convert.h"
#include "rsl/check/optional_parameters.h"
#include "rsl/model/pairs.h"
#include "rsl/syntax/copy_tree.h"

namespace kinora::rsl {

bool CallBinder::take_channel(CallExpr& e) {
    auto* index = e.args.empty() ? nullptr : as_if<IndexExpr>(e.args[0]);
    if (!index) return false;
    const Expr* name = index->array;
    bool literal = name->kind == ExprKind::String;
    bool element = false, variable = false;
    if (const auto* inner = as_if<IndexExpr>(name)) {
        const auto* array = as_if<VariableExpr>(inner->array);
        const Symbol* symbol = array ? scopes_.find_variable(array->name) : nullptr;
        element = symbol && symbol->type.base == BaseType::String && symbol->type.is_array();
    } else if (const auto* v = as_if<VariableExpr>(name)) {
        const Symbol* symbol = scopes_.find_variable(v->name);
        variable = symbol && symbol->type == Type{BaseType::String, -1};
    }
    if (!literal && !element && !variable) return false;
    e.channel = index->index;
    e.args[0] = index->array;
    return true;
}

void CallBinder::group_source(CallExpr& e) {
    constexpr size_t kCorners = 4;
    if (e.name != "shadow" && e.name != "areashadow") return;
    auto is_text = [&](size_t i) { return e.args[i]->kind == ExprKind::String; };
    for (size_t k = 2; k + kCorners < e.args.size(); ++k) {
        const auto* name = as_if<StringExpr>(e.args[k]);
        if (!name || name->value != "source") continue;
        for (size_t i = k + 1; i <= k + kCorners; ++i)
            if (is_text(i)) return;
        auto* corners = ast_.make<ArrayLiteralExpr>(e.args[k + 1]->span);
        corners->type = {BaseType::Point, int(kCorners)};
        corners->items = e.args.subspan(k + 1, kCorners);
        std::vector<Expr*> args(e.args.begin(), e.args.begin() + long(k) + 1);
        args.push_back(corners);
        for (size_t i = k + 1 + kCorners; i < e.args.size(); ++i) args.push_back(e.args[i]);
        e.args = ast_.arena.copy(args);
        return;
    }
}

// Elements of arrays are channels of their own: "a", a of two is "a[0]", a[0], "a[1]", a[1].
void CallBinder::split_channels(CallExpr& e) {
    constexpr size_t kFirstPair = 3;
    if (e.name != "texture3d" && e.name != "bake3d") return;
    std::vector<Expr*> args;
    for (size_t k = 0; k < e.args.size(); ++k) {
        args.push_back(e.args[k]);
        const auto* name = as_if<StringExpr>(e.args[k]);
        bool pair = k >= kFirstPair && name && k + 1 < e.args.size();
        const auto* value = pair ? as_if<VariableExpr>(e.args[k + 1]) : nullptr;
        const Symbol* symbol = value ? scopes_.find_variable(value->name) : nullptr;
        if (!symbol || symbol->type.array_length < 1 || symbol->resizable) continue;
        args.pop_back();
        for (int element = 0; element < symbol->type.array_length; ++element) {
            auto* channel = ast_.make<StringExpr>(name->span);
            channel->value = ast_.arena.copy(fmt::format("{}[{}]", name->value, element));
            auto* number = ast_.make<NumberExpr>(value->span);
            number->value = element;
            auto* item = ast_.make<IndexExpr>(value->span);
            item->array = copy_tree(ast_, *value);
            item->index = number;
            args.insert(args.end(), {channel, item});
        }
        ++k;
    }
    e.args = ast_.arena.copy(args);
}

void CallBinder::begin(CallExpr& e, Callee callee) {
    e.function = callee.function;
    e.pairs = uint32_t(e.args.size());
    if (callee.function) {
        e.type = callee.function->result;
        return;
    }
    e.builtin = callee.builtin->builtin;
    e.signature = &callee.builtin->signature;
    e.type = e.signature->result;
    if (e.signature->pairs) e.pairs = uint32_t(e.signature->arguments.size());
}

Parameter CallBinder::parameter(const CallExpr& e, size_t index) const {
    if (index >= e.pairs) return {};
    if (e.function)
        return {e.function->parameters[index]->type, e.function->parameters[index]->output};
    const Signature& s = *e.signature;
    const Signature::Argument& a = index < s.arguments.size() ? s.arguments[index] : s.repeated;
    return {a.type, a.output};
}

void CallBinder::bind_argument(CallExpr& e, size_t index) {
    Expr*& argument = e.args[index];
    auto [type, output] = parameter(e, index);
    if (argument->type.base == BaseType::Invalid) return;
    if (output) return bind_output(*argument, index, type, e.name);
    if (type.base == BaseType::Invalid) {
        if (argument->type.base == BaseType::Bool) convert(ast_, argument, BaseType::Float);
        if (index >= e.pairs && is_output_pair(e, index))
            assignments_.assign_result(*argument, index, e.name);
        return;
    }
    bool fits = type.is_array() ? overloads_.argument_cost(*argument, type, false) >= 0
                                : convert(ast_, argument, type.base);
    if (!fits)
        reporter_
            .report(Code::RSL_TYPE_MISMATCH, argument->span,
                    fmt::format("argument {} of '{}'", index + 1, e.name), type_name(type),
                    type_name(argument->type))
            .help = type.is_array() || argument->type.is_array()
                        ? ""
                        : conversion_help(argument->type.base, type.base);
}

// The callee writes to the argument.
void CallBinder::bind_output(Expr& argument, size_t index, Type type, std::string_view callee) {
    if (overloads_.argument_cost(argument, type, true) < 0)
        reporter_.report(Code::RSL_OUTPUT_TYPE, argument.span, index + 1, written_name(callee),
                         type_name(type), type_name(argument.type));
    else if (Symbol* symbol = lvalue_symbol(argument))
        assignments_.mark(*symbol, argument.span);
    else
        reporter_.report(Code::RSL_OUTPUT_ARGUMENT, argument.span, index + 1, callee);
}

void CallBinder::end(CallExpr& e) {
    if (e.function)
        graph_.add(scopes_.function(), e.function);
    else
        end_builtin(e);
}

void CallBinder::end_builtin(CallExpr& e) {
    const Builtin& builtin = *e.builtin;
    if ((builtin.effects & kSetsLength) && e.args[0]->type.array_length > 0)
        if (const auto* array = as_if<VariableExpr>(e.args[0]))
            reporter_.report(Code::RSL_NOT_RESIZABLE, e.args[0]->span, array->name);
    bool names_channels = builtin.effects & (kReadsChannels | kWritesChannels);
    if (!names_channels) drop_unfit_pairs(ast_, reporter_, e.args, e.pairs, e.name);
    const auto* file = e.args.empty() ? nullptr : as_if<StringExpr>(e.args[0]);
    // A file that the shader will not be let to read.
    const AllowedPaths& files = builtin.effects & kNamesPoints ? options_.files : options_.pictures;
    if (file && (builtin.effects & kNamesFile) && !(builtin.effects & kNamesPoints))
        ast_.pictures.push_back(file->value);
    if (file && (builtin.effects & kNamesFile) && files.find(file->value).outside)
        reporter_.report(Code::RSL_FILE_OUTSIDE, file->span, file->value);
    if (!builtin.lower && options_.require_implemented)
        reporter_.report(Code::RSL_NOT_SUPPORTED, e.span, fmt::format("'{}'", e.name));
}

// ---- calls that fit no form ---------------------------------------------------------------------

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

void CallBinder::report_no_form(CallExpr& e, std::span<Function* const> functions,
                                const std::string& arguments) {
    Finding& finding = reporter_.report(Code::RSL_NO_OVERLOAD, e.span, e.name, arguments);
    std::vector<std::string> forms;
    for (const Function* f : functions) forms.push_back(form_text(*f));
    if (forms.empty())
        for (const Overload& o : find_builtin(e.name))
            forms.push_back(form_text(e.name, o.signature));
    for (size_t i = 0; i < std::min(forms.size(), kMostForms); ++i)
        finding.help += (i ? ", " : "forms: ") + forms[i];
    if (forms.size() > kMostForms) finding.help += ", ...";
}

}  // namespace kinora::rsl
