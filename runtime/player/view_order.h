// runtime/player/view_order.h: what a picture is to show, and a scene seen that way.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "raytrace/camera.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/player/session/free_camera.h"

namespace kinora {

struct PlacedCamera;  // runtime/scene/camera.h
struct ShownScene;

// What a picture is to show.
struct ViewOrder {
    double frame = 0;
    std::optional<FreeCamera> camera;  // none: the scene's camera `camera_index`
    // The free camera moves with a node that was there when it began to.
    std::optional<std::pair<std::string, dvec3>> follow;
    uint32_t camera_index = 0;
    uint32_t only_light = kNone;  // of Scene::lights
    int width = 640, height = 360;
    double exposure = 0;   // stops above the request's
    bool playing = false;  // the next one comes soon: not refined, and not cancelled for it
    bool refine = true;
    bool adapt = true;   // fewer pixels while it moves
    bool filter = true;  // the noise of pictures that are not refined
    double hold_rate = 30;

    // The same picture, however it is displayed and refined.
    bool same_picture(const ViewOrder& other) const;
};

// The scene's camera that an order names, as it stands after so many seconds, without a picture of
// it. Nothing where there is no view.
std::optional<raytrace::Camera> view_of(const Scene& scene, Pose& pose, const ViewOrder& order,
                                        double seconds);

// What the refined picture of an order is made with in a pose of `scene`, which gets its camera,
// and its time in seconds. `scene` is the one shown, or it diced for a nearer view. `placed` keeps
// the camera that is moved by hand.
FrameSettings refined_settings(const ShownScene& shown, const Scene& scene, Pose& pose,
                               const ViewOrder& order, PlacedCamera& placed);
double time_of(const ShownScene& shown, const ViewOrder& order);

}  // namespace kinora
