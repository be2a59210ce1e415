// runtime/scene/resources.h: what a scene is made from, and what its shaders look up.
#pragma once

#include <memory>
#include <vector>

#include "anim/animation.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/scene_options.h"

namespace kinora {

class TextureStore;  // runtime/scene/images/texture_store.h
class PointStore;    // runtime/scene/images/point_store.h

struct SceneResources {
    std::shared_ptr<SceneDescription> description;
    std::vector<anim::Sampler> baked_samplers;  // instead of the description's; none: those
    SceneOptions options;
    std::shared_ptr<TextureStore> textures;  // what names in shaders stand for
    std::shared_ptr<PointStore> points;
};

}  // namespace kinora
