// runtime/player/actions_camera.cpp: what moves the camera.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "runtime/player/core_p.h"

namespace kinora {

namespace {

CommandResult no_scene() {
    return refused("there is no scene yet");
}

// Moves the camera by hand; refused where there is none to move.
template <class Move>
CommandResult move(PlayerCore& core, Move&& how) {
    std::string why_not;
    FreeCamera* camera = core.own_camera(why_not);
    if (!camera) return refused(why_not);
    how(*camera, up_of(core.info->up_axis));
    return {};
}

double aspect_of(const PlayerCore& core) {
    return double(core.state.picture.width) / std::max(core.state.picture.height, 1);
}

CommandResult view_along(PlayerCore& core, AxisView view) {
    return move(core,
                [&](FreeCamera& camera, dvec3) { look_along(camera, view, core.info->up_axis); });
}

}  // namespace

CommandResult action_orbit(PlayerCore& core, const Arguments& a) {
    return move(core, [&](FreeCamera& c, dvec3 up) { orbit(c, up, a.number(0), a.number(1)); });
}
CommandResult action_look(PlayerCore& core, const Arguments& a) {
    return move(core, [&](FreeCamera& c, dvec3 up) { look(c, up, a.number(0), a.number(1)); });
}
CommandResult action_pan(PlayerCore& core, const Arguments& a) {
    return move(core, [&](FreeCamera& c, dvec3) { pan(c, a.number(0), a.number(1)); });
}
CommandResult action_dolly(PlayerCore& core, const Arguments& a) {
    double factor = a.number(0);
    if (!(factor >= 1e-3 && factor <= 1e3)) return refused("dolly takes 0.001 to 1000", 1);
    return move(core, [&](FreeCamera& c, dvec3) { dolly(c, factor); });
}
CommandResult action_fly(PlayerCore& core, const Arguments& a) {
    return move(core, [&](FreeCamera& c, dvec3) {
        fly(c, c.distance * dvec3(a.number(0), a.number(1), a.number(2)));
    });
}

CommandResult action_stand(PlayerCore& core, const Arguments& a) {
    if (!core.info) return no_scene();
    const std::optional<FreeCamera> camera = camera_of(a.text(0));
    if (!camera)
        return refused(
            "stand takes 13 to 17 numbers: pivot, distance > 0, and right, up, back of length 1 at "
            "right angles",
            1);
    core.state.camera.own = *camera;
    core.state.camera.free = true;
    return {};
}

CommandResult action_pivot(PlayerCore& core, const Arguments& a) {
    std::string why_not;
    if (!core.own_camera(why_not)) return refused(why_not);
    int x = int(a.number(0)), y = int(a.number(1));
    core.inspect(true, [&core, x, y](Inspected& inspected) -> Answer {
        const PickedPixel picked = pick_pixel(inspected, x, y);
        return [&core, picked] {
            if (!picked.hit || !core.state.camera.free) return;
            FreeCamera& camera = core.state.camera.own;
            dvec3 eye = camera.eye();
            double along = glm::dot(eye - picked.P, camera.axes[2]);
            // The view stays: the pivot is as deep as what was picked.
            if (along > 0 && !camera.parallel) camera.distance = along;
            camera.pivot = eye - camera.distance * camera.axes[2];
        };
    });
    return {};
}

CommandResult action_frame_all(PlayerCore& core, const Arguments&) {
    return move(core, [&](FreeCamera& camera, dvec3) {
        frame_box(camera, core.info->low, core.info->high, aspect_of(core));
    });
}

CommandResult action_frame_selection(PlayerCore& core, const Arguments&) {
    std::string why_not, node = core.state.selection.node;
    if (node.empty()) return refused("no node is selected");
    if (!core.own_camera(why_not)) return refused(why_not);
    core.inspect(true, [&core, node](Inspected& inspected) -> Answer {
        const Scene& scene = inspected.scene;
        auto [low, high] = box_of(scene, scene, inspected.pose, find_node(scene, node));
        return [&core, low = low, high = high] {
            if (core.state.camera.free && low.x <= high.x)
                frame_box(core.state.camera.own, low, high, aspect_of(core));
        };
    });
    return {};
}

CommandResult action_view_front(PlayerCore& core, const Arguments&) {
    return view_along(core, AxisView::Front);
}
CommandResult action_view_right(PlayerCore& core, const Arguments&) {
    return view_along(core, AxisView::Right);
}
CommandResult action_view_top(PlayerCore& core, const Arguments&) {
    return view_along(core, AxisView::Top);
}
CommandResult action_view_back(PlayerCore& core, const Arguments&) {
    return view_along(core, AxisView::Back);
}
CommandResult action_view_left(PlayerCore& core, const Arguments&) {
    return view_along(core, AxisView::Left);
}
CommandResult action_view_bottom(PlayerCore& core, const Arguments&) {
    return view_along(core, AxisView::Bottom);
}

CommandResult action_parallel(PlayerCore& core, const Arguments&) {
    return move(core, [](FreeCamera& camera, dvec3) { camera.parallel = !camera.parallel; });
}

CommandResult action_camera(PlayerCore& core, const Arguments& a) {
    if (!core.info) return no_scene();
    const std::vector<std::string>& names = core.info->cameras;
    CameraState& camera = core.state.camera;
    uint32_t index = camera.index;
    if (a.has(0)) {
        auto found = std::ranges::find(names, a.text(0));
        if (found == names.end()) return refused(unknown_name("camera", a.text(0), names), 1);
        index = uint32_t(found - names.begin());
    } else if (!camera.free) {  // else back to the one it came from
        index = uint32_t((index + 1) % std::max<size_t>(names.size(), 1));
    }
    camera.index = index;
    camera.free = false;
    camera.turntable = false;
    camera.follow.clear();
    return {};
}

CommandResult action_camera_lock(PlayerCore& core, const Arguments&) {
    core.state.camera.locked = !core.state.camera.locked;
    return {};
}

CommandResult action_turntable(PlayerCore& core, const Arguments&) {
    CameraState& camera = core.state.camera;
    if (camera.turntable) {
        camera.turntable = false;
        return {};
    }
    std::string why_not;
    if (!core.own_camera(why_not)) return refused(why_not);
    camera.turntable = true;
    return {};
}

CommandResult action_follow(PlayerCore& core, const Arguments& a) {
    CameraState& camera = core.state.camera;
    std::string wanted = a.text_or(0, core.state.selection.node);
    if (!a.has(0) && !camera.follow.empty()) {
        camera.follow.clear();
        return {};
    }
    if (wanted.empty()) return refused("no node is selected");
    std::string why_not;
    if (!core.own_camera(why_not)) return refused(why_not);
    std::vector<std::string> known;
    for (const NodeInfo& node : core.info->nodes) known.insert(known.end(), {node.path, node.name});
    if (std::ranges::find(known, wanted) == known.end())
        return refused(unknown_name("node", wanted, known), 1);
    core.inspect(false, [&core, wanted](Inspected& inspected) -> Answer {
        const double time = time_of(inspected.shown, inspected.order);
        std::optional<dvec3> position = place_at(inspected.scene, inspected.pose, wanted, time);
        return [&core, wanted, position] {
            if (!position) return;
            core.state.camera.follow = wanted;
            core.follow_from = *position;
        };
    });
    return {};
}

}  // namespace kinora
