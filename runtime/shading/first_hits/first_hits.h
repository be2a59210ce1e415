// runtime/shading/first_hits/first_hits.h: what the first sample of each pixel meets first, and
// whose shading draws at random: filled while a picture is made.
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
    // them, was drawn at random.
    std::vector<uint8_t> noisy;

    bool any_noise() const;

    // Before a picture; after it. What sees others by rays is noisy where one of these is.
    void start(int picture_width, int picture_height, size_t shader_instances);
    void finish();

    // While it is made, by any thread. `depth`: 0 for points that the camera sees.
    void take(const raytrace::HitBatch& hits);
    void note_random(size_t shader_instance, uint32_t depth);
    void note_rays(size_t shader_instance, uint32_t depth);  // that shade what they meet

  private:
    std::vector<uint8_t> sees_others_;  // as `noisy`
    uint8_t nested_ = 0;                // something that rays have met is noisy
};

}  // namespace kinora
