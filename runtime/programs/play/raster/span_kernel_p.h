// runtime/programs/play/raster/span_kernel_p.h: the span kernels, a template over an instruction
// set's vectors of 32-bit lanes, one pixel a lane.
//
// Each step is an integer operation, or a float product and sum that round separately, so all
// instruction sets give the same bits.
#pragma once

#include "runtime/programs/play/raster/span_p.h"

#define KINORA_INLINE __attribute__((always_inline)) inline

namespace kinora::play {
namespace {

template <class V>
struct Channels {
    typename V::Int c[4];  // r g b a, 0..255
};

// a * b / 255 rounded to the nearest, exact for 0..255.
template <class V>
KINORA_INLINE typename V::Int over_255(typename V::Int product) {
    auto t = V::add(product, V::set(128));
    return V::template shift_right<8>(V::add(t, V::template shift_right<8>(t)));
}

template <class V>
KINORA_INLINE Channels<V> unpack(typename V::Int rgba) {
    const auto low = V::set(255);
    return {{V::bits_and(rgba, low), V::bits_and(V::template shift_right<8>(rgba), low),
             V::bits_and(V::template shift_right<16>(rgba), low),
             V::template shift_right<24>(rgba)}};
}

template <class V>
KINORA_INLINE typename V::Int pack(const Channels<V>& p) {
    return V::bits_or(
        V::bits_or(p.c[0], V::template shift_left<8>(p.c[1])),
        V::bits_or(V::template shift_left<16>(p.c[2]), V::template shift_left<24>(p.c[3])));
}

// Source over destination; alpha adds up to how much of the target is covered.
template <class V>
KINORA_INLINE typename V::Int blend(const Channels<V>& source, typename V::Int target) {
    const auto d = unpack<V>(target);
    const auto alpha = source.c[3], rest = V::sub(V::set(255), alpha);
    Channels<V> out;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
        out.c[i] = over_255<V>(V::add(V::mul(source.c[i], alpha), V::mul(d.c[i], rest)));
    out.c[3] = V::add(alpha, over_255<V>(V::mul(d.c[3], rest)));
    return pack<V>(out);
}

// first + step * i of the lanes whose pixels are at, at + 1, ...
template <class V>
KINORA_INLINE typename V::Float along(float first, float step, int at) {
    return V::addf(V::setf(first),
                   V::mulf(V::setf(step), V::to_float(V::add(V::set(at), V::iota()))));
}

template <class V>
KINORA_INLINE Channels<V> vertex_color(const SpanPaint& paint, int at) {
    Channels<V> out;
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
        auto value = V::round(along<V>(paint.color[i], paint.color_dx[i], at));
        out.c[i] = V::max(V::set(0), V::min(V::set(255), value));
    }
    return out;
}

template <class V>
KINORA_INLINE typename V::Int clamped(typename V::Int x, int size) {
    return V::max(V::set(0), V::min(V::set(size - 1), x));
}

template <class V>
KINORA_INLINE typename V::Int mix(typename V::Int a, typename V::Int b, typename V::Int weight) {
    return V::add(V::mul(a, V::sub(V::set(256), weight)), V::mul(b, weight));
}

// Between four texels: weights wx, wy in 1/256.
template <class V>
KINORA_INLINE typename V::Int between(typename V::Int a, typename V::Int b, typename V::Int c,
                                      typename V::Int d, typename V::Int wx, typename V::Int wy) {
    auto both = mix<V>(mix<V>(a, b, wx), mix<V>(c, d, wx), wy);
    return V::template shift_right<16>(V::add(both, V::set(1 << 15)));
}

template <class V, bool kAlphaOnly, bool kSmooth>
KINORA_INLINE Channels<V> texel(const SpanPaint& paint, int at) {
    const SpanTexels& t = paint.texture;
    const auto fetch = [&t](typename V::Int index) {
        return kAlphaOnly ? V::gather8(t.texels, index) : V::gather32(t.texels, index);
    };
    const auto u = V::round(along<V>(paint.u, paint.u_dx, at));
    const auto v = V::round(along<V>(paint.v, paint.v_dx, at));
    const auto white = V::set(255), width = V::set(t.width);
    if constexpr (!kSmooth) {
        auto x = clamped<V>(V::template shift_signed<8>(V::add(u, V::set(128))), t.width);
        auto y = clamped<V>(V::template shift_signed<8>(V::add(v, V::set(128))), t.height);
        auto found = fetch(V::add(V::mul(y, width), x));
        if constexpr (kAlphaOnly) return {{white, white, white, found}};
        return unpack<V>(found);
    } else {
        const auto one = V::set(1), low = V::set(255);
        const auto left = V::template shift_signed<8>(u), top = V::template shift_signed<8>(v);
        const auto wx = V::bits_and(u, low), wy = V::bits_and(v, low);
        const auto x0 = clamped<V>(left, t.width), x1 = clamped<V>(V::add(left, one), t.width);
        const auto y0 = V::mul(clamped<V>(top, t.height), width);
        const auto y1 = V::mul(clamped<V>(V::add(top, one), t.height), width);
        const auto a = fetch(V::add(y0, x0)), b = fetch(V::add(y0, x1));
        const auto c = fetch(V::add(y1, x0)), d = fetch(V::add(y1, x1));
        if constexpr (kAlphaOnly) {
            return {{white, white, white, between<V>(a, b, c, d, wx, wy)}};
        } else {
            const auto pa = unpack<V>(a), pb = unpack<V>(b), pc = unpack<V>(c), pd = unpack<V>(d);
            Channels<V> out;
#pragma GCC unroll 4
            for (int i = 0; i < 4; ++i)
                out.c[i] = between<V>(pa.c[i], pb.c[i], pc.c[i], pd.c[i], wx, wy);
            return out;
        }
    }
}

template <class V>
KINORA_INLINE Channels<V> modulate(const Channels<V>& a, const Channels<V>& b) {
    Channels<V> out;
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) out.c[i] = over_255<V>(V::mul(a.c[i], b.c[i]));
    return out;
}

// Blends source(at) over the pixels, V::kLanes at a time.
template <class V, class Source>
KINORA_INLINE void each(uint32_t* pixels, int count, Source source) {
    int at = 0;
    for (; at + V::kLanes <= count; at += V::kLanes)
        V::store(pixels + at, blend<V>(source(at), V::load(pixels + at)));
    if (at < count)
        V::store_some(pixels + at, count - at,
                      blend<V>(source(at), V::load_some(pixels + at, count - at)));
}

template <class V>
void solid_span(uint32_t* pixels, int count, uint32_t rgba) {
    if (rgba >> 24 == 255) {
        for (int i = 0; i < count; ++i) pixels[i] = rgba;
        return;
    }
    const auto source = unpack<V>(V::set(static_cast<int>(rgba)));
    each<V>(pixels, count, [&](int) { return source; });
}

template <class V>
void masked_span(uint32_t* pixels, int count, const uint8_t* mask, uint32_t rgba) {
    auto source = unpack<V>(V::set(static_cast<int>(rgba)));
    const auto alpha = source.c[3];
    each<V>(pixels, count, [&](int at) {
        const int some = count - at < V::kLanes ? count - at : V::kLanes;
        source.c[3] = over_255<V>(V::mul(alpha, V::load8(mask + at, some)));
        return source;
    });
}

template <class V>
void shaded_span(uint32_t* pixels, int count, const SpanPaint& paint) {
    each<V>(pixels, count, [&](int at) { return vertex_color<V>(paint, at); });
}

template <class V, bool kAlphaOnly, bool kSmooth>
void textured_span_of(uint32_t* pixels, int count, const SpanPaint& paint) {
    each<V>(pixels, count, [&](int at) {
        return modulate<V>(vertex_color<V>(paint, at), texel<V, kAlphaOnly, kSmooth>(paint, at));
    });
}

template <class V>
void textured_span(uint32_t* pixels, int count, const SpanPaint& paint) {
    const SpanTexels& t = paint.texture;
    if (t.alpha_only)
        t.smooth ? textured_span_of<V, true, true>(pixels, count, paint)
                 : textured_span_of<V, true, false>(pixels, count, paint);
    else
        t.smooth ? textured_span_of<V, false, true>(pixels, count, paint)
                 : textured_span_of<V, false, false>(pixels, count, paint);
}

template <class V>
constexpr SpanKernel make_spans(const char* name) {
    return {name, solid_span<V>, masked_span<V>, shaded_span<V>, textured_span<V>};
}

}  // namespace
}  // namespace kinora::play
