// runtime/scene/values.h: a scene's values and node matrices at a time.
#pragma once

#include <optional>

namespace kinora {

struct Scene;

// Channels to Scene::values at a time, in seconds. What changed is marked in Scene::changed.
void evaluate(Scene& scene, double time);

// Sets Scene::values, changed, time and the nodes' matrices, all of them anew, as the next frame
// would if it were the first. Seconds; none: the values of the file.
void evaluate_anew(Scene& scene, std::optional<double> time);

// Values that the description got since go into Scene::values; no channel writes them.
void take_added_values(Scene& scene);

}  // namespace kinora
