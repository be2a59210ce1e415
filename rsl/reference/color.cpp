// rsl/reference/color.cpp: colors between rgb, hsv, hsl, xyz, xyY and YIQ, at one
// point. A grey has hue 0 (docs/numerics.md#colors).
#include <algorithm>
#include <cctype>

#include "rsl/model/color_matrices.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace {

template <class Real>
Vec<Real> times(const ColorMatrix& m, const Vec<Real>& a) {
    Vec<Real> r;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) r[i] = r[i] + Real(m[i][j]) * a[j];
    return r;
}

template <class Real>
Dual<Real> hue(Reference<Real>& eval, const Vec<Real>& c, const Dual<Real>& high,
               const Dual<Real>& width) {
    if (eval.decide(!(width.x > 0))) return {};
    int largest = eval.decide(c[0].x == high.x ? 0 : c[1].x == high.x ? 1 : 2);
    size_t a = size_t(largest + 1) % 3, b = size_t(largest + 2) % 3;
    Dual<Real> h = Real(1 / 6.) * ((c[a] - c[b]) / width + Dual<Real>(Real(2 * largest)));
    return eval.decide(h.x < 0) ? h + Dual<Real>(1) : h;
}

// Foley and van Dam's hexcone: what each channel has at full saturation and value.
template <class Real>
Vec<Real> hexcone(Reference<Real>& eval, const Dual<Real>& h) {
    Dual<Real> six = Real(6) * (h - Dual<Real>(eval.decide(std::floor(h.x))));
    Vec<Real> rgb;
    for (int k = 0; k < 3; ++k) {
        // How far the hue is around the circle from the channel's own, 0 .. 3 sixths.
        Dual<Real> away = abs(six - Dual<Real>(Real(2 * k)));
        if (away.x > 3) away = Dual<Real>(6) - away;
        rgb[size_t(k)] = clamp(Dual<Real>(2) - away, Dual<Real>(0), Dual<Real>(1));
    }
    return rgb;
}

template <class Real>
Vec<Real> from_rgb(Reference<Real>& eval, const Vec<Real>& c, std::string_view to) {
    using Number = Dual<Real>;
    Number high = max(max(c[0], c[1]), c[2]), low = min(min(c[0], c[1]), c[2]);
    Number width = high - low;
    if (to == "hsv") return {hue(eval, c, high, width), width / high, high};
    if (to == "hsl") {
        Number sum = high + low;
        Number room = eval.decide(sum.x <= 1) ? sum : Number(2) - sum;
        return {hue(eval, c, high, width), width / room, Real(0.5) * sum};
    }
    if (to == "YIQ") return times(kYiqFromRgb, c);
    if (to == "xyz" || to == "XYZ") return times(kXyzFromRgb, c);
    if (to == "xyY") {
        Vec<Real> xyz = times(kXyzFromRgb, c);
        Number sum = xyz[0] + xyz[1] + xyz[2];
        return {xyz[0] / sum, xyz[1] / sum, xyz[1]};
    }
    return c;
}

template <class Real>
Vec<Real> to_rgb(Reference<Real>& eval, const Vec<Real>& c, std::string_view from) {
    using Number = Dual<Real>;
    if (from == "hsv") {
        Vec<Real> pure = hexcone(eval, c[0]), white = {Number(1), Number(1), Number(1)};
        return c[2] * (white + c[1] * (pure - white));
    }
    if (from == "hsl") {
        Number chroma = (Number(1) - abs(Real(2) * c[2] - Number(1))) * c[1];
        Number half(Real(0.5));
        Vec<Real> pure = hexcone(eval, c[0]), middle = {half, half, half},
                  grey = {c[2], c[2], c[2]};
        return grey + chroma * (pure - middle);
    }
    if (from == "YIQ") return times(kRgbFromYiq, c);
    if (from == "xyz" || from == "XYZ") return times(kRgbFromXyz, c);
    if (from == "xyY") {
        Number k = c[2] / c[1];
        return times<Real>(kRgbFromXyz, {k * c[0], c[2], k * (Number(1) - c[0] - c[1])});
    }
    return c;
}

}  // namespace

template <class Real>
Vec<Real> Reference<Real>::color_space(const Vec<Real>& color, const std::string& from,
                                       const std::string& to) {
    auto name = [](std::string text) {
        for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
        return text == "xyy" ? "xyY" : text == "yiq" ? "YIQ" : text;
    };
    if (name(from) == name(to)) return color;
    return from_rgb(*this, to_rgb(*this, color, name(from)), name(to));
}
template Vec<float> Reference<float>::color_space(const Vec<float>&, const std::string&,
                                                  const std::string&);
template Vec<double> Reference<double>::color_space(const Vec<double>&, const std::string&,
                                                    const std::string&);

}  // namespace kinora::rsl
