// tests/runtime/scene/images/texture_lookup.h: one lookup at a time, and images to look into.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "runtime/base/math.h"
#include "runtime/scene/images/texture_sample.h"

namespace kinora {

using Rgba = std::array<float, 4>;

struct TextureQuery {
    float s = 0, t = 0, dsdx = 0, dtdx = 0, dsdy = 0, dtdy = 0;
    float blur = 0, swidth = 1, twidth = 1, channel = 0, fill = 0;
};

// Lane 5 asks; the neighbours hold rubbish as inactive lanes do, and must stay unwritten.
inline Rgba look_up(const TexturePyramid& pyramid, const TextureName& modes, TextureFilter filter,
                    const TextureQuery& q) {
    constexpr int kLanes = jit::kMaxLanes, kLane = 5;
    alignas(64) float rows[11][kLanes];
    alignas(64) float results[4][kLanes];
    const float values[11] = {q.channel, q.s,    q.t,      q.dsdx,   q.dtdx, q.dsdy,
                              q.dtdy,    q.blur, q.swidth, q.twidth, q.fill};
    for (int r = 0; r < 11; ++r)
        for (int i = 0; i < kLanes; ++i) rows[r][i] = i == kLane ? values[r] : i & 1 ? NAN : 1e30f;
    for (auto& row : results)
        for (float& x : row) x = -77;
    TextureLanes lanes{rows[0], rows[1], rows[2], rows[3], rows[4],  rows[5],
                       rows[6], rows[7], rows[8], rows[9], rows[10], results[0]};
    sample_texture(pyramid, modes, filter, 1u << kLane, lanes);
    for (auto& row : results)
        for (int i = 0; i < kLanes; ++i)
            if (i != kLane && row[i] != -77) return {NAN, NAN, NAN, NAN};
    return {results[0][kLane], results[1][kLane], results[2][kLane], results[3][kLane]};
}

inline TextureImage float_image(int width, int height, uint32_t seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    TextureImage image;
    image.width = width;
    image.height = height;
    for (int i = 0; i < width * height * 4; ++i) image.floats.push_back(uniform(random));
    return image;
}

// A byte image by a rule: value(x, y) of all colours, y = 0 the bottom row; alpha 255.
template <class Value>
TextureImage byte_image(int width, int height, Value value) {
    TextureImage image;
    image.width = width;
    image.height = height;
    for (int row = 0; row < height; ++row)
        for (int x = 0; x < width; ++x) {
            auto v = uint8_t(value(x, height - 1 - row));
            image.bytes.insert(image.bytes.end(), {v, v, v, 255});
        }
    return image;
}

}  // namespace kinora
