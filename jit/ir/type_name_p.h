// jit/ir/type_name_p.h: what the text of IR calls types.
#pragma once

#include "jit/ir/ir.h"

namespace kinora::jit {

inline const char* type_name(Type type) {
    constexpr const char* kNames[] = {"none", "f", "i", "m"};
    return kNames[static_cast<int>(type)];
}

}  // namespace kinora::jit
