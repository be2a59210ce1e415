// runtime/scene/vertices/weld.h: positions that are equal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// The lowest index of the entries at the same position, for each. -0 is 0.
std::vector<uint32_t> weld(std::span<const vec4> positions);

}  // namespace kinora
