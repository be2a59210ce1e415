// runtime/build/shapes/bounds.h: how large a scene is and where.
#pragma once

#include "runtime/scene/scene.h"

namespace kinora {

struct Bounds {
    dvec3 low{1e300}, high{-1e300};
    bool empty() const { return low.x > high.x; }
    void add(dvec3 p);  // unless it is not finite
};

// Writes Scene::origin, low, high and size, by the shapes as the nodes stand; poses them and bakes
// the static ones.
void set_bounds(Scene& scene, Diagnostics& diagnostics);

// Of all shapes over the range played. After set_bounds; the scene stands at its start time then.
Bounds played_bounds(Scene& scene);

}  // namespace kinora
