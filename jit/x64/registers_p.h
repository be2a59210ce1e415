// jit/x64/registers_p.h: what registers hold while code runs, and the kernel's globals.
//
//   rbx KernelArgs   r12 in[]   r14 frame block   rbp byte offset of the lane group in a column
//   r13 globals of the kernel in scratch   r15 this function's frame in scratch
//   rax rcx rdx rsi rdi scratch   r8 r9 loop counters (if no calls)
//   r10 r11 columns and uniforms of the record read last
//   the last two vector registers, k0 and k7: scratch within one IR instruction
#pragma once

#include <asmjit/x86.h>

#include <cstdint>

namespace kinora::jit::x64 {

namespace x86 = asmjit::x86;
using Id = x86::Inst::Id;
using asmjit::InstId;
using asmjit::Label;
using asmjit::Operand;

// The kernel's globals, at the start of scratch (r13).
inline constexpr int kValidBits = 0;     // uint32: lanes of this group that hold points
inline constexpr int kValidVector = 32;  // AVX2: the same as a vector mask
inline constexpr int kServiceCall = 64;  // a ServiceCall
inline constexpr int kFrameRows = 128;   // AVX2: frame slots in use, broadcast

}  // namespace kinora::jit::x64
