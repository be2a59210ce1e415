// runtime/scene/load/weld.h: positions that are equal.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// The lowest index of the positions that are equal, for each.
std::vector<uint32_t> welded(const std::vector<dvec3>& positions);

}  // namespace kinora
