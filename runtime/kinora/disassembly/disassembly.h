// runtime/kinora/disassembly/disassembly.h: machine code of a kernel beside the shader's lines.
#pragma once

#include <string>
#include <vector>

#include "jit/ir/kernel.h"
#include "runtime/base/diagnostic.h"

namespace kinora {

// Code that comes from one line of the source, as it lies in memory: a line may have several runs.
struct MachineRun {
    std::string file;  // "" of no line
    int line = 0;
    std::string source;                     // the line, without its margin
    std::vector<std::string> instructions;  // "0040  vmulps zmm0, zmm1, zmm2"
};

// Empty for the interpreter, which has no code, and where Capstone cannot be loaded: `error` then
// says why.
std::vector<MachineRun> machine_runs(const jit::Kernel& kernel, const SourceFiles& files,
                                     std::string& error);

// The same as text, each run under its line:
//   ; plastic.sl:12: Ci = Cs * diffuse(Nf);
//     0040  vmulps zmm0, zmm1, zmm2
std::string disassembly(const jit::Kernel& kernel, const SourceFiles& files, std::string& error);

}  // namespace kinora
