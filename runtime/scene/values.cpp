// runtime/scene/values.cpp: a scene's values and node matrices at a time.
#include "runtime/scene/values.h"

#include "runtime/description/display_color.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"

namespace kinora {

void evaluate(Scene& scene, double time) {
    const SceneDescription& description = *scene.description;
    std::vector<double>& values = scene.values;
    anim::evaluate(description.animation, time, values, scene.changed, scene.baked_samplers);
    for (const MovingColor& color : description.moving_colors) {
        const double* display = &values[color.display];
        dvec3 linear = linear_of_display({display[0], display[1], display[2]});
        for (int k = 0; k < 3; ++k) values[color.linear + uint32_t(k)] = linear[k];
    }
    scene.time = time;
}

void evaluate_anew(Scene& scene, std::optional<double> time) {
    const SceneDescription& description = *scene.description;
    scene.values = description.values;
    size_t owners = description.nodes.size() + description.morphs.size() + 1;
    scene.changed.assign(anim::changed_words(owners), 0);
    scene.time = 0;
    if (time) evaluate(scene, *time);
    scene.first_frame = true;
    update_transforms(scene);
}

void take_added_values(Scene& scene) {
    SceneDescription& description = *scene.description;
    description.animated.resize(description.values.size(), false);
    size_t known = scene.values.size();
    scene.values.insert(scene.values.end(), description.values.begin() + ptrdiff_t(known),
                        description.values.end());
}

}  // namespace kinora
