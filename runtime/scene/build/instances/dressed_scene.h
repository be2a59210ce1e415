// runtime/scene/build/instances/dressed_scene.h: a scene in which a material wears another surface
// shader, beside the one that is shown.
#pragma once

#include <memory>
#include <string>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct Scene;
class Diagnostics;

struct Dress {
    uint32_t material = kNone;                  // into SceneDescription::materials
    std::shared_ptr<const rsl::Shader> shader;  // with its own parameters
    uint32_t alone = kNone;  // rays meet shapes of this node and of nodes below alone
};

// Shares with the scene all but these surfaces' instances and rows. Lights do without messages that
// no shader of the scene reads. Null: the shader cannot be compiled, which is reported.
std::unique_ptr<Scene> dressed_scene(const Scene& scene, const Dress& dress,
                                     Diagnostics& diagnostics);

}  // namespace kinora
