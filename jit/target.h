// jit/target.h: the CPU families that modules are compiled for.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "jit/ir/kernel.h"

namespace kinora::jit {

// A CPU family at a feature level, or the interpreter: one row of the table in target.cpp.
struct Target {
    const char* name;  // "interp", "avx2", "avx512", "neon"
    int lanes;
    bool (*supported)();  // by the running CPU
    // A kernel of a verified, optimised module; null if executable memory cannot be had or a frame
    // takes over 1 GiB (callers fall back to the interpreter). `assembly`, if given: a listing.
    std::shared_ptr<Kernel> (*emit)(const Module& module, std::string* assembly);
    // For tests, on any CPU: encodes a verified module and proves its register allocations; "" or
    // the first fault. Null: there is nothing to prove.
    std::string (*check)(const Module& module);
};

std::span<const Target> targets();                 // fastest first, all that this build knows
const Target* find_target(std::string_view name);  // null if unknown
const Target& best_target();                       // the fastest the CPU supports

}  // namespace kinora::jit
