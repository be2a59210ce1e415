// runtime/programs/manual/rows.cpp: prototypes, effects and shader kinds in words.
#include "runtime/programs/manual/rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "rsl/builtins/table.h"
#include "rsl/model/globals.h"

namespace kinora {

namespace {

struct EffectRow {
    uint32_t flag;
    const char* text;
};
constexpr EffectRow kEffects[] = {
    {rsl::kVaryingResult, "differs from point to point"},
    {rsl::kDerivative, "takes derivatives of its arguments"},
    {rsl::kLights, "reads the lights at P"},
    {rsl::kTraces, "traces rays"},
    {rsl::kPrints, "prints"},
    {rsl::kMessage, "reads another shader or the renderer's state"},
    {rsl::kShadows, "switches a light's automatic shadows off"},
    {rsl::kUniformOnly, "takes uniform values only"},
};
constexpr rsl::ShaderKind kKinds[] = {
    rsl::ShaderKind::Surface, rsl::ShaderKind::Displacement, rsl::ShaderKind::Light,
    rsl::ShaderKind::Volume,  rsl::ShaderKind::Imager,       rsl::ShaderKind::Transformation,
};

std::string argument_text(const rsl::Signature::Argument& argument) {
    std::string type =
        argument.type.base == rsl::BaseType::Invalid ? "any" : rsl::type_name(argument.type);
    return (argument.output ? "output " : "") + type;
}

std::string prototype(const rsl::Builtin& row, const rsl::Signature& signature) {
    std::string text = fmt::format("{} {}(", rsl::type_name(signature.result), row.name);
    std::string separator;
    auto add = [&](const std::string& item) {
        text += separator + item;
        separator = ", ";
    };
    for (const rsl::Signature::Argument& argument : signature.arguments)
        add(argument_text(argument));
    if (signature.repeats) add(argument_text(signature.repeated) + " ...");
    if (signature.pairs) add("\"name\", value ...");
    return text + ")";
}

std::string replaced(std::string text, const std::string& word, const std::string& by) {
    for (size_t at = 0; (at = text.find(word, at)) != std::string::npos;) {
        bool whole = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
        if (!whole) {
            at += word.size();
            continue;
        }
        text.replace(at, word.size(), by);
        at += by.size();
    }
    return text;
}

}  // namespace

std::string BuiltinForm::line() const {
    return types.size() == 1 ? plain : fmt::format("{}, T: {}", text, fmt::join(types, " "));
}

std::vector<BuiltinForm> builtin_forms(const rsl::Builtin& row) {
    std::vector<BuiltinForm> result;
    for (const rsl::Signature& signature : rsl::parse_signatures(row.signature)) {
        std::string type = rsl::type_name(signature.result.base);
        std::string plain = prototype(row, signature);
        // A query's result is always a float: its variable is what differs.
        bool open = !signature.arguments.empty() && signature.arguments.back().output &&
                    signature.arguments.back().type.base != rsl::BaseType::Invalid;
        if (open && signature.result.base == rsl::BaseType::Float)
            type = rsl::type_name(signature.arguments.back().type.base);
        std::string text = replaced(plain, open ? "output " + type : type, open ? "output T" : "T");
        auto known = std::find_if(result.begin(), result.end(),
                                  [&](const BuiltinForm& form) { return form.text == text; });
        if (known == result.end())
            result.push_back({text, {type}, plain});
        else
            known->types.push_back(type);
    }
    return result;
}

std::vector<std::string> effect_texts(const rsl::Builtin& row) {
    std::vector<std::string> texts;
    for (const EffectRow& effect : kEffects)
        if (row.effects & effect.flag) texts.push_back(effect.text);
    return texts;
}

std::vector<std::string> kind_names(uint32_t mask) {
    std::vector<std::string> names;
    for (rsl::ShaderKind kind : kKinds)
        if (mask & rsl::in_kind(kind)) names.push_back(rsl::shader_kind_name(kind));
    return names;
}

}  // namespace kinora
