// runtime/programs/common/list_scene.h: what is in a scene, for --list.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinora {

struct Scene;

// "cameras", "clips", ..., and "all" at the end.
const std::vector<std::string_view>& list_kinds();

// A line or a few for each thing of that kind, or one JSON object of arrays. Says also what was
// added to the scene (cameras, lights) and how it stands.
std::string list_scene(const Scene& scene, const std::string& kind);
std::string list_scene_json(const Scene& scene, const std::string& kind);

}  // namespace kinora
