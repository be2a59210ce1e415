// runtime/programs/shade/check.cpp: all findings of sources and a summary of each.
#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "rsl/lint/lint.h"
#include "rsl/lower/lower.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/source.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;

std::string counted(size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

Json json_of(const Finding& finding, const SourceFiles& files) {
    Json row{{"code", finding.info->code},
             {"severity", severity_name(finding.severity)},
             {"message", finding.message}};
    if (finding.where.file != kNoFile) {
        LineColumn begin = files.line_column(finding.where.file, finding.where.begin);
        LineColumn end = files.line_column(finding.where.file, finding.where.end);
        row["file"] = files.name(finding.where.file);
        row["line"] = begin.line;
        row["column"] = begin.column;
        row["end_line"] = end.line;
        row["end_column"] = end.column;
    }
    if (!finding.help.empty()) row["help"] = finding.help;
    return row;
}

std::string_view kind_of(const rsl::Shader& shader) {
    return shader.definition->co_shader ? "co-shader" : rsl::shader_kind_name(shader.kind);
}

Json json_of(const ShadeSource& source, const ShadeOptions& options) {
    Json shaders = Json::array(), findings = Json::array();
    for (const auto& shader : source.shaders)
        shaders.push_back({{"name", shader->name}, {"kind", kind_of(*shader)}});
    for (const Finding& finding : source.diagnostics.findings())
        if (finding.severity != Severity::Off)
            findings.push_back(json_of(finding, source.diagnostics.files));
    return {{"source", options.source},
            {"ok", !source.failed(options)},
            {"errors", source.diagnostics.count(Severity::Error)},
            {"warnings", source.diagnostics.count(Severity::Warning)},
            {"shaders", std::move(shaders)},
            {"findings", std::move(findings)}};
}

void print_summary(const ShadeSource& source, const ShadeOptions& options) {
    std::string names;
    for (const auto& shader : source.shaders)
        names += fmt::format("{}{} {}", names.empty() ? "" : ", ", kind_of(*shader), shader->name);
    std::printf("%s: %s, %s%s%s\n", options.source.c_str(),
                counted(size_t(source.diagnostics.count(Severity::Error)), "error").c_str(),
                counted(size_t(source.diagnostics.count(Severity::Warning)), "warning").c_str(),
                names.empty() ? "" : ": ", names.c_str());
}

// Textures are sought beside the source, where it is checked, and where headers are.
rsl::LintOptions lint_options(const ShadeOptions& options, const ShadeSource& source) {
    rsl::LintOptions lint;
    lint.file = source.map.file;
    lint.folders = {options.source.substr(0, options.source.rfind('/') + 1), ""};
    for (const auto* more : {&options.compile.include_directories, &options.allow_external})
        lint.folders.insert(lint.folders.end(), more->begin(), more->end());
    return lint;
}

// One of the sources; with --json a row of `list`.
int check_source(const ShadeOptions& options, Json& list) {
    ShadeSource source;
    ShadeOptions silent = options;  // JSON holds the findings
    silent.silent = options.json;
    std::optional<int> code = compile_shade_source(silent, source);
    if (code && (options.preprocess_only || *code != kExitShader)) return *code;
    for (const auto& shader : source.shaders) {
        rsl::Layer layer{shader.get(), {}};
        // Lowering finds what only it knows: unknown spaces, arrays too large.
        rsl::lower({&layer, 1}, {}, source.diagnostics);
    }
    rsl::lint(source.shaders, lint_options(options, source), source.diagnostics);
    source.print_findings(silent);
    if (options.json)
        list.push_back(json_of(source, options));
    else if (!options.quiet)
        print_summary(source, options);
    return source.failed(options) ? kExitShader : kExitOk;
}

}  // namespace

// What cannot be read outweighs what is wrong.
int shade_check(const ShadeOptions& options) {
    Json list = Json::array();
    int worst = kExitOk;
    for (const std::string& word : options.sources)
        for (const std::string& name : shade_sources(word)) {
            ShadeOptions one = options;
            one.source = name;
            hold_to_scene(one);
            int code = check_source(one, list);
            bool unread = worst == kExitUnreadable || code == kExitUnreadable;
            worst = unread ? int(kExitUnreadable) : std::max(worst, code);
        }
    if (options.json)  // names may hold bytes that are no UTF-8
        std::printf("%s\n", list.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return worst;
}

}  // namespace kinora
