// runtime/picture/shading/first_hits/first_hits.h: what the first sample of each pixel meets first,
// and whose shading draws at random: filled while a picture is made.
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/wavefront.h"
#include "runtime/base/math.h"

namespace kinora {

class FirstHits {
  public:
    bool places = true;  // false: only `noisy` is wanted

    int width = 0, height = 0;
    // By pixel, rows from the top.
    std::vector<uint32_t> surface;  // row of the ray tracer; kNone: nothing is there
    std::vector<uint32_t> primitive;
    std::vector<float> u, v;
    std::vector<vec3> P, Ng;  // accel space
    // By the number of a shader instance: 1 where a ray of its points, or the sample of a light for
    // them, was drawn at random, or a light that reaches them calls random(). What a mirror sees of
    // these is sharp, and moves as no surface does: better noisy than smeared, so it does not
    // count.
    std::vector<uint8_t> noisy;

    bool any_noise() const;

    // Before a picture.
    void start(int picture_width, int picture_height, size_t shader_instances);

    // While it is made, by any thread. `depth`: 0 for points that the camera sees.
    void take(const raytrace::HitBatch& hits);
    void note_random(size_t shader_instance, uint32_t depth);
};

}  // namespace kinora
