// runtime/scene/gltf/curves/takes.h: what becomes an animation of glTF.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct Take {
    std::string name;
    const anim::Animation* animation;  // the scene's, or a clip's own
    bool is_whole = false;             // plays where no clip is chosen; others by their clip alone
};

// Each clip that plays channels of its own is a take. Readers play together the takes that do not
// meet, the first of those that do. Where no order of the clips makes this the scene's animation, a
// take of the whole stands first.
std::vector<Take> find_takes(const SceneDescription& description);

}  // namespace kinora
