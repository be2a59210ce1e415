// runtime/scene/build/instances/light_instances.h: shader instances of lights.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/build/instances/instance_compiler.h"
#include "runtime/scene/lights.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shaders.h"

namespace kinora {

// One for each of Scene::lights that has none yet, compiled; lights without a shader go. Writes
// Scene::looks and the lights' own. `messages`: light parameters that some surface reads. False
// when a shader cannot be compiled.
bool add_light_instances(const SceneNodes& nodes, SceneLights& lights, SceneShaders& shaders,
                         Pose& start, InstanceCompiler& compiler,
                         const std::vector<std::string>& messages);

}  // namespace kinora
