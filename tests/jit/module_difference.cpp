// tests/jit/module_difference.cpp: agreement of interpreter, passes and targets on one module.
#include "tests/jit/module_difference.h"

#include <algorithm>
#include <cstring>

#include "jit/compiler.h"
#include "jit/interp/interp.h"
#include "jit/passes/passes.h"

namespace kinora::jit::test {

World world_of(uint64_t seed) {
    return World(seed * 7919 + 1, 1 + static_cast<int32_t>(seed % 37));
}

void forgive_loop_fault(RunResult& before, const RunResult& after) {
    if (before.fault[0] == 1 && after.fault[0] == 0) before.fault[0] = 0;
}

namespace {

bool same_code(const Kernel& a, const Kernel& b) {
    return std::equal(a.machine_code.begin(), a.machine_code.end(), b.machine_code.begin(),
                      b.machine_code.end());
}

}  // namespace

std::string target_difference(const Module& module, const Target& target, uint64_t seed) {
    auto kernel = target.emit(module, nullptr);
    if (kernel == nullptr) return "no executable memory";
    World world = world_of(seed);
    return difference(*kernel, world.run(*emit_interp(module, nullptr)), world.run(*kernel));
}

std::string optimized_difference(const Module& module, const Target& target, uint64_t seed) {
    Module point = module, frame;
    optimize(point, &frame);
    for (const Module* m : {&point, &frame})
        if (std::string error = verify(*m); !error.empty()) return "verify: " + error;
    auto kernel = target.emit(point, nullptr), frame_kernel = target.emit(frame, nullptr);
    if (kernel == nullptr || frame_kernel == nullptr) return "no executable memory";
    World world = world_of(seed);
    auto plain = emit_interp(module, nullptr);
    RunResult before = world.run(*plain);
    RunResult after = world.run_pair(frame_kernel.get(), *kernel);
    forgive_loop_fault(before, after);
    return difference(*plain, before, after);
}

std::string module_difference(const Module& module, uint64_t seed) {
    for (const Target& target : targets()) {
        if (!target.supported()) continue;
        auto named = [&](const std::string& what) { return target.name + (": " + what); };
        std::string proof = target.check != nullptr ? target.check(module) : "";
        if (!proof.empty()) return named("allocation: " + proof);
        if (std::string wrong = target_difference(module, target, seed); !wrong.empty())
            return named(wrong);
        if (std::string wrong = optimized_difference(module, target, seed); !wrong.empty())
            return named("optimized: " + wrong);
        auto first = target.emit(module, nullptr), second = target.emit(module, nullptr);
        if (first && second && !same_code(*first, *second)) return named("not the same bytes");
    }
    return "";
}

}  // namespace kinora::jit::test
