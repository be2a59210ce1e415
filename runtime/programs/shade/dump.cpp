// runtime/programs/shade/dump.cpp: what each stage of the compiler makes of a source.
#include <cstdio>
#include <string_view>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/disassembly.h"
#include "runtime/programs/shade/kernel.h"

namespace kinora {

namespace {

struct FrontStage {
    std::string_view name;
    std::string (*text)(const ShadeOptions&, ShadeSource&);
};

std::string tokens(const ShadeOptions& o, ShadeSource& source) {
    return rsl::print_tokens(rsl::preprocess(source.view(), o.compile, source.diagnostics),
                             source.diagnostics.files);
}
std::string ast(const ShadeOptions& o, ShadeSource& source) {
    auto tree = rsl::parse(source.view(), o.compile, source.diagnostics);
    return tree ? rsl::print_ast(*tree) : "";
}
std::string types(const ShadeOptions& o, ShadeSource& source) {
    auto shaders = rsl::compile(source.view(), o.compile, source.diagnostics);
    return shaders.empty() ? "" : rsl::print_types(*shaders.front()->ast);
}
constexpr FrontStage kFrontStages[] = {{"tokens", tokens}, {"ast", ast}, {"types", types}};

constexpr const char* kStageHelp =
    "kinora-shade: no stage '%s'; stages are tokens, ast, types, ir, ir:PASS and asm";

// IR and machine code: `wanted` is "asm", "ir" (as lowered) or "ir:PASS".
int dump_code(const ShadeOptions& options, const std::vector<std::string>& wanted) {
    ShadeSource source;
    Patch patch(1, 1, false);
    ShadeStack stack;
    if (std::optional<int> code = open_stack(options, source, patch, stack)) return *code;
    std::vector<std::pair<std::string, std::string>> dumps;
    ShadeKernel code;
    bool compiled = code.compile(stack, options.target, source.diagnostics, &dumps);
    source.print_findings(options);
    if (!compiled) return kExitShader;
    for (auto& [name, text] : dumps) {  // the interpreter's listing is its IR
        const auto& kernel = name == "asm:frame" ? code.pair().frame : code.pair().point;
        if (name.starts_with("asm") && !kernel->machine_code.empty())
            text = disassembly(*kernel, source.diagnostics.files);
    }
    for (const std::string& stage : wanted) {
        bool any = false;
        for (const auto& [name, text] : dumps)
            if (name == stage || (stage == "asm" && name.starts_with("asm"))) {
                std::printf("; stage %s\n%s\n", name.c_str(), text.c_str());
                any = true;
            }
        if (any) continue;
        std::fprintf(stderr, kStageHelp, stage.c_str());
        std::fprintf(stderr, "; passes here:");
        for (const auto& dump : dumps) std::fprintf(stderr, " %s", dump.first.c_str());
        std::fputc('\n', stderr);
        return kExitUsage;
    }
    return kExitOk;
}

}  // namespace

int shade_dump(const ShadeOptions& options) {
    std::vector<std::string> stages = options.stages;
    if (stages.empty()) stages = {"ir"};
    std::vector<std::string> code_stages;
    for (const std::string& stage : stages) {
        bool front = false;
        for (const FrontStage& row : kFrontStages) {
            if (row.name != stage) continue;
            front = true;
            ShadeSource source;
            if (int code = read_shade_source(options, source)) return code;
            std::string text = row.text(options, source);
            source.print_findings(options);
            std::fputs(text.c_str(), stdout);
            if (source.failed(options)) return kExitShader;
        }
        if (front) continue;
        if (stage != "asm" && stage != "ir" && !stage.starts_with("ir:")) {
            std::fprintf(stderr, kStageHelp, stage.c_str());
            std::fputc('\n', stderr);
            return kExitUsage;
        }
        code_stages.push_back(stage);
    }
    return code_stages.empty() ? kExitOk : dump_code(options, code_stages);
}

}  // namespace kinora
