// jit/debug/jit_dump_p.h: kernels in the file that `perf inject --jit` reads.
#pragma once

#include <string>

#include "jit/ir/kernel.h"
#include "runtime/base/diagnostic.h"

namespace kinora::jit {

// Adds the kernel's code, name and lines to FOLDER/jit-PID.dump, which the first call begins. A
// file that cannot be written is left out in silence: it is no part of the work. Thread-safe.
void add_to_jit_dump(const std::string& folder, const Kernel& kernel, const SourceFiles* files);

}  // namespace kinora::jit
