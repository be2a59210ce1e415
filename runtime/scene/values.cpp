// runtime/scene/values.cpp: a scene's values and node matrices at a time.
#include "runtime/scene/values.h"

#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"

namespace kinora {

void evaluate_anew(Scene& scene, std::optional<double> time) {
    const SceneDescription& description = *scene.description;
    scene.values = description.values;
    size_t owners = description.nodes.size() + description.morphs.size() + 1;
    scene.changed.assign(anim::changed_words(owners), 0);
    if (time) anim::evaluate(description.animation, *time, scene.values, scene.changed);
    scene.time = time.value_or(0);
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
