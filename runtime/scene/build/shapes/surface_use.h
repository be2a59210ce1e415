// runtime/scene/build/shapes/surface_use.h: what the description says about one surface.
#pragma once

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Points into the description. One for each of Scene::surfaces.
struct SurfaceUse {
    const MeshUse* mesh = nullptr;
    const MaterialUse* material = nullptr;  // null: no material has the group's symbol
};

}  // namespace kinora
