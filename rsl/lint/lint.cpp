// rsl/lint/lint.cpp: the checks of a source, and the names that switch warnings off.
#include "rsl/lint/lint.h"

#include <algorithm>
#include <limits>

#include "rsl/lint/lint_p.h"
#include "rsl/model/builtin.h"
#include "rsl/text/findings.h"

namespace kinora::rsl {

namespace {

void lint_lights(LintSource& source) {
    for (const auto& shader : source.shaders) {
        const bool lights =
            std::any_of(shader->globals_written.begin(), shader->globals_written.end(),
                        [](const GlobalInfo* info) { return info->id == Global::Cl; }) ||
            std::any_of(shader->functions.begin(), shader->functions.end(),
                        [](const Function* f) { return is_sample_method(f->name); });
        if (shader->kind == ShaderKind::Light && !lights)
            source.reporter.report(Code::RSL_DARK_LIGHT, shader->definition->span, shader->name);
    }
}

}  // namespace

void lint(std::span<const std::unique_ptr<Shader>> shaders, const LintOptions& options,
          Diagnostics& diagnostics) {
    if (shaders.empty()) return;
    const Ast& ast = *shaders[0]->ast;
    Reporter reporter(diagnostics, ast.tokens, std::numeric_limits<int>::max());
    LintSource source{ast, shaders, options, {ast, reporter}};
    lint_names(source);
    lint_indices(source);
    lint_loops(source);
    lint_textures(source);
    lint_lights(source);
}

// ---- names of warnings --------------------------------------------------------------------------

std::string warning_name(const FindingInfo& info) {
    std::string name = info.code;
    if (name.starts_with("RSL_")) name.erase(0, 4);
    for (char& c : name) c = c == '_' ? '-' : char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return name;
}

const FindingInfo* find_warning(std::string_view name) {
    for (const FindingInfo* row : finding_rows())
        if (row->severity == Severity::Warning && (warning_name(*row) == name || row->code == name))
            return row;
    return nullptr;
}

std::vector<std::string> warning_names() {
    std::vector<std::string> names;
    for (const FindingInfo* row : finding_rows())
        if (row->severity == Severity::Warning) names.push_back(warning_name(*row));
    return names;
}

}  // namespace kinora::rsl
