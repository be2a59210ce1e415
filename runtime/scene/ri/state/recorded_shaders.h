// runtime/scene/ri/state/recorded_shaders.h: which surfaces and displacements are bound among calls
// that are kept.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

class RecordedShaders {
  public:
    // A call that is kept.
    void follow(const Call& call);
    // Names of shaders, of Request::Surface or Displacement, that a primitive has which comes now.
    // Nothing: those that were bound before.
    const std::optional<std::vector<std::string>>& names(Request request) const;

  private:
    struct Names {
        std::optional<std::vector<std::string>> surfaces, displacements;
    };
    std::vector<Names> blocks_ = std::vector<Names>(1);
};

}  // namespace kinora::ri
