// runtime/programs/shade/manual.cpp: the manual of the built-in functions and the shader
// globals, from their rows.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "rsl/builtins/table.h"
#include "rsl/model/globals.h"
#include "runtime/base/diagnostic.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/kinora_shade.h"

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
constexpr EffectRow kKinds[] = {
    {rsl::kSurface, "surface"}, {rsl::kDisplacement, "displacement"},
    {rsl::kLight, "light"},     {rsl::kVolume, "volume"},
    {rsl::kImager, "imager"},   {rsl::kTransformation, "transformation"},
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

// Forms that differ only in one type are one line: T abs(T), and what T may be.
struct Form {
    std::string text;  // with T for the type of the result
    std::vector<std::string> types;
    std::string plain;
};

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

std::vector<Form> forms(const rsl::Builtin& row) {
    std::vector<Form> result;
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
                                  [&](const Form& form) { return form.text == text; });
        if (known == result.end())
            result.push_back({text, {type}, plain});
        else
            known->types.push_back(type);
    }
    return result;
}

std::string kinds_of(uint32_t mask) {
    std::string text;
    for (const EffectRow& kind : kKinds)
        if (mask & kind.flag) text += fmt::format(" {}", kind.text);
    return text.empty() ? " nobody" : text;
}

void print_row(const rsl::Builtin& row) {
    for (const Form& form : forms(row)) {
        if (form.types.size() == 1)
            std::printf("%s\n", form.plain.c_str());
        else
            std::printf("%s, T: %s\n", form.text.c_str(),
                        fmt::format("{}", fmt::join(form.types, " ")).c_str());
    }
    std::printf("    %s\n", row.doc);
    for (const EffectRow& effect : kEffects)
        if (row.effects & effect.flag) std::printf("    It %s.\n", effect.text);
    if (row.legal != rsl::kAnyShader)
        std::printf("    Only in%s shaders.\n", kinds_of(row.legal).c_str());
    if (row.tolerance_ulp > 0)
        std::printf("    Precise mathematics is within %d ULP.\n", row.tolerance_ulp);
    if (!row.lower) std::printf("    Known, but not supported yet.\n");
}

void print_global(const rsl::GlobalInfo& global, bool whole) {
    if (!whole) {
        std::printf("%-18s %s\n", std::string(global.name).c_str(),
                    std::string(global.doc).c_str());
        return;
    }
    std::printf("%s\n    %s\n    read by%s, written by%s\n",
                fmt::format("{} {}", rsl::type_name(global.type), global.name).c_str(),
                std::string(global.doc).c_str(), kinds_of(global.readers).c_str(),
                kinds_of(global.writers).c_str());
}

}  // namespace

int shade_manual(const ShadeOptions& options) {
    bool found = false;
    for (std::span<const rsl::Builtin> group : rsl::builtin_groups())
        for (const rsl::Builtin& row : group) {
            if (options.source.empty())
                std::printf("%-18s %s%s\n", row.name, row.doc,
                            row.lower ? "" : " (not supported yet)");
            else if (options.source == row.name)
                print_row(row);
            found |= options.source.empty() || options.source == row.name;
        }
    for (const rsl::GlobalInfo& global : rsl::globals()) {
        if (!options.source.empty() && options.source != global.name) continue;
        print_global(global, !options.source.empty());
        found = true;
    }
    if (found) return kExitOk;
    std::vector<std::string_view> names;
    for (const auto& name : rsl::builtin_names()) names.push_back(name);
    for (const rsl::GlobalInfo& global : rsl::globals()) names.push_back(global.name);
    std::string_view near = nearest_name(options.source, names);
    std::fprintf(stderr, "kinora-shade: no built-in function or global '%s'%s\n",
                 options.source.c_str(),
                 near.empty() ? "; kinora-shade manual lists all"
                              : fmt::format("; did you mean '{}'?", near).c_str());
    return kExitUsage;
}

}  // namespace kinora
