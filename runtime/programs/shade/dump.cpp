// runtime/programs/shade/dump.cpp: what each stage of the compiler makes of a source.
#include <algorithm>
#include <cstdio>
#include <string_view>

#include "runtime/kinora/disassembly/disassembly.h"
#include "runtime/programs/common/exit_codes.h"
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

using Dumps = std::vector<std::pair<std::string, std::string>>;  // a stage and its text

bool is_of(const std::string& name, const std::string& stage) {
    return name == stage || (stage == "asm" && name.starts_with("asm"));
}

// Puts listings of machine code where they are wanted; the interpreter's is its IR. False, with a
// message, where there can be none.
bool list_machine_code(const jit::KernelPair& pair, const std::vector<std::string>& wanted,
                       const SourceFiles& files, Dumps& dumps) {
    for (auto& [name, text] : dumps) {
        const auto& kernel = name == "asm:frame" ? pair.frame : pair.point;
        const bool has_code = name.starts_with("asm") && !kernel->machine_code.empty();
        const std::string& stage = name;
        if (!has_code || std::none_of(wanted.begin(), wanted.end(),
                                      [&](const std::string& w) { return is_of(stage, w); }))
            continue;
        std::string error;
        text = disassembly(*kernel, files, error);
        if (error.empty()) continue;
        std::fprintf(stderr, "kinora-shade: %s\n", error.c_str());
        return false;
    }
    return true;
}

// IR and machine code: `wanted` is "asm", "ir" (as lowered) or "ir:PASS".
int dump_code(const ShadeOptions& options, const std::vector<std::string>& wanted) {
    ShadeSource source;
    Patch patch(1, 1, false);
    ShadeStack stack;
    if (std::optional<int> code = open_stack(options, source, patch, stack)) return *code;
    Dumps dumps;
    ShadeKernel code;
    bool compiled = code.compile(stack, options.target, source.diagnostics, &dumps);
    source.print_findings(options);
    if (!compiled) return kExitShader;
    if (!list_machine_code(code.pair(), wanted, source.diagnostics.files, dumps))
        return kExitMissingAsset;
    for (const std::string& stage : wanted) {
        bool any = false;
        for (const auto& [name, text] : dumps)
            if (is_of(name, stage)) {
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
