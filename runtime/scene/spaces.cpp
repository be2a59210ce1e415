// runtime/scene/spaces.cpp: the coordinate systems that shaders name.
#include "runtime/scene/spaces.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"

namespace kinora {

namespace {

// Camera space to screen: x right, y up, the shorter side of the picture spanning -1..1; z is 0 at
// the near and 1 at the far plane (RISpec 3.2, camera).
dmat4 screen_from_camera(const raytrace::Camera& view) {
    double shorter = std::min(view.half_width, view.half_height);
    dmat4 m(0.0);
    m[0][0] = m[1][1] = 1.0 / shorter;
    double n = view.znear, f = view.zfar;
    if (view.orthographic) {
        m[2][2] = 1.0 / (f - n);
        m[3][2] = -n / (f - n);
        m[3][3] = 1.0;
    } else {
        m[2][2] = f / (f - n);
        m[3][2] = -f * n / (f - n);
        m[2][3] = 1.0;
    }
    return m;
}

// NDC: 0..1 over the picture, y down.
dmat4 ndc_from_screen(const raytrace::Camera& view) {
    double shorter = std::min(view.half_width, view.half_height);
    dmat4 m(1.0);
    m[0][0] = view.sign.x * 0.5 * shorter / view.half_width;
    m[1][1] = view.sign.y * -0.5 * shorter / view.half_height;
    m[3] = dvec4(view.axis.x / view.width, view.axis.y / view.height, 0, 1);
    return m;
}

dmat4 current_from_owner(const Pose& pose, SpaceOwner owner) {
    dmat4 m = pose.view.camera_from_world;
    if (owner.node != kNone) m = m * pose.nodes[owner.node].world;
    if (owner.light) m[2] = -m[2];
    return m;
}

}  // namespace

dmat4 current_from_space(const SceneNodes& scene, const Pose& pose, std::string_view name,
                         SpaceOwner owner) {
    const raytrace::Camera& view = pose.view;
    if (name == "current" || name == "camera") return dmat4(1.0);
    if (name == "world") return view.camera_from_world * scene.description->world_space;
    if (name == "shader" || name == "object") return current_from_owner(pose, owner);
    dmat4 screen = screen_from_camera(view);
    if (name == "screen") return glm::inverse(screen);
    dmat4 ndc = ndc_from_screen(view) * screen;
    if (name == "NDC") return glm::inverse(ndc);
    if (name == "raster") {
        dmat4 raster(1.0);
        raster[0][0] = view.width;
        raster[1][1] = view.height;
        return glm::inverse(raster * ndc);
    }
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        const NodeDefinition& definition = scene.description->nodes[scene.nodes[n].definition];
        if (definition.id == name) return view.camera_from_world * pose.nodes[n].world;
    }
    return current_from_owner(pose, owner);
}

dmat4 object_from_space(const SceneNodes& scene, const Pose& pose, std::string_view name,
                        uint32_t object) {
    if (name == "current" || name == "object" || name == "shader") return dmat4(1.0);
    dmat4 object_from_world = glm::inverse(pose.nodes[object].world);
    if (name == "world") return object_from_world * scene.description->world_space;
    return object_from_world * pose.view.world_from_camera *
           current_from_space(scene, pose, name, object);
}

}  // namespace kinora
