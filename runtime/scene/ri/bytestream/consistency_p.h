// runtime/scene/ri/bytestream/consistency_p.h: lengths of arrays that C functions are not told.
#pragma once

#include <span>
#include <string>

#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

// Why arrays are too short for what other arguments say; "": they are not.
std::string contradiction(Request request, std::span<const Values> arguments);

}  // namespace kinora::ri
