// runtime/play/view_order.h: what a picture is to show, and a scene seen that way.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "raytrace/camera.h"
#include "runtime/frame/frame.h"
#include "runtime/play/session/free_camera.h"

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

// The view of an order, without a picture of it. For questions. Nothing where there is none.
std::optional<raytrace::Camera> view_of(ShownScene& scene, const ViewOrder& order);

// What the refined picture of an order is made with, and its time in seconds. `placed` keeps the
// camera that is moved by hand.
FrameSettings refined_settings(ShownScene& scene, const ViewOrder& order, PlacedCamera& placed);
double time_of(const ShownScene& scene, const ViewOrder& order);

// Where a node stands at a frame; nothing where there is none of that name. Likewise.
std::optional<dvec3> place_of(ShownScene& scene, const std::string& node, double frame);

}  // namespace kinora
