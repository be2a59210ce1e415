// jit/x64/x64.h: the targets "avx2" (8 lanes) and "avx512" (16 lanes).
#pragma once

#include <memory>
#include <string>

#include "jit/ir/ir.h"
#include "jit/ir/kernel.h"

namespace kinora::jit {

// Does the running CPU (and system) have AVX2, FMA and BMI2; and AVX-512 F, DQ, VL and BW; and may
// code be made here (may_execute).
bool avx2_supported();
bool avx512_supported();

// Machine code for a verified module; null if executable memory cannot be had. `assembly`, if
// given, receives a listing with the IR beside it. "avx2" runs 8 points at a time: a grid of 1..8
// points modulo 16 leaves the last 8 points of the padding of `out` as they are.
std::shared_ptr<Kernel> emit_avx2(const Module& module, std::string* assembly);
std::shared_ptr<Kernel> emit_avx512(const Module& module, std::string* assembly);

// Target::check: runs check_allocation over the functions of a verified module.
std::string check_avx2(const Module& module);
std::string check_avx512(const Module& module);

}  // namespace kinora::jit
