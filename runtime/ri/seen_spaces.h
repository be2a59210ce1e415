// runtime/ri/seen_spaces.h: the coordinate systems of calls that are written and not rendered.
#pragma once

#include "runtime/base/diagnostic.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/state/interpreter.h"

namespace kinora::ri {

// Follows transformations, cameras and the blocks around them. What archives of other files would
// change is not known. Findings are whoever's reads the file that is written.
class SeenSpaces {
  public:
    SeenSpaces();
    void see(const Call& call);
    bool transform_points(std::string_view from, std::string_view to, std::span<float> points);

  private:
    Diagnostics unheard_;
    Interpreter state_;
};

}  // namespace kinora::ri
