// runtime/player/denoise/denoiser.h: the noise of a picture of few samples, filtered: along
// surfaces by a joint a-trous filter over N, depth, the surface and the diffuse texture, and over
// time by what the pictures before have shown of the same places. Pixels whose shading draws
// nothing at random keep their colors, bit for bit.
#pragma once

#include <memory>

#include "raytrace/film.h"
#include "runtime/picture/shading/first_hits/first_hits.h"

namespace kinora {

struct Pose;
struct Scene;

class Denoiser {
  public:
    Denoiser();
    ~Denoiser();

    // The picture to come is of another scene, or of other light.
    void forget();
    // Filters the film that was just rendered of the scene as it stands, with its first hits.
    // False: nothing of it is noisy.
    bool filter(const Scene& scene, const Pose& pose, const FirstHits& hits, raytrace::Film& film);

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
};

}  // namespace kinora
