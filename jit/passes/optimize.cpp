// jit/passes/optimize.cpp: the order of the passes.
#include "jit/ir/ieee_scope_p.h"
#include "jit/passes/passes.h"

namespace kinora::jit {

namespace {

using Dumps = std::vector<std::pair<std::string, std::string>>;

struct Pass {
    const char* name;
    void (*run)(Module&);
};

// Derivatives first, while transcendental functions still have names; then what is called becomes
// plain code, and equal parts of it are found.
constexpr Pass kBeforeHoist[] = {
    {"derivatives", differentiate},
    {"inline", inline_calls},
    {"dce", dce},
    {"fold", fold},
    {"unmask", unmask_uniform_loops},
    {"cse", cse},
};
constexpr Pass kAfterHoist[] = {{"dce", dce}, {"schedule", schedule}};

// Fused loops show that Ifs in them have one mask, fused Ifs that they compute the same.
constexpr int kFuseRounds = 2;

void dump(Dumps* dumps, const std::string& stage, const Module& module) {
    if (dumps != nullptr) dumps->push_back({stage, print(module)});
}

template <size_t N>
void run_passes(Module& module, const Pass (&passes)[N], const char* prefix, Dumps* dumps) {
    for (const Pass& pass : passes) {
        pass.run(module);
        dump(dumps, std::string(prefix) + pass.name, module);
    }
}

}  // namespace

void optimize(Module& module, Module* frame, Dumps* dumps) {
    IeeeScope ieee;  // folding computes as precise kernels do
    dump(dumps, "ir", module);
    run_passes(module, kBeforeHoist, "ir:", dumps);
    for (int round = 0; round < kFuseRounds && fuse(module); ++round) cse(module);
    dump(dumps, "ir:fuse", module);
    if (frame != nullptr) {
        *frame = hoist(module);
        dump(dumps, "ir:hoist", module);
        run_passes(*frame, kAfterHoist, "ir:frame:", dumps);
    }
    run_passes(module, kAfterHoist, "ir:", dumps);
}

}  // namespace kinora::jit
