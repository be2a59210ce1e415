// jit/targets.cpp: the targets this build knows, one row each, fastest first.
#include "jit/target.h"

#include "jit/a64/a64.h"
#include "jit/interp/interp.h"
#if defined(__x86_64__)
#include "jit/x64/x64.h"
#endif
#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

bool always() {
    return true;
}

constexpr Target kTargets[] = {
#if defined(__x86_64__)
    {"avx512", 16, avx512_supported, emit_avx512, check_avx512},
    {"avx2", 8, avx2_supported, emit_avx2, check_avx2},
#endif
    {"neon", 4, neon_supported, emit_neon, check_neon},
    {"interp", kMaxLanes, always, emit_interp, nullptr},
};

}  // namespace

std::span<const Target> targets() {
    return kTargets;
}

const Target* find_target(std::string_view name) {
    for (const Target& target : kTargets)
        if (target.name == name) return &target;
    return nullptr;
}

const Target& best_target() {
    for (const Target& target : kTargets)
        if (target.supported()) return target;
    check_failed(__FILE__, __LINE__, "no target is supported");
}

}  // namespace kinora::jit
