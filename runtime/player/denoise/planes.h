// runtime/player/denoise/planes.h: a picture and what lies at its pixels, plane by plane.
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/film.h"
#include "runtime/base/parallel.h"
#include "runtime/picture/shading/first_hits/first_hits.h"
#include "runtime/player/denoise/kernels.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct Pose;
struct SceneShapes;

inline constexpr size_t kRowsOfTask = 8;  // of a picture, that one thread takes at a time

// Rows have a border on each side, and so has the picture above and below, so that a filter may
// read what lies a few pixels away of every pixel. The border is on a surface of its own.
struct Planes {
    static constexpr int kBorder = 8;  // pixels: the filter's widest step
    static constexpr uint32_t kOutside = kNone - 1;

    int width = 0, height = 0;
    ptrdiff_t stride = 0;  // of a row
    std::vector<float> c[4];
    std::vector<float> variance;  // of the brightness; 0: known for certain
    std::vector<float> N[3];      // world, towards the eye
    // 1 over the distance along the view, or that distance where the view is parallel: in both
    // cases linear over the picture on a plane. `slope`: the plane's, a pixel to the right and
    // below.
    std::vector<float> depth, slope[2];
    std::vector<float> albedo;      // brightness of the diffuse texture, see diffuse_maps.h
    std::vector<uint32_t> surface;  // row of Scene::surfaces, kNone: nothing is there

    void resize(int w, int h);  // whole runs of the kernels; what was there is lost
    size_t at(int x, int y) const {
        return size_t(y + kBorder) * size_t(stride) + size_t(x + kBorder);
    }
};

// Calls see(index of its first pixel) for each stretch of kFilterRun pixels, by any thread.
template <class See>
void each_stretch(const Planes& planes, See&& see) {
    parallel_for(0, size_t(planes.height), kRowsOfTask, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < planes.width; x += int(kFilterRun)) see(planes.at(x, int(y)));
    });
}

// The film's colors, and what the first hits are of the scene as it stands. Pixels whose shading
// draws nothing at random have no variance, others 1. False: there are none of these.
bool fill_planes(const SceneShapes& scene, const Pose& pose, const FirstHits& hits,
                 const raytrace::Film& film, Planes& planes);

// The colors of pixels with a variance, back to the film.
void take_colors(const Planes& planes, raytrace::Film& film);

}  // namespace kinora
