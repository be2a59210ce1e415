// runtime/base/kernel_table.h: tables of kernels of one source, compiled for each instruction set
// and chosen at run time.
//
// Headers of kernels include this, and so do files compiled for one instruction set: it must hold
// no inline function, since the linker could keep the wrong copy of it.
//
// NAME.h declares a table's type and KINORA_KERNEL_TABLES(type, NAME). NAME_p.h holds the kernels
// and ends with
//
//     extern const Type KINORA_KERNEL_TABLE(NAME);
//     const Type KINORA_KERNEL_TABLE(NAME) = {KINORA_INSTRUCTION_SET, first, second};
//
// both macros coming from kinora_kernels() of scripts/compile.cmake. NAME.cpp chooses
// (runtime/base/choose_kernels.h).
#pragma once

#include <cstddef>

namespace kinora {

// Those this CPU can run, the widest first; all give the same bits.
template <class Kernels>
struct UsableKernels {
    const Kernels* kernels[3];
    size_t count;
};

}  // namespace kinora

#if defined(__x86_64__)
#define KINORA_KERNEL_TABLES(type, name) \
    extern const type kPortable##name, kAvx2##name, kAvx512##name
#else
#define KINORA_KERNEL_TABLES(type, name) extern const type kPortable##name
#endif
