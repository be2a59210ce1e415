// runtime/programs/shade/info.cpp: what a shader takes, reads and writes.
#include <fmt/format.h>

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

void print_text(const rsl::Shader& shader, const ShadeSource& source) {
    std::printf("%s \"%s\"\n", rsl::shader_kind_name(shader.kind), shader.name.c_str());
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        std::printf("    %s %s %.*s = %s\n", detail_of(parameter).c_str(),
                    rsl::type_name(parameter.type).c_str(), int(parameter.name.size()),
                    parameter.name.data(), default_of(parameter).c_str());
    std::printf("    reads%s\n    writes%s\n", joined(shader.globals_read).c_str(),
                joined(shader.globals_written).c_str());
    for (const ShadeParam& param : source.params) {
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
