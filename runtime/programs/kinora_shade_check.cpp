// runtime/programs/kinora_shade_check.cpp: all findings of a source and a summary.
#include <fmt/format.h>

#include <cstdio>

#include "rsl/lower.h"
#include "runtime/programs/exit_codes.h"
#include "runtime/programs/kinora_shade_source.h"

namespace kinora {

namespace {

std::string counted(size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

int shade_check(const ShadeOptions& options) {
    ShadeSource source;
    std::optional<int> code = compile_shade_source(options, source);
    if (code && (options.preprocess_only || *code != kExitShader)) return *code;
    std::string names;
    for (const auto& shader : source.shaders) {
        names += fmt::format("{}{} {}", names.empty() ? "" : ", ",
                             rsl::shader_kind_name(shader->kind), shader->name);
        rsl::Layer layer{shader.get(), {}};
        // Lowering finds what only it knows: unknown spaces, arrays too large.
        if (has_code(*shader)) rsl::lower({&layer, 1}, {}, source.diagnostics);
    }
    source.print_findings(options);
    if (!options.quiet)
        std::printf("%s: %s, %s%s%s\n", options.source.c_str(),
                    counted(size_t(source.diagnostics.count(Severity::Error)), "error").c_str(),
                    counted(size_t(source.diagnostics.count(Severity::Warning)), "warning").c_str(),
                    names.empty() ? "" : ": ", names.c_str());
    return source.failed(options) ? kExitShader : kExitOk;
}

}  // namespace kinora
