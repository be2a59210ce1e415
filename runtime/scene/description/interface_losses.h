// runtime/scene/description/interface_losses.h: what scenes of the RenderMan Interface have and
// neither COLLADA nor glTF can say.
#pragma once

#include <string_view>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

std::vector<std::string_view> interface_losses(const SceneDescription& description);

}  // namespace kinora
