// runtime/scene/build/instances/light_groups.h: lights whose part of the picture is an AOV.
#pragma once

#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora {

struct Scene;

struct LightGroup {
    std::string aov;
    std::vector<uint32_t> lights;  // of Scene::lights
};

// One a light, by light_aov_names().
std::vector<LightGroup> single_lights(const Scene& scene);
// Those of SceneOptions::light_groups. A text of another form, or a pattern that is no light's, is
// a finding.
std::vector<LightGroup> light_groups(const Scene& scene, Diagnostics& diagnostics);

}  // namespace kinora
