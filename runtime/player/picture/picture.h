// runtime/player/picture/picture.h: a picture that the render thread has finished. It does not
// change any more; who holds the pointer may read it from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/camera.h"
#include "raytrace/film.h"
#include "runtime/base/math.h"
#include "runtime/picture/shading/frame/insight.h"

namespace kinora {

// What the first surfaces are, pixel by pixel: of rays through the pixels' centers.
struct PictureGuide {
    int width = 0, height = 0;
    std::vector<uint32_t> surface;  // row of Scene::surfaces; kNone: nothing is there
    std::vector<vec3> Ng;           // world, towards the eye; length 1
    std::vector<float> depth;       // along the view's direction

    void resize(int w, int h) {
        const size_t pixels = size_t(width = w) * size_t(height = h);
        surface.resize(pixels);
        Ng.resize(pixels);
        depth.resize(pixels);
    }
};

// What colors stand for that show numbers: from black or blue to white or red.
struct NumberScale {
    double low = 0, high = 1;
    bool in_color = false;  // false_color(); else grays
};

struct Picture {
    uint64_t serial = 0;        // grows by one with each picture
    int width = 0, height = 0;  // as shown
    std::vector<uint8_t> rgba;  // to show: sRGB, not associated, rows from the top
    // As rendered: `film` is smaller than the picture where `scale` < 1. Linear, associated.
    raytrace::Film film;
    PictureGuide guide;                  // empty where nothing was asked of it
    PixelCosts costs;                    // of the film's size; empty where nobody asked
    std::optional<NumberScale> numbers;  // where `rgba` shows some
    raytrace::Camera view;               // that made it
    dvec3 origin{0.0};                   // of the view's space, in the world
    double frame = 0;                    // of the scene's time
    double scale = 1;
    int samples = 0;  // a pixel
    // All samples that kinora-render takes, at full size: the same bits as in its file.
    bool refined = false;
    bool quick = false;  // the first of its view: as while something moves
    double ms = 0;       // that it took
};

// ms that the last frames took. The rows of the HUD.
struct StageTimes {
    double animate = 0, skin = 0, refit = 0, trace = 0, shade = 0, present = 0, total = 0;
    double scale = 1;
    int samples = 1;
    bool cancelled = false;
    double at = 0;  // when it was ready: ms since the player began
};

}  // namespace kinora
