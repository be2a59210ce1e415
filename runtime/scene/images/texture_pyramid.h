// runtime/scene/images/texture_pyramid.h: linear RGBA texels in tiles, and their halves of halves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "runtime/scene/images/texture_image.h"

namespace kinora {

using float4 = float __attribute__((vector_size(16)));

// What 8-bit images are kept as. Values are 0 or normal and not negative, so that float_of is
// exact whatever the denormal mode.
struct HalfTexel {
    uint16_t c[4];
};
struct alignas(16) FloatTexel {
    float c[4];
};

inline float4 load_texel(const FloatTexel* texel) {
    float4 value;
    std::memcpy(&value, texel, sizeof value);
    return value;
}
// The bits of a half, shifted to where a float has them, are the value times 2^-112.
inline float4 load_texel(const HalfTexel* texel) {
    using long2 = uint64_t __attribute__((vector_size(16)));
    using short8 = uint16_t __attribute__((vector_size(16)));
    using int4 = uint32_t __attribute__((vector_size(16)));
    uint64_t packed;
    std::memcpy(&packed, texel, sizeof packed);
    short8 spread =
        __builtin_shuffle(short8(long2{packed, 0}), short8{}, short8{0, 8, 1, 9, 2, 10, 3, 11});
    return float4(int4(spread) << 13) * 0x1p112f;
}

// One size of the image. Texels lie in 8x8 tiles, tiles in rows, row 0 at the bottom (t = 0):
// the index of (x, y) is the sum of a part of x and a part of y.
struct TextureLevel {
    static constexpr int kTile = 8;
    int width, height;
    int tile_row;   // texels in a row of tiles
    size_t offset;  // texel (0, 0), in texels

    static constexpr size_t column(int x) { return size_t(x >> 3) * 64 + size_t(x & 7); }
    size_t row(int y) const { return size_t(y >> 3) * size_t(tile_row) + size_t(y & 7) * 8; }
};

// An image ready for lookups: level k + 1 has half of level k's width and height, rounded down, by
// a box filter in linear light; the last level is one texel.
class TexturePyramid {
  public:
    TexturePyramid() = default;
    // `decode_srgb`: the colours (not alpha) are sRGB-encoded. Throws std::bad_alloc.
    TexturePyramid(const TextureImage& image, bool decode_srgb);

    bool is_half() const { return !half_.empty(); }
    const HalfTexel* half_texels() const { return half_.data(); }
    const FloatTexel* float_texels() const { return floats_.data(); }
    float4 texel(int level, int x, int y) const;
    size_t bytes() const {
        return half_.size() * sizeof(HalfTexel) + floats_.size() * sizeof(FloatTexel);
    }

    std::vector<TextureLevel> levels;
    int colors = 3;

  private:
    std::vector<HalfTexel> half_;
    std::vector<FloatTexel> floats_;
};

// Linear light of an sRGB-encoded byte (IEC 61966-2-1).
const std::array<float, 256>& srgb_table();

}  // namespace kinora
