// runtime/scene/images/texture_sample.cpp: filtered lookups in a pyramid: coordinates of all lanes
// first, then a lane's texels as vectors of r g b a.
//
// Only +, -, * and exact functions (sqrt, comparisons, bits): the same result on every CPU.
#include "runtime/scene/images/texture_sample.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace kinora {

namespace {

// Largest integer <= x, for |x| < 2^31.
int floor_int(float x) {
    int i = int(x);
    return i - (x < float(i));
}

// x - floor(x), in 0..1 (1 for tiny negative x). Beyond 2^23 floats are integers.
float fraction(float x) {
    if (!(std::abs(x) < 0x1p23f)) return 0.0f;
    return x - float(floor_int(x));
}

// A coordinate brought near 0..1; what is left for texel indices is less than a texel's step.
float wrap_clamp(float s) {
    return std::clamp(s, 0.0f, 1.0f);
}
float wrap_mirror(float s) {
    float r = 2.0f * fraction(0.5f * s);
    return r <= 1.0f ? r : 2.0f - r;
}
float wrap_border(float s) {
    return std::clamp(s, -1.0f, 2.0f);
}
float wrapped(TextureWrap wrap, float s) {
    switch (wrap) {
        case TextureWrap::Wrap:
            return fraction(s);
        case TextureWrap::Mirror:
            return wrap_mirror(s);
        case TextureWrap::Clamp:
            return wrap_clamp(s);
        case TextureWrap::Border:
            return wrap_border(s);
    }
    return s;
}

// A texel index within 0..n-1, or -1 where the border shows. i is off by at most one texel except
// for Border.
int texel_index(TextureWrap wrap, int i, int n) {
    if (uint32_t(i) < uint32_t(n)) return i;
    switch (wrap) {
        case TextureWrap::Wrap:
            return i < 0 ? n - 1 : 0;
        case TextureWrap::Mirror:
        case TextureWrap::Clamp:
            return i < 0 ? 0 : n - 1;
        case TextureWrap::Border:
            return -1;
    }
    return 0;
}

template <class Texel>
struct TexelSampler {
    const TexturePyramid& pyramid;
    const TextureName& modes;
    const Texel* texels;
    float4 border{modes.border[0], modes.border[1], modes.border[2], modes.border[3]};

    float4 at(const TextureLevel& level, int x, int y) const {
        if ((x | y) < 0) return border;
        return load_texel(texels + level.offset + level.row(y) + TextureLevel::column(x));
    }

    float4 nearest(size_t k, float s, float t) const {
        const TextureLevel& level = pyramid.levels[k];
        int x = floor_int(wrapped(modes.wrap_s, s) * float(level.width));
        int y = floor_int(wrapped(modes.wrap_t, t) * float(level.height));
        // s = 1 itself belongs to the last texel, also of a border.
        x = s == 1.0f ? level.width - 1 : texel_index(modes.wrap_s, x, level.width);
        y = t == 1.0f ? level.height - 1 : texel_index(modes.wrap_t, y, level.height);
        return at(level, x, y);
    }

    // s, t already wrapped.
    float4 bilinear(size_t k, float s, float t) const {
        const TextureLevel& level = pyramid.levels[k];
        float x = s * float(level.width) - 0.5f, y = t * float(level.height) - 0.5f;
        int x0 = floor_int(x), y0 = floor_int(y);
        float fx = x - float(x0), fy = y - float(y0);
        int x1 = texel_index(modes.wrap_s, x0 + 1, level.width);
        int y1 = texel_index(modes.wrap_t, y0 + 1, level.height);
        x0 = texel_index(modes.wrap_s, x0, level.width);
        y0 = texel_index(modes.wrap_t, y0, level.height);
        float4 c00 = at(level, x0, y0), c10 = at(level, x1, y0);
        float4 c01 = at(level, x0, y1), c11 = at(level, x1, y1);
        float4 low = c00 + (c10 - c00) * fx, high = c01 + (c11 - c01) * fx;
        return low + (high - low) * fy;
    }

    // The level that is looked at for one of a footprint.
    float level_of(float lod) const {
        if (modes.mip == TextureMip::None) return 0;
        float last = float(pyramid.levels.size() - 1);
        if (modes.mip_max_level) last = std::min(last, float(modes.mip_max_level));
        lod = std::clamp(lod + modes.mip_bias, 0.0f, last);
        return modes.mip == TextureMip::Nearest ? float(floor_int(lod + 0.5f)) : lod;
    }

    // One or two levels, each by `look(level)`.
    template <class ShaderInstance>
    float4 between(float lod, ShaderInstance look) const {
        if (!(lod > 0)) return look(0);
        size_t k = size_t(lod);
        if (lod == float(k)) return look(k);
        float4 fine = look(k), coarse = look(k + 1);
        return fine + (coarse - fine) * (lod - float(k));
    }

    float4 trilinear(float lod, float s, float t) const {
        s = wrapped(modes.wrap_s, s);
        t = wrapped(modes.wrap_t, t);
        return between(lod, [&](size_t k) { return bilinear(k, s, t); });
    }
};

// log2 of a positive normal float: exponent and, for the mantissa 1 + f, a cubic through f = 0, 1
// whose error is under 0.001: level differences no eye or 8-bit pixel sees.
float log2_of(float x) {
    uint32_t bits = std::bit_cast<uint32_t>(x);
    float f = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1.0f;
    return float(int(bits >> 23) - 127) + f * (1.42287f + f * (-0.58209f + f * 0.15922f));
}

// Where and how finely each lane looks.
struct Footprints {
    alignas(64) float s[jit::kMaxLanes], t[jit::kMaxLanes];
    alignas(64) float ds[jit::kMaxLanes],
        dt[jit::kMaxLanes];  // the longer side, along which taps lie
    alignas(64) float lod[jit::kMaxLanes];
    alignas(64) float taps[jit::kMaxLanes];
};

void find_footprints(const TexturePyramid& pyramid, const TextureName& modes, TextureFilter filter,
                     const TextureLanes& in, Footprints& out) {
    float width = float(pyramid.levels[0].width), height = float(pyramid.levels[0].height);
    float most_taps = filter == TextureFilter::Anisotropic ? float(kMaxTaps) : 1.0f;
    float larger = std::max(width, height);
    // More than the whole image is the coarsest level anyway; NaN counts as no width.
    auto side = [&](float ds, float dt) {
        float x = ds * width, y = dt * height;
        float length = std::sqrt(x * x + y * y);
        length = length > 0.0f ? length : 0.0f;
        return std::min(length, 0x1p17f);
    };
    bool turned = modes.turn[0] != 1.0f || modes.turn[1] != 0.0f;
    auto turn = [&](float& s, float& t) {
        float s0 = s;
        s = modes.turn[0] * s0 - modes.turn[1] * t;
        t = modes.turn[1] * s0 + modes.turn[0] * t;
    };
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        float s = in.s[i], t = in.t[i];
        float dsdx = in.dsdx[i] * in.swidth[i], dtdx = in.dtdx[i] * in.twidth[i];
        float dsdy = in.dsdy[i] * in.swidth[i], dtdy = in.dtdy[i] * in.twidth[i];
        if (turned) {
            s -= 0.5f, t -= 0.5f;
            turn(s, t);
            s += 0.5f, t += 0.5f;
            turn(dsdx, dtdx);
            turn(dsdy, dtdy);
        }
        out.s[i] = s * modes.uv[0] + modes.uv[2];
        out.t[i] = t * modes.uv[1] + modes.uv[3];
        dsdx *= modes.uv[0], dsdy *= modes.uv[0];
        dtdx *= modes.uv[1], dtdy *= modes.uv[1];
        float x = side(dsdx, dtdx), y = side(dsdy, dtdy);
        float blur = in.blur[i] > 0.0f ? std::min(in.blur[i], 1.0f) * larger : 0.0f;
        float major = std::max(x, y) + blur;
        float minor = std::max(std::min(x, y) + blur, 1.0f);
        // Taps a shorter side apart cover the longer one; beyond most_taps a coarser level does.
        float ratio = major / minor;
        float whole = float(int(ratio));
        float taps = std::clamp(whole + (ratio > whole ? 1.0f : 0.0f), 1.0f, most_taps);
        bool along_x = x >= y;
        out.ds[i] = along_x ? dsdx : dsdy;
        out.dt[i] = along_x ? dtdx : dtdy;
        out.taps[i] = taps;
        out.lod[i] = log2_of(std::max(major / taps, 1.0f));
    }
}

template <class Texel>
float4 sample_lane(const TexelSampler<Texel>& sampler, TextureFilter filter, const Footprints& at,
                   int i) {
    bool magnified = at.lod[i] == 0.0f && at.taps[i] == 1.0f;
    bool nearest = magnified ? sampler.modes.nearest_magnified : sampler.modes.nearest_minified;
    if (filter == TextureFilter::Nearest) return sampler.nearest(0, at.s[i], at.t[i]);
    float lod = magnified ? 0 : sampler.level_of(at.lod[i]);
    if (nearest)
        return sampler.between(lod, [&](size_t k) { return sampler.nearest(k, at.s[i], at.t[i]); });
    if (filter == TextureFilter::Bilinear) return sampler.trilinear(0, at.s[i], at.t[i]);
    if (at.taps[i] == 1.0f || sampler.modes.mip == TextureMip::None)
        return sampler.trilinear(lod, at.s[i], at.t[i]);
    float4 sum{};
    float step = 1.0f / at.taps[i];
    for (int k = 0; float(k) < at.taps[i]; ++k) {
        float offset = (float(k) + 0.5f) * step - 0.5f;
        sum += sampler.trilinear(lod, at.s[i] + offset * at.ds[i], at.t[i] + offset * at.dt[i]);
    }
    return sum * step;
}

void store_result(float4 texel, int colors, const TextureLanes& lanes, int i) {
    for (int k = 0; k < 4; ++k) {
        float channel = lanes.channel[i] + float(k);
        int c = channel >= 0.0f && channel < 4.0f ? int(channel) : -1;
        bool present = c == 3 || (c >= 0 && c < colors);
        lanes.results[k * jit::kMaxLanes + i] = present ? texel[c] : lanes.fill[i];
    }
}

template <class Texel>
void sample_lanes(const TexelSampler<Texel>& sampler, TextureFilter filter, uint32_t mask,
                  const TextureLanes& lanes) {
    Footprints at;
    find_footprints(sampler.pyramid, sampler.modes, filter, lanes, at);
    for (; mask; mask &= mask - 1) {
        int i = std::countr_zero(mask);
        if (at.s[i] != at.s[i] || at.t[i] != at.t[i]) {
            for (int k = 0; k < 4; ++k) lanes.results[k * jit::kMaxLanes + i] = lanes.fill[i];
            continue;
        }
        store_result(sample_lane(sampler, filter, at, i), sampler.pyramid.colors, lanes, i);
    }
}

}  // namespace

void sample_texture(const TexturePyramid& pyramid, const TextureName& modes, TextureFilter filter,
                    uint32_t mask, const TextureLanes& lanes) {
    if (modes.nearest) filter = TextureFilter::Nearest;
    if (pyramid.is_half())
        sample_lanes(TexelSampler<HalfTexel>{pyramid, modes, pyramid.half_texels()}, filter, mask,
                     lanes);
    else
        sample_lanes(TexelSampler<FloatTexel>{pyramid, modes, pyramid.float_texels()}, filter, mask,
                     lanes);
}

}  // namespace kinora
