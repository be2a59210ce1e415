// runtime/scene/values.h: a pose's values at a time.
#pragma once

#include <optional>

namespace kinora {

struct Pose;
struct SceneDescription;
struct SceneNodes;
struct SceneResources;

// Channels to Pose::values at a time, in seconds. What changed is marked in Pose::changed.
void evaluate(const SceneResources& scene, Pose& pose, double time);

// Sets the pose's values, changed, time and the nodes' matrices, all of them anew, as the next
// frame would if it were the first. Seconds; none: the values of the file.
void evaluate_anew(const SceneNodes& scene, Pose& pose, std::optional<double> time);

// Values that the description got since go into those of Scene::start; no channel writes them.
void take_added_values(SceneDescription& description, Pose& start);
// The same for a pose that was made before; the nodes that the scene got since stand in it, too.
void take_added(const SceneNodes& scene, const Pose& start, Pose& pose);

}  // namespace kinora
