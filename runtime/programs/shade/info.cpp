// runtime/programs/shade/info.cpp: what a shader takes, reads and writes.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "rsl/syntax/print.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/source.h"

namespace kinora {

namespace {

std::string detail_of(const rsl::ShaderParameter& parameter) {
    bool varying = parameter.detail == rsl::Detail::Varying;
    return std::string(parameter.output ? "output " : "") + (varying ? "varying" : "uniform");
}

std::string default_of(const rsl::ShaderParameter& parameter) {
    return parameter.default_value ? rsl::print_expr(*parameter.default_value) : "0";
}

std::string joined(const std::vector<const rsl::GlobalInfo*>& globals) {
    std::string text;
    for (const rsl::GlobalInfo* global : globals) text += fmt::format(" {}", global->name);
    return text.empty() ? " none" : text;
}

// Names of a class's methods, each once, in order; none of other shaders.
std::vector<std::string> methods_of(const rsl::Shader& shader) {
    std::vector<std::string> names;
    const rsl::ClassDefinition* c = shader.definition->shader_class;
    for (size_t k = 0; c && k < c->methods.size(); ++k) {
        std::string_view name = c->methods[k]->name;
        std::string written(name.substr(0, name.find(' ')));
        if (std::find(names.begin(), names.end(), written) == names.end())
            names.push_back(std::move(written));
    }
    return names;
}

std::vector<const rsl::Symbol*> members_of(const rsl::Shader& shader) {
    std::vector<const rsl::Symbol*> members;
    const rsl::ClassDefinition* c = shader.definition->shader_class;
    for (size_t k = 0; c && k < c->members.size(); ++k)
        if (auto* declared = rsl::as_if<rsl::DeclareStmt>(c->members[k]))
            for (const rsl::Symbol* symbol : declared->symbols)
                if (!symbol->handle) members.push_back(symbol);
    return members;
}

const char* rate_of(const rsl::Symbol& member) {
    return member.varying ? "varying" : "uniform";
}

// The rest of each "#pragma annotation" line.
std::vector<std::string> annotations_of(const rsl::Shader& shader) {
    constexpr std::string_view kWord = "annotation";
    std::vector<std::string> lines;
    for (const rsl::PragmaToken& pragma : shader.ast->tokens.pragmas) {
        std::string text(pragma.text);
        if (!text.starts_with(kWord)) continue;
        text.erase(0, std::min(text.find_first_not_of(" \t", kWord.size()), text.size()));
        lines.push_back(std::move(text));
    }
    return lines;
}

void print_class(const rsl::Shader& shader) {
    for (const rsl::Symbol* member : members_of(shader))
        std::printf("    member %s %s %.*s\n", rate_of(*member),
                    rsl::type_name(member->type).c_str(), int(member->name.size()),
                    member->name.data());
    std::string methods;
    for (const std::string& name : methods_of(shader)) methods += " " + name;
    if (!methods.empty()) std::printf("    methods%s\n", methods.c_str());
}

// A co-shader's values stand with the shader that calls it, as HANDLE.NAME.
bool takes(const rsl::Shader& shader, const ShadeParam& param) {
    const auto& handles = shader.definition->handles;
    return std::ranges::any_of(shader.parameters,
                               [&](const auto& p) { return p.name == param.name; }) ||
           std::ranges::any_of(handles, [&](const auto* h) { return h->name == param.name; });
}

void print_text(const rsl::Shader& shader, const ShadeSource& source) {
    const char* kind =
        shader.definition->co_shader ? "co-shader" : rsl::shader_kind_name(shader.kind);
    std::printf("%s%s \"%s\"\n", shader.definition->shader_class ? "class, as " : "", kind,
                shader.name.c_str());
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        std::printf("    %s %s %.*s = %s\n", detail_of(parameter).c_str(),
                    rsl::type_name(parameter.type).c_str(), int(parameter.name.size()),
                    parameter.name.data(), default_of(parameter).c_str());
    for (const rsl::Symbol* handle : shader.definition->handles)
        std::printf("    shader%s %.*s\n", handle->type.is_array() ? "[]" : "",
                    int(handle->name.size()), handle->name.data());
    print_class(shader);
    for (const std::string& line : annotations_of(shader))
        std::printf("    annotation %s\n", line.c_str());
    std::printf("    reads%s\n    writes%s\n", joined(shader.globals_read).c_str(),
                joined(shader.globals_written).c_str());
    for (const ShadeParam& param : source.params) {
        if (!takes(shader, param)) continue;
        std::string value;
        for (double number : param.numbers) value += fmt::format(" {:g}", number);
        for (const std::string& text : param.strings) value += " " + rsl::quoted(text);
        std::printf("    effect binds %s =%s\n", param.name.c_str(), value.c_str());
    }
}

nlohmann::ordered_json names_of(const std::vector<const rsl::GlobalInfo*>& globals) {
    auto names = nlohmann::ordered_json::array();
    for (const rsl::GlobalInfo* global : globals) names.push_back(std::string(global->name));
    return names;
}

nlohmann::ordered_json json_of(const rsl::Shader& shader) {
    nlohmann::ordered_json json{{"name", shader.name},
                                {"kind", rsl::shader_kind_name(shader.kind)}};
    json["parameters"] = nlohmann::ordered_json::array();
    for (const rsl::ShaderParameter& parameter : shader.parameters) {
        nlohmann::ordered_json row{
            {"name", std::string(parameter.name)},
            {"type", rsl::type_name(parameter.type.base)},
            {"array", parameter.type.array_length < 0 ? 0 : parameter.type.array_length},
            {"detail", parameter.detail == rsl::Detail::Varying ? "varying" : "uniform"},
            {"output", parameter.output},
            {"default", default_of(parameter)}};
        if (parameter.constant && !parameter.constant->strings.empty())
            row["value"] = parameter.constant->strings;
        else if (parameter.constant)
            row["value"] = parameter.constant->numbers;
        json["parameters"].push_back(std::move(row));
    }
    for (const rsl::Symbol* handle : shader.definition->handles)
        json["shaders"].push_back(
            {{"name", std::string(handle->name)}, {"array", handle->type.is_array()}});
    if (shader.definition->shader_class) {
        json["methods"] = methods_of(shader);
        json["members"] = nlohmann::ordered_json::array();
        for (const rsl::Symbol* member : members_of(shader))
            json["members"].push_back({{"name", std::string(member->name)},
                                       {"type", rsl::type_name(member->type)},
                                       {"detail", rate_of(*member)}});
    }
    if (auto lines = annotations_of(shader); !lines.empty()) json["annotations"] = lines;
    json["reads"] = names_of(shader.globals_read);
    json["writes"] = names_of(shader.globals_written);
    return json;
}

}  // namespace

int shade_info(const ShadeOptions& options) {
    ShadeSource source;
    if (std::optional<int> code = compile_shade_source(options, source)) return *code;
    if (!options.shader.empty() && !choose_shader(options, source)) return kExitUsage;
    auto all = nlohmann::ordered_json::array();
    for (const auto& shader : source.shaders) {
        if (!options.shader.empty() && shader->name != options.shader) continue;
        if (options.json)
            all.push_back(json_of(*shader));
        else
            print_text(*shader, source);
    }
    if (options.json) std::printf("%s\n", nlohmann::ordered_json{{"shaders", all}}.dump(2).c_str());
    return kExitOk;
}

}  // namespace kinora
