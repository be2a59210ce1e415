// jit/a64/registers_p.h: what registers hold while code runs (AAPCS64), and the kernel's globals.
//
//   x19 KernelArgs   x20 in[]   x21 frame block   x24 byte offset of the lane group in a column
//   x22 globals of the kernel in scratch   x23 this function's frame in scratch   x25 the pool
//   x15 the record read last   x14 "any lane" of the condition in work   w10..w13 loop counters (if
//   no calls)   x16 scratch   x17 scratch of addresses   x0..x3 scratch
//   v29..v31 scratch within one IR instruction; masks are lanes of all ones or zero
#pragma once

#include <cstdint>

#include "jit/a64/asmjit_p.h"

namespace kinora::jit::a64 {

namespace arm = asmjit::a64;
using asmjit::Label;
using Gp = arm::Gp;
using Vec = arm::Vec;

inline constexpr int kLanes = 4;
inline constexpr int kVector = 4 * kLanes;      // bytes of the lanes of a group
inline constexpr int kVectorRegisters = 29;     // three more are scratch
inline constexpr int kFirstSavedRegister = 21;  // of those: v8..v15 are given out last

inline constexpr Gp kArgs = arm::x19, kIn = arm::x20, kFrameBlock = arm::x21, kGlobals = arm::x22,
                    kStack = arm::x23, kGroup = arm::x24, kPool = arm::x25, kRecord = arm::x15,
                    kAny = arm::x14;

// The kernel's globals, at the start of scratch.
inline constexpr int kValidBits = 0;     // uint32: lanes of this group that hold points
inline constexpr int kValidVector = 16;  // the same as a vector mask
inline constexpr int kServiceCall = 64;  // a ServiceCall
inline constexpr int kGlobalsBytes = 128;

}  // namespace kinora::jit::a64
