// jit/a64/asmjit_p.h: AsmJit's AArch64 half; Debian's package lacks the header that gathers it.
#pragma once

#include <asmjit/core.h>
// One order only: the scope headers open and close AsmJit's compiler settings.
#include <asmjit/asmjit-scope-begin.h>
//
#include <asmjit/arm/a64assembler.h>
#include <asmjit/arm/a64emitter.h>
#include <asmjit/arm/a64globals.h>
#include <asmjit/arm/a64operand.h>
//
#include <asmjit/asmjit-scope-end.h>
