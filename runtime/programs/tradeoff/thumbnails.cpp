// runtime/programs/tradeoff/thumbnails.cpp: means of blocks; a scale of colours.
#include "runtime/programs/tradeoff/thumbnails.h"

#include <algorithm>
#include <cmath>

#include "runtime/scene/images/png_memory.h"

namespace kinora {

namespace {

constexpr int kThumbnailWidth = 192;

struct Blocks {
    Blocks(int width, int height)
        : side(std::max(1, (width + kThumbnailWidth - 1) / kThumbnailWidth)),
          across((width + side - 1) / side),
          down((height + side - 1) / side) {}
    int side, across, down;
};

// f(block, pixel) for each pixel of a picture.
template <class F>
void for_each_pixel(int width, int height, const Blocks& blocks, F&& f) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            f(size_t(y / blocks.side) * size_t(blocks.across) + size_t(x / blocks.side),
              size_t(y) * size_t(width) + size_t(x));
}

vec3 heat(double x) {
    constexpr float kColors[5][3] = {{0, 0, 0},
                                     {0.32f, 0.07f, 0.48f},
                                     {0.72f, 0.21f, 0.47f},
                                     {0.99f, 0.62f, 0.43f},
                                     {1, 1, 0.9f}};
    double at = 4 * std::clamp(x, 0.0, 1.0);
    int i = std::min(3, int(at));
    float t = float(at - i);
    vec3 a(kColors[i][0], kColors[i][1], kColors[i][2]);
    vec3 b(kColors[i + 1][0], kColors[i + 1][1], kColors[i + 1][2]);
    return a + t * (b - a);
}

}  // namespace

std::vector<uint8_t> picture_thumbnail(const raytrace::Film& film, ColorEncoding encoding) {
    Blocks blocks(film.width, film.height);
    raytrace::Film small(blocks.across, blocks.down);
    std::vector<float> counts(small.rgba.size());
    for_each_pixel(film.width, film.height, blocks, [&](size_t block, size_t pixel) {
        small.rgba[block] += film.rgba[pixel];
        counts[block] += 1;
    });
    for (size_t i = 0; i < counts.size(); ++i) small.rgba[i] /= counts[i];
    return encode_png(to_8_bit(small, encoding));
}

std::vector<uint8_t> flip_thumbnail(const Plane& flip) {
    Blocks blocks(flip.width, flip.height);
    std::vector<double> sums(size_t(blocks.across) * size_t(blocks.down)), counts(sums.size());
    for_each_pixel(flip.width, flip.height, blocks, [&](size_t block, size_t pixel) {
        sums[block] += flip[pixel];
        counts[block] += 1;
    });
    Image8 image{blocks.across, blocks.down, {}};
    for (size_t i = 0; i < sums.size(); ++i) {
        vec3 color = heat(std::sqrt(sums[i] / counts[i]));
        for (int k = 0; k < 3; ++k) image.rgba.push_back(uint8_t(std::lround(255 * color[k])));
        image.rgba.push_back(255);
    }
    return encode_png(image);
}

}  // namespace kinora
