// runtime/scene/lights.h: the lights of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// An occurrence of a light.
struct LightSource {
    uint32_t definition = kNone;
    uint32_t node = kNone;
    uint32_t look = kNone;
    uint32_t surface = kNone;  // whose triangles shine; kNone: no area light
    uint32_t listed = kNone;   // the definition that surfaces list; kNone: it reaches all
    // Surfaces whose own emission the light is, `surface` the first; none of other lights.
    std::vector<uint32_t> emitting = {};
};

struct SceneLights {
    std::vector<LightSource> lights;
    // Frames of a pose whose points are counted for LIGHTS_DARK: only its own lights shine.
    uint32_t watch_dark = 0;
    float world_light = 0;  // the brightness of the grey world that was added, which is no light
};

}  // namespace kinora
