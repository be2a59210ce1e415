// runtime/play/denoise/history.h: what the pictures before have shown of each place.
#pragma once

#include <optional>
#include <vector>

#include "runtime/play/denoise/planes.h"

namespace kinora {

// Brightness of the samples of a pixel so far.
struct Moments {
    std::vector<float> first, second;  // means of the brightness and of its square, newer ones more
    std::vector<float> count;          // samples, one a picture
};

class History {
  public:
    void forget() { known_ = false; }

    // Mixes into the colors of pixels with a variance what was seen there before, and sets that
    // variance: of the brightness, as the mixture has it. Where less than kFew pictures say so, by
    // the pixels around.
    void blend(const Scene& scene, const FirstHits& hits, Planes& planes);
    // These colors are what the next picture finds. The planes become those of the picture before.
    void keep(const Scene& scene, Planes& planes);

    static constexpr float kNewest = 0.2f;  // the least share of the newest picture
    static constexpr float kFew = 4;

  private:
    struct Seen {
        float c[4] = {}, first = 0, second = 0, count = 0;
    };
    vec3 place_before(const Scene& scene, const FirstHits& hits, size_t hit) const;
    std::optional<Seen> find(vec3 P, vec3 N, uint32_t surface) const;
    void clip(Seen& before, size_t at, const Planes& planes) const;
    float share_of_change(size_t at, const Planes& planes) const;
    void blend_pixel(Seen before, size_t at, Planes& planes);
    float spread_around(const Planes& planes, int x, int y) const;
    void keep_places(const Scene& scene);

    bool known_ = false;
    Planes before_;
    std::vector<float> fresh_[4];  // colors before they are mixed
    std::vector<Seen> seen_;       // what the picture before has; count 0: nothing
    Moments moments_, moments_before_;
    raytrace::Camera camera_;
    // Of each row of Scene::geometry: the matrix of instanced ones, the vertices of deforming ones.
    std::vector<dmat4> accel_from_local_;
    std::vector<std::vector<vec4>> vertices_;
    std::vector<const std::vector<vec4>*> vertices_of_;
};

}  // namespace kinora
