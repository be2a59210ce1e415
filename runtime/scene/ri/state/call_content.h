// runtime/scene/ri/state/call_content.h: what a primitive is, whatever it is called with again.
#pragma once

#include <cstdint>

#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/state/graphics_state.h"

namespace kinora::ri {

// 64 bits for the call's arguments and parameters, and for the attributes that decide its mesh.
uint64_t content_of(const Call& call, const Attributes& attributes);

}  // namespace kinora::ri
