// rsl/check/unknown_names.cpp: what an unknown name may mean.
#include "rsl/check/unknown_names.h"

#include "rsl/builtins/table.h"
#include "rsl/text/did_you_mean.h"
#include "rsl/text/standard_headers.h"

namespace kinora::rsl {

void UnknownNames::begin_shader() {
    variables_.clear();
    functions_.clear();
}

namespace {

// Names of other languages and what RSL has instead.
constexpr struct {
    std::string_view name;
    const char* help;
} kVariableHints[] = {
    {"true", "write '1'"},    {"TRUE", "write '1'"},          {"false", "write '0'"},
    {"FALSE", "write '0'"},   {"M_PI", "write 'PI'"},         {"pi", "write 'PI'"},
    {"NULL", "write '\"\"'"}, {"Nn", "write 'normalize(N)'"}, {"V", "write '-normalize(I)'"},
};

}  // namespace

void UnknownNames::variable(const VariableExpr& e) {
    if (recovery_.hides(e.name, e.span.token) || !variables_.insert(e.name).second) return;
    Finding& finding = reporter_.report(Code::RSL_UNKNOWN_VARIABLE, e.span, e.name);
    for (const auto& row : kVariableHints)
        if (row.name == e.name) finding.help = row.help;
    if (!finding.help.empty()) return;
    if (!scopes_.find_functions(e.name).empty() || !find_builtin(e.name).empty()) {
        finding.help = fmt::format("it is a function, which is called as '{}(...)'", e.name);
        return;
    }
    std::vector<std::string_view> names = scopes_.variable_names();
    names.insert(names.end(), {"return", "break", "continue"});  // alone in a statement
    finding.help = meant_help(e.name, names);
    if (did_you_mean(e.name, names) == "return") misspelt_returns_.insert(scopes_.function());
}

namespace {

// What other languages call it, and what RSL has instead.
struct FunctionHint {
    std::string_view name;
    const char* help;
};
constexpr FunctionHint kFunctionHints[] = {
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

void UnknownNames::function(const CallExpr& e) {
    if (recovery_.hides(e.name, e.span.token) || !functions_.insert(e.name).second) return;
    std::string_view origin = foreign_builtin(e.name);
    if (origin == "RSL 2.0") {
        reporter_.report(Code::RSL_2, e.span, fmt::format("'{}()'", e.name));
        reporter_.stop();
        return;
    }
    if (!origin.empty()) {
        reporter_.report(Code::RSL_FOREIGN_FUNCTION, e.span, e.name, origin);
        return;
    }
    Finding& finding = reporter_.report(Code::RSL_UNKNOWN_FUNCTION, e.span, e.name);
    for (const FunctionHint& row : kFunctionHints)
        if (row.name == e.name) finding.help = row.help;
    for (const ShaderDefinition* shader : ast_.shaders) {
        if (shader->name != e.name) continue;
        finding.help = fmt::format("'{}' is a {} shader; only functions can be called", e.name,
                                   shader_kind_name(shader->kind));
        finding.notes.push_back({shader->span.where, "defined here"});
    }
    if (const Symbol* symbol = scopes_.find_variable(e.name); symbol && finding.help.empty())
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
    for (std::string_view name : scopes_.function_names()) names.push_back(name);
    for (int k = 0; k < int(BaseType::Void); ++k) names.push_back(type_name(BaseType(k)));
    finding.help = meant_help(e.name, names);
}

}  // namespace kinora::rsl
