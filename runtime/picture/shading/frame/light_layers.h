// runtime/picture/shading/frame/light_layers.h: AOVs that are some of the picture's light.
#pragma once

#include <cstddef>
#include <vector>

namespace kinora {

// Some of the light that shaders get.
struct LightPart {
    std::vector<bool> lights = {};  // of Scene::lights; fewer: the others send nothing
    bool rays = false;              // what rays see
    bool bare = false;              // lights cast no shadows

    bool has(size_t light) const { return light < lights.size() && lights[light]; }
};

// What a part adds to shaders without light.
struct LightLayer {
    enum class Kind { Emission, Added, Shadow };
    static constexpr size_t kNoPlane = size_t(-1);

    Kind kind = Kind::Added;
    LightPart part = {};
    size_t plane = kNoPlane;  // the first of its three; of Shadow, the only one
    bool adds_up = false;     // such layers share no light, have all of it, and sum to the picture
};

// How much the layers of each look's points miss the picture, relative to it.
struct LayerErrors {
    std::vector<float> of_look;
    void add(size_t look, float error);
};

}  // namespace kinora
