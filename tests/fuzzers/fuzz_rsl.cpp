// tests/fuzzers/fuzz_rsl.cpp: any text as shader source: findings or a well-formed kernel.
#include "jit/compiler.h"
#include "jit/passes/passes.h"
#include "rsl/compile.h"
#include "rsl/lower/lower.h"
#include "tests/fuzzers/fuzzer.h"

using namespace kinora;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string text(fuzz::text_of(data, size));
    Diagnostics diag;
    rsl::ShaderSource source{text, {}};
    source.map.file = diag.files.add("fuzz.sl", text);
    source.map.segments = {{0, 0}};
    auto shaders = rsl::compile(source, {}, diag);
    if (shaders.empty() != diag.has_errors()) fuzz::expect("shaders or errors");
    for (const Finding& finding : diag.findings()) format_finding(finding, diag.files);
    for (const auto& shader : shaders) {
        int errors_before = diag.count(Severity::Error);
        rsl::Layer layer{shader.get(), {}};
        auto lowered = rsl::lower({&layer, 1}, {}, diag);
        if (lowered.has_value() != (diag.count(Severity::Error) == errors_before))
            fuzz::expect("a kernel or errors");
        if (!lowered) continue;
        fuzz::expect(jit::verify(lowered->module));
        jit::Module frame;
        jit::optimize(lowered->module, &frame);
        fuzz::expect(jit::verify(lowered->module) + jit::verify(frame));
    }
    return 0;
}
