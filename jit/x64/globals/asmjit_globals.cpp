// jit/x64/globals/asmjit_globals.cpp: AsmJit's functions that print. Its static library has them
// compiled for programs alone; linked before it, these make it fit for shared libraries.
#include <asmjit/core.h>

#include "runtime/base/check.h"

ASMJIT_BEGIN_SUB_NAMESPACE(DebugUtils)

const char* errorAsString(Error) noexcept {
    return "an error of AsmJit";
}

void debugOutput(const char*) noexcept {}

void assertionFailed(const char* file, int line, const char* message) noexcept {
    kinora::check_failed(file, line, message);
}

ASMJIT_END_SUB_NAMESPACE
