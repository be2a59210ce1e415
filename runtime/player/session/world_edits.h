// runtime/player/session/world_edits.h: edits of a film, as far as one of its pictures has what
// they change.
#pragma once

#include "runtime/player/session/scene_edits.h"

namespace kinora {

// Without those of shaders, parameters and nodes that this picture does not have.
SceneEdits edits_of_world(const SceneEdits& edits, const SceneDescription& description);

}  // namespace kinora
