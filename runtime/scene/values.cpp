// runtime/scene/values.cpp: a pose's values and node matrices at a time.
#include "runtime/scene/values.h"

#include "runtime/scene/description/display_color.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/transforms.h"

namespace kinora {

void evaluate(const SceneResources& scene, Pose& pose, double time) {
    const SceneDescription& description = *scene.description;
    std::vector<double>& values = pose.values;
    anim::evaluate(description.animation, time, values, pose.changed, scene.baked_samplers);
    for (const MovingColor& color : description.moving_colors) {
        const double* display = &values[color.display];
        dvec3 linear = linear_of_display({display[0], display[1], display[2]});
        for (int k = 0; k < 3; ++k) values[color.linear + uint32_t(k)] = linear[k];
    }
    pose.time = time;
}

void evaluate_anew(const SceneNodes& scene, Pose& pose, std::optional<double> time) {
    const SceneDescription& description = *scene.description;
    pose.values = description.values;
    size_t owners = description.nodes.size() + description.morphs.size() + 1;
    pose.changed.assign(anim::changed_words(owners), 0);
    pose.time = 0;
    if (time) evaluate(scene, pose, *time);
    pose.first_frame = true;
    update_transforms(scene, pose);
}

void take_added_values(SceneDescription& description, Pose& start) {
    description.animated.resize(description.values.size(), false);
    std::vector<double>& values = start.values;
    values.insert(values.end(), description.values.begin() + ptrdiff_t(values.size()),
                  description.values.end());
}

void take_added(const SceneNodes& scene, const Pose& start, Pose& pose) {
    const std::vector<double>& values = start.values;
    pose.values.insert(pose.values.end(), values.begin() + ptrdiff_t(pose.values.size()),
                       values.end());
    pose.changed.resize(start.changed.size(), 0);
    for (size_t n = pose.nodes.size(); n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        dmat4 world =
            node.conversion * node_matrix(scene.description->nodes[node.definition], pose.values);
        if (node.parent != kNone) world = pose.nodes[node.parent].world * world;
        pose.nodes.push_back({.world = world, .moved = false});
    }
}

}  // namespace kinora
