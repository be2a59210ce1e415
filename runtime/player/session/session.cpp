// runtime/player/session/session.cpp: a session's camera in a scene.
#include "runtime/player/session/session.h"

#include "runtime/player/session/places.h"

namespace kinora {

void choose_camera(const SceneCameras& scene, Pose& pose, const SessionCamera& camera) {
    auto is_it = [&](uint32_t index) {
        return index < scene.cameras.size() && scene.cameras[index].name == camera.name;
    };
    if (is_it(camera.index)) {
        pose.camera = camera.index;
        return;
    }
    for (uint32_t index = 0; index < scene.cameras.size(); ++index) {
        if (!is_it(index)) continue;
        pose.camera = index;
        return;
    }
}

PlacedCamera placed_camera(const SceneNodes& scene, Pose& pose, const FreeCamera& own,
                           const std::optional<std::pair<std::string, dvec3>>& follow,
                           double seconds) {
    PlacedCamera placed{own.optics(), own.world_from_camera()};
    if (!follow) return placed;
    dvec3 position = place_at(scene, pose, follow->first, seconds).value_or(follow->second);
    placed.world[3] += dvec4(position - follow->second, 0.0);
    return placed;
}

}  // namespace kinora
