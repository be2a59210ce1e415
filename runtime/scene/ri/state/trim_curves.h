// runtime/scene/ri/state/trim_curves.h: RiTrimCurve to polylines.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/description/curved_surface.h"
#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

// Each curve is a rational B-spline u/w, v/w (3.2, section 5.4.3); loops close head to tail. Where
// the numbers contradict each other there is no loop, and `why` says how.
std::vector<TrimLoop> trim_loops(const Call& call, std::string& why);

}  // namespace kinora::ri
