// runtime/build/displacement_p.h: a displaced mesh under construction; for displacement.cpp
// and dicing.cpp only.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "runtime/build/scene_p.h"
#include "runtime/vertices/dice_error.h"

namespace kinora {

// A camera, and where the base mesh's vertices are for it.
struct DiceView {
    raytrace::Camera camera;
    dmat4 accel_from_pose{1.0};
    std::vector<vec4> pose;  // of deforming meshes; empty: the rest positions

    bool same(const DiceView& o) const {
        return pose.empty() && o.pose.empty() && accel_from_pose == o.accel_from_pose &&
               camera.eye == o.camera.eye && camera.right == o.camera.right &&
               camera.up == o.camera.up && camera.half_width == o.camera.half_width &&
               camera.half_height == o.camera.half_height && camera.width == o.camera.width &&
               camera.znear == o.camera.znear;
    }
};

// Shapes that share one displaced mesh: several only where it is displaced once and alike.
struct SceneBuilder::Displaced {
    std::vector<uint32_t> shapes;
    std::vector<std::vector<uint32_t>> surfaces;  // by shape, by group
    std::vector<uint8_t> diced;                   // by group
    bool deforms = false;                         // a skin or morph
    bool each_frame = false;
    std::vector<DiceView> views;
    Mesh base;
    std::optional<DicedMesh> made;
    WatchedEdges* watched = nullptr;  // the scene's; null where nothing was diced

    bool any_diced() const { return std::find(diced.begin(), diced.end(), 1) != diced.end(); }
};

}  // namespace kinora
