// runtime/player/session/places.cpp: paths of nodes.
#include "runtime/player/session/places.h"

#include <glm/common.hpp>

#include "runtime/scene/shapes.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

uint32_t find_node(const SceneNodes& scene, const std::string& wanted) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].definition == kNone) continue;
        const NodeDefinition& node = scene.description->nodes[scene.nodes[n].definition];
        if (wanted == node.id || wanted == node.name || wanted == node_path(scene, n)) return n;
    }
    return kNone;
}

std::pair<dvec3, dvec3> box_of(const SceneNodes& scene, const SceneShapes& shapes, const Pose& pose,
                               uint32_t node) {
    dvec3 low(1e300), high(-1e300);
    for (size_t s = 0; s < shapes.shapes.size(); ++s) {
        const Shape& shape = shapes.shapes[s];
        const ShapePose& stands = pose.shapes[s];
        uint32_t n = shape.node;
        while (n != node && n != kNone) n = scene.nodes[n].parent;
        if (n != node) continue;
        bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
        dvec3 anchor = shapes.meshes[shape.mesh].anchor;
        for (const vec4& position : stands.shown_positions) {
            dvec3 p = dvec3(vec3(position));
            p = instanced ? dvec3(stands.world * dvec4(p + anchor, 1.0)) : p + shapes.origin;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return {low, high};
}

std::optional<dvec3> place_at(const SceneNodes& scene, Pose& pose, const std::string& name,
                              double seconds) {
    uint32_t node = find_node(scene, name);
    if (node == kNone) return std::nullopt;
    evaluate(scene, pose, seconds);
    update_transforms(scene, pose);
    return dvec3(pose.nodes[node].world[3]);
}

}  // namespace kinora
