// jit/debug/code_tools.h: generated code as other tools see it. All are off unless the environment
// says otherwise, and cost nothing then:
//   KINORA_PERF=1          each kernel is a line of /tmp/perf-PID.map, which `perf report` reads
//   KINORA_JITDUMP=FOLDER  kernels with their code and shader lines in FOLDER/jit-PID.dump, for
//                          `perf record -k 1`, then `perf inject --jit`
//   KINORA_GDB=1           each kernel is an object file in memory, registered with GDB's JIT
//                          interface: breakpoints and backtraces name kernels and shader lines
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "jit/ir/kernel.h"
#include "runtime/base/diagnostic.h"

namespace kinora::jit {

// Shows a finished kernel to the tools that are on. `files` gives lines their positions in the
// text; without it kernels have names only. The interpreter's kernels have no code and are passed
// over.
void show_code(Kernel& kernel, const SourceFiles* files);

// "kinora_plastic_avx512": how a kernel is named there.
std::string code_symbol(const Kernel& kernel);

// Where its machine code lies.
inline uint64_t address_of(const Kernel& kernel) {
    return reinterpret_cast<uintptr_t>(kernel.machine_code.data());
}

// An ELF object for the running instruction set: one function symbol over the kernel's code where
// it lies, and its lines as DWARF. What show_code registers.
std::vector<std::byte> debug_object(const Kernel& kernel, const SourceFiles* files);

}  // namespace kinora::jit
