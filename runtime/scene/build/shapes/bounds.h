// runtime/scene/build/shapes/bounds.h: how large a scene is and where.
#pragma once

#include <vector>

#include "runtime/base/math.h"

namespace kinora {

struct Scene;
struct SceneDescription;
struct SceneResources;

struct Bounds {
    dvec3 low{1e300}, high{-1e300};
    bool empty() const { return low.x > high.x; }
    void add(dvec3 p);  // unless it is not finite
};

// Writes Scene::origin, low, high and size, by the shapes as the nodes stand; poses them and bakes
// the static ones. A scene without anything gets a cube.
void set_bounds(Scene& scene);

// Whether a shape has a triangle with an area, as the document has it, on a node that leaves it
// one.
bool anything_to_draw(const Scene& scene);
// Whether the user takes parts of the scene away (--hide, --only).
bool takes_parts(const SceneDescription& description);

// Times that stand for the range played (which no choice of frames changes), seconds: so many from
// its start to its end; one where nothing moves.
inline constexpr int kPlayedTimes = 13;
std::vector<double> played_times(const SceneResources& scene, int most = kPlayedTimes);

}  // namespace kinora
