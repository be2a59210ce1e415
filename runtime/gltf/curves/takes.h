// runtime/gltf/curves/takes.h: what becomes an animation of glTF.
#pragma once

#include <string>
#include <vector>

#include "runtime/description/scene_description.h"
#include "runtime/gltf/document/loss_report.h"

namespace kinora {

struct Take {
    std::string name;
    const anim::Animation* animation;  // the scene's, or a clip's own
};

// Clips stay apart where each plays all of an animation of its own and import_gltf, which plays
// together those that do not meet, makes the scene's animation of them again (glTF's own do). Other
// clips (COLLADA's, of parts of the scene's animation) are ranges of it.
std::vector<Take> find_takes(const SceneDescription& description, LossReport& losses);

}  // namespace kinora
