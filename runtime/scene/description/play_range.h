// runtime/scene/description/play_range.h: when a scene begins and ends, and its clips.
#pragma once

#include <string_view>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// The range the scene plays by itself: MAYA/MAX3D/FCOLLADA extras, else the keys' range.
struct PlayRange {
    double start = 0, end = 0;  // seconds
    double rate = 24;           // frames per second
};
PlayRange play_range(const SceneDescription& description);

// The clip with that name, else with that id (null: no such clip).
const ClipDefinition* find_clip(const SceneDescription& description, std::string_view name);
// Makes the description play that clip: its range, and its own channels where it has them. Before
// build_scene.
void play_clip(SceneDescription& description, const ClipDefinition& clip);

}  // namespace kinora
