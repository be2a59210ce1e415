// runtime/programs/shade/disassembly.h: machine code of a kernel beside the shader's lines.
#pragma once

#include <string>

#include "jit/ir/kernel.h"
#include "runtime/base/diagnostic.h"

namespace kinora {

// One instruction a line, each run of code from one location in the source under its line:
//   ; plastic.sl:12: Ci = Cs * diffuse(Nf);
//     0040  vmulps zmm0, zmm1, zmm2
// Empty for the interpreter, which has no code, and where Capstone cannot be loaded: `error` then
// says why.
std::string disassembly(const jit::Kernel& kernel, const SourceFiles& files, std::string& error);

}  // namespace kinora
