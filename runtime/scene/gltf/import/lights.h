// runtime/scene/gltf/import/lights.h: KHR_lights_punctual as lights in RSL.
#pragma once

#include "runtime/scene/gltf/import/rsl.h"
#include "runtime/scene/gltf/import/unique_ids.h"

namespace kinora {

void import_lights(const tinygltf::Model& model, double meter, RslExtras& rsl, UniqueIds& ids,
                   PointerSlots& pointers, GltfReport& report, SceneDescription& out);

}  // namespace kinora
