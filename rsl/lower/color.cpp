// rsl/lower/color.cpp: colors between rgb, hsv, hsl, xyz, xyY and YIQ. A grey has hue 0
// (docs/numerics.md#colors).
#include <algorithm>

#include "rsl/lower/values.h"
#include "rsl/model/color_matrices.h"
#include "rsl/text/literal_names.h"

namespace kinora::rsl {

namespace {

V3 by_matrix(Emitter& e, const V3& v, const ColorMatrix& m) {
    V3 r;
    for (size_t i = 0; i < 3; ++i)
        r[i] = e.fma(v[0], e.f(float(m[i][0])),
                     e.fma(v[1], e.f(float(m[i][1])), e.mul(v[2], e.f(float(m[i][2])))));
    return r;
}

struct Range {
    Value low, high, width;
};

Range range_of(Emitter& e, const V3& c) {
    Value low = e.b.min(e.b.min(c[0], c[1]), c[2]);
    Value high = e.b.max(e.b.max(c[0], c[1]), c[2]);
    return {low, high, e.b.sub(high, low)};
}

// Sixths of a turn from red, as 0..1.
Value hue(Emitter& e, const V3& c, const Range& r) {
    auto& b = e.b;
    Value red = e.div(b.sub(c[1], c[2]), r.width);
    Value green = b.add(e.f(2), e.div(b.sub(c[2], c[0]), r.width));
    Value blue = b.add(e.f(4), e.div(b.sub(c[0], c[1]), r.width));
    Value h = b.select(b.eq(c[0], r.high), red, b.select(b.eq(c[1], r.high), green, blue));
    h = b.div(h, e.f(6));
    h = b.select(b.lt(h, e.f(0)), b.add(h, e.f(1)), h);
    return b.select(b.lt(e.f(0), r.width), h, e.f(0));
}

// The rgb of a hue at full saturation: ramps |6h - 3| - 1, 2 - |6h - 2|, 2 - |6h - 4| in 0..1.
V3 pure_hue(Emitter& e, Value h) {
    auto& b = e.b;
    Value six = b.mul(b.sub(h, b.floor(h)), e.f(6));
    auto ramp = [&](float from, float sign, float offset) {
        Value d = b.abs(b.sub(six, e.f(from)));
        return e.clamp(b.fma(e.f(sign), d, e.f(offset)), e.f(0), e.f(1));
    };
    return {ramp(3, 1, -1), ramp(2, -1, 2), ramp(4, -1, 2)};
}

V3 hsv_from_rgb(Emitter& e, const V3& c) {
    Range r = range_of(e, c);
    return {hue(e, c, r), e.div(r.width, r.high), r.high};
}
V3 rgb_from_hsv(Emitter& e, const V3& c) {
    V3 pure = pure_hue(e, c[0]);
    V3 white = e.f3(1);
    return e.scale(e.fma(e.sub(pure, white), c[1], white), c[2]);
}

V3 hsl_from_rgb(Emitter& e, const V3& c) {
    auto& b = e.b;
    Range r = range_of(e, c);
    Value sum = b.add(r.high, r.low);
    Value room = b.select(b.le(sum, e.f(1)), sum, b.sub(e.f(2), sum));
    return {hue(e, c, r), e.div(r.width, room), b.mul(sum, e.f(0.5f))};
}
V3 rgb_from_hsl(Emitter& e, const V3& c) {
    auto& b = e.b;
    Value chroma = b.mul(b.sub(e.f(1), b.abs(b.fma(e.f(2), c[2], e.f(-1)))), c[1]);
    V3 half = e.f3(0.5f);
    V3 grey = {c[2], c[2], c[2]};
    return e.fma(e.sub(pure_hue(e, c[0]), half), chroma, grey);
}

V3 xyz_from_rgb(Emitter& e, const V3& c) {
    return by_matrix(e, c, kXyzFromRgb);
}
V3 rgb_from_xyz(Emitter& e, const V3& c) {
    return by_matrix(e, c, kRgbFromXyz);
}
V3 xyY_from_rgb(Emitter& e, const V3& c) {
    V3 xyz = xyz_from_rgb(e, c);
    Value sum = e.b.add(e.b.add(xyz[0], xyz[1]), xyz[2]);
    return {e.div(xyz[0], sum), e.div(xyz[1], sum), xyz[1]};
}
V3 rgb_from_xyY(Emitter& e, const V3& c) {
    Value scale = e.div(c[2], c[1]);
    Value z = e.b.sub(e.b.sub(e.f(1), c[0]), c[1]);
    return rgb_from_xyz(e, {e.mul(c[0], scale), c[2], e.mul(z, scale)});
}
V3 yiq_from_rgb(Emitter& e, const V3& c) {
    return by_matrix(e, c, kYiqFromRgb);
}
V3 rgb_from_yiq(Emitter& e, const V3& c) {
    return by_matrix(e, c, kRgbFromYiq);
}
V3 same(Emitter&, const V3& c) {
    return c;
}

// Names are in any letter case.
bool same_name(std::string_view lower_case, std::string_view name) {
    auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
    return std::equal(lower_case.begin(), lower_case.end(), name.begin(), name.end(),
                      [&](char a, char b) { return a == lower(b); });
}

struct ColorSpace {
    std::string_view name;  // in lower case
    V3 (*from_rgb)(Emitter&, const V3&);
    V3 (*to_rgb)(Emitter&, const V3&);
};
const ColorSpace kSpaces[] = {
    {"rgb", same, same},
    {"hsv", hsv_from_rgb, rgb_from_hsv},
    {"hsl", hsl_from_rgb, rgb_from_hsl},
    {"xyz", xyz_from_rgb, rgb_from_xyz},
    {"xyy", xyY_from_rgb, rgb_from_xyY},
    {"yiq", yiq_from_rgb, rgb_from_yiq},
};

}  // namespace

bool is_color_space(std::string_view name) {
    return std::any_of(std::begin(kSpaces), std::end(kSpaces),
                       [&](const ColorSpace& space) { return same_name(space.name, name); });
}

std::vector<std::string_view> color_space_names() {
    std::vector<std::string_view> names;
    for (const ColorSpace& space : kSpaces) names.push_back(space.name);
    return names;
}

Lowered color_space(Emitter& e, LoweringContext& context, const Lowered& color,
                    std::string_view from, std::string_view to, Location where) {
    auto find = [&](std::string_view name) -> const ColorSpace* {
        for (const ColorSpace& space : kSpaces)
            if (same_name(space.name, name)) return &space;
        context.error(Code::RSL_COLOR_SPACE_UNKNOWN, where, name);
        return nullptr;
    };
    const ColorSpace* source = find(from);
    const ColorSpace* target_space = find(to);
    if (!source || !target_space || source == target_space) return color;
    V3 rgb = source->to_rgb(e, color.v3());
    return lowered(BaseType::Color, target_space->from_rgb(e, rgb));
}

}  // namespace kinora::rsl
