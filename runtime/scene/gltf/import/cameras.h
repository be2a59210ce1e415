// runtime/scene/gltf/import/cameras.h: glTF's cameras.
#pragma once

#include "runtime/scene/gltf/import/rsl.h"
#include "runtime/scene/gltf/import/unique_ids.h"

namespace kinora {

// `meter`: metres per unit of the world that the description is in.
void import_cameras(const tinygltf::Model& model, double meter, RslExtras& rsl, UniqueIds& ids,
                    PointerSlots& pointers, const GltfReport& report, SceneDescription& out);

}  // namespace kinora
