// jit/ir/planted_fault.h: faults of code generation for tests of the tests (planted_faults.def).
#pragma once

#include <cstdint>

namespace kinora::jit {

enum class PlantedFault : uint8_t {
    None,
#define FAULT(name, where, meaning) name,
#include "jit/ir/planted_faults.def"
#undef FAULT
    Count
};

#ifdef KINORA_PLANTED_FAULTS
// Only the fault tests' own build of these files has them (tests/jit/CMakeLists.txt). Set by one
// thread while no other compiles. Asked when code is made, never by code that runs.
inline PlantedFault planted_fault = PlantedFault::None;
inline bool planted(PlantedFault fault) {
    return planted_fault == fault;
}
#else
constexpr bool planted(PlantedFault) {
    return false;
}
#endif

}  // namespace kinora::jit
