// runtime/scene/images/texture_pyramid.cpp: decoding to linear light, tiling, halving.
#include "runtime/scene/images/texture_pyramid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace kinora {

namespace {

constexpr int kTile = TextureLevel::kTile;

// Rounds to nearest even; what is below the smallest normal half becomes 0. 0 <= x < 65504.
uint16_t half_bits(float x) {
    if (!(x >= 0x1p-14f)) return 0;
    uint32_t bits = std::bit_cast<uint32_t>(x);
    bits += 0xfff + (bits >> 13 & 1);
    return uint16_t((bits - (112u << 23)) >> 13);
}

void store_texel(HalfTexel& texel, float4 value) {
    for (int c = 0; c < 4; ++c) texel.c[c] = half_bits(value[c]);
}
void store_texel(FloatTexel& texel, float4 value) {
    std::memcpy(texel.c, &value, sizeof value);
}

float srgb_decode(float x) {
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

// Infinite and undefined texels would spread over all coarser levels.
float finite(float x) {
    if (x != x) return 0;
    constexpr float kMaxHalf = 65504;
    return std::isinf(x) ? std::copysign(kMaxHalf, x) : x;
}

// Pixel (x, y) of an image, y = 0 the bottom row, in linear light.
class LinearPixels {
  public:
    LinearPixels(const TextureImage& image, bool decode_srgb)
        : image_(image), decode_(decode_srgb) {
        for (int i = 0; i < 256; ++i) table_[i] = decode_ ? srgb_table()[i] : float(i) / 255.0f;
    }
    float4 operator()(int x, int y) const {
        size_t at = (size_t(image_.height - 1 - y) * size_t(image_.width) + size_t(x)) * 4;
        if (!image_.is_float()) {
            const uint8_t* p = &image_.bytes[at];
            return float4{table_[p[0]], table_[p[1]], table_[p[2]], float(p[3]) / 255.0f};
        }
        const float* p = &image_.floats[at];
        float4 value{finite(p[0]), finite(p[1]), finite(p[2]), finite(p[3])};
        if (decode_)
            for (int c = 0; c < 3; ++c) value[c] = srgb_decode(value[c]);
        return value;
    }

  private:
    const TextureImage& image_;
    bool decode_;
    float table_[256];
};

// The source texels under one of `to` equal parts of `from` texels, and their shares.
struct BoxSpan {
    int first = 0, count = 0;
    float weight[4];
};
BoxSpan box_span(int from, int to, int part) {
    double scale = double(from) / to, begin = part * scale, end = begin + scale;
    BoxSpan span;
    span.first = int(begin);
    for (int i = span.first; i < from && i < end && span.count < 4; ++i)
        span.weight[span.count++] =
            float((std::min(end, i + 1.0) - std::max(begin, double(i))) / scale);
    return span;
}

template <class Texel>
void halve(const TextureLevel& from, const TextureLevel& to, Texel* texels) {
    std::vector<BoxSpan> columns;
    for (int x = 0; x < to.width; ++x) columns.push_back(box_span(from.width, to.width, x));
    for (int y = 0; y < to.height; ++y) {
        BoxSpan rows = box_span(from.height, to.height, y);
        for (int x = 0; x < to.width; ++x) {
            const BoxSpan& span = columns[size_t(x)];
            float4 sum{};
            for (int j = 0; j < rows.count; ++j)
                for (int i = 0; i < span.count; ++i)
                    sum += load_texel(texels + from.offset + from.row(rows.first + j) +
                                      TextureLevel::column(span.first + i)) *
                           (rows.weight[j] * span.weight[i]);
            store_texel(texels[to.offset + to.row(y) + TextureLevel::column(x)], sum);
        }
    }
}

template <class Texel>
void fill(const TextureImage& image, bool decode_srgb, const std::vector<TextureLevel>& levels,
          std::vector<Texel>& texels) {
    const TextureLevel& last = levels.back();
    texels.resize(last.offset + kTile * kTile);
    LinearPixels pixel(image, decode_srgb);
    const TextureLevel& finest = levels.front();
    for (int y = 0; y < finest.height; ++y)
        for (int x = 0; x < finest.width; ++x)
            store_texel(texels[finest.row(y) + TextureLevel::column(x)], pixel(x, y));
    for (size_t k = 1; k < levels.size(); ++k) halve(levels[k - 1], levels[k], texels.data());
}

}  // namespace

TexturePyramid::TexturePyramid(const TextureImage& image, bool decode_srgb) : colors(image.colors) {
    size_t offset = 0;
    for (int width = image.width, height = image.height;;
         width = std::max(width / 2, 1), height = std::max(height / 2, 1)) {
        size_t across = size_t((width + kTile - 1) / kTile);
        size_t up = size_t((height + kTile - 1) / kTile);
        levels.push_back({width, height, int(across * kTile * kTile), offset});
        offset += across * up * kTile * kTile;
        if (width == 1 && height == 1) break;
    }
    if (image.is_float())
        fill(image, decode_srgb, levels, floats_);
    else
        fill(image, decode_srgb, levels, half_);
}

float4 TexturePyramid::texel(int level, int x, int y) const {
    const TextureLevel& l = levels[size_t(level)];
    size_t at = l.offset + l.row(y) + TextureLevel::column(x);
    return is_half() ? load_texel(&half_[at]) : load_texel(&floats_[at]);
}

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values;
        for (int i = 0; i < 256; ++i) {
            double x = i / 255.0;
            values[size_t(i)] =
                float(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
        }
        return values;
    }();
    return table;
}

}  // namespace kinora
