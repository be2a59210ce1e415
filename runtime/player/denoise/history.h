// runtime/player/denoise/history.h: what the pictures before have shown of each place.
#pragma once

#include <vector>

#include "runtime/player/denoise/history_kernels.h"
#include "runtime/player/denoise/planes.h"

namespace kinora {

// Brightness of the samples of a pixel so far.
struct Moments {
    std::vector<float> first, second;  // means of the brightness and of its square, newer ones more
    std::vector<float> count;          // samples, one a picture

    void resize(size_t size);
};

class History {
  public:
    void forget() { known_ = false; }

    // Mixes into the colors of pixels with a variance what was seen there before, and sets that
    // variance: of the brightness, as the mixture has it (history_kernels.h).
    void blend(const Pose& pose, const FirstHits& hits, Planes& planes);
    // These colors are what the next picture finds.
    void keep(const Pose& pose, const Planes& planes);

  private:
    // Of the picture before, the camera: how it sees a place, in pixels.
    struct View {
        dvec3 eye{0.0}, forward{0.0}, right{0.0}, down{0.0};
        dvec2 center{0.0};
        bool parallel = false;
    };
    // Of a stretch, in that picture.
    struct Places {
        alignas(64) float x[kFilterRun], y[kFilterRun], depth[kFilterRun];
    };
    vec3 place_before(const Pose& pose, const FirstHits& hits, size_t hit) const;
    void find(vec3 P, Places& places, size_t i) const;
    void look_back(const Pose& pose, const FirstHits& hits, size_t at, const Planes& planes);
    void mix(Planes& planes);
    void keep_pixels(const Planes& planes);
    void keep_places(const Pose& pose);

    bool known_ = false;
    // The picture before, with its border.
    std::vector<SeenPixel> before_;
    int width_ = 0, height_ = 0;
    ptrdiff_t stride_ = 0;
    std::vector<float> fresh_[4];  // colors before they are mixed
    // What the picture before has where the new one looks; count 0: nothing.
    std::vector<float> seen_[4];
    Moments seen_moments_;
    Moments moments_;
    View view_;
    // Of each row of Scene::geometry: the matrix of instanced ones, the vertices of deforming ones.
    std::vector<dmat4> accel_from_local_;
    std::vector<std::vector<vec4>> vertices_;
    std::vector<const std::vector<vec4>*> vertices_of_;
};

}  // namespace kinora
