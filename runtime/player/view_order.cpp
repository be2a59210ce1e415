// runtime/player/view_order.cpp: a scene brought to the time and the camera of an order.
#include "runtime/player/view_order.h"

#include <cmath>
#include <tuple>

#include "runtime/player/session/session.h"
#include "runtime/player/shown_scene.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

bool ViewOrder::same_picture(const ViewOrder& o) const {
    auto camera_key = [](const FreeCamera& c) {
        return std::tuple(c.pivot, c.distance, c.axes, c.parallel, c.half_height);
    };
    bool same_camera =
        camera.has_value() == o.camera.has_value() &&
        (camera ? camera_key(*camera) == camera_key(*o.camera) : camera_index == o.camera_index);
    return same_camera && follow == o.follow && frame == o.frame && width == o.width &&
           height == o.height && exposure == o.exposure && only_light == o.only_light &&
           filter == o.filter;
}

std::optional<raytrace::Camera> view_of(const Scene& scene, Pose& pose, const ViewOrder& order,
                                        double seconds) {
    evaluate(scene, pose, seconds);
    update_transforms(scene, pose);
    if (order.camera_index < scene.cameras.size()) pose.camera = order.camera_index;
    if (raytrace::is_error(set_view(scene, pose, order.width, order.height))) return std::nullopt;
    return pose.view;
}

// A picture of a RIB file is made when its shutter opens, whatever its frame's number.
double time_of(const ShownScene& shown, const ViewOrder& order) {
    if (shown.scene->description->file_picture) return shown.scene->options.start_time;
    return seconds_of(shown.rate, order.frame);
}

FrameSettings refined_settings(const ShownScene& shown, const Scene& scene, Pose& pose,
                               const ViewOrder& order, PlacedCamera& placed) {
    FrameSettings settings = shown.settings;
    settings.width = order.width;
    settings.height = order.height;
    settings.gain *= std::exp2(order.exposure);
    if (order.only_light < scene.lights.size()) settings.insight.only_light = order.only_light;
    settings.integrator.seed = frame_seed(shown.request, std::llround(order.frame));
    if (order.camera) {
        placed = placed_camera(scene, pose, *order.camera, order.follow, time_of(shown, order));
        settings.camera = &placed;
    } else if (order.camera_index < scene.cameras.size()) {
        pose.camera = order.camera_index;
    }
    return settings;
}

}  // namespace kinora
