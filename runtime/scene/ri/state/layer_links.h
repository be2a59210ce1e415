// runtime/scene/ri/state/layer_links.h: parameters of layers that have what layers below leave.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/ri/state/graphics_state.h"

namespace kinora::ri {

// A parameter of a layer, by the names of both.
struct LayerVariable {
    std::string_view layer, name;
};

// Gives `to`, a parameter or Cs or Os, the value that `from` has when its layer is done. Returns
// why that cannot be; "": it is done.
std::string connect(std::vector<Binding>& layers, LayerVariable from, LayerVariable to);

}  // namespace kinora::ri
