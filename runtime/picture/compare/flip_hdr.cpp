// runtime/picture/compare/flip_hdr.cpp: HDR-FLIP: LDR-FLIP at several exposures.
#include <algorithm>
#include <cmath>

#include "runtime/picture/compare/flip.h"

namespace kinora {

namespace {

// The ACES curve as the 2021 paper writes it: (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5).
constexpr double kAces[6] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};
constexpr double kBright = 0.85;     // the display value that ends the range of exposures
constexpr double kFullRange = 1e-5;  // instead of a median of 0

double aces(double x) {
    return std::clamp(
        (kAces[0] * x * x + kAces[1] * x + kAces[2]) / (kAces[3] * x * x + kAces[4] * x + kAces[5]),
        0.0, 1.0);
}

// The positive x with aces(x) = kBright.
double scene_value_of_bright() {
    double a = kAces[0] - kBright * kAces[3], b = kAces[1] - kBright * kAces[4],
           c = kAces[2] - kBright * kAces[5];
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

double luminance(const vec4& c) {
    return 0.2126 * double(c.x) + 0.7152 * double(c.y) + 0.0722 * double(c.z);
}

void keep_larger(Plane& worst, const Plane& flip) {
    for (size_t p = 0; p < worst.size(); ++p) worst[p] = std::max(worst[p], flip[p]);
}

std::vector<vec4> exposed(const PictureView& picture, double stops) {
    std::vector<vec4> result(picture.rgba.size());
    const double gain = std::exp2(stops);
    auto shown = [&](float x) { return float(aces(std::max(0.0, gain * double(x)))); };
    for (size_t i = 0; i < result.size(); ++i) {
        const vec4& c = picture.rgba[i];
        result[i] = vec4(shown(c.x), shown(c.y), shown(c.z), c.w);
    }
    return result;
}

}  // namespace

FlipExposures flip_exposures(const PictureView& reference) {
    std::vector<double> values;
    for (const vec4& c : reference.rgba) values.push_back(std::max(0.0, luminance(c)));
    if (values.empty()) return {};
    auto middle = values.begin() + ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const double median = std::max(*middle, kFullRange);
    const double most = std::max(*std::max_element(values.begin(), values.end()), median);
    const double bright = scene_value_of_bright();
    FlipExposures e{std::log2(bright / most), std::log2(bright / median), 2};
    e.count = std::max(2, int(std::ceil(e.last - e.first)));
    return e;
}

HdrFlipViews hdr_flip_views(const PictureView& reference, double ppd) {
    HdrFlipViews made{flip_exposures(reference), {}};
    for (int i = 0; i < made.exposures.count; ++i) {
        std::vector<vec4> shown = exposed(reference, made.exposures.at(i));
        made.views.push_back(flip_view({reference.width, reference.height, shown}, ppd));
    }
    return made;
}

Plane hdr_flip(const PictureView& picture, const HdrFlipViews& reference, double ppd) {
    Plane worst(picture.width, picture.height);
    for (size_t i = 0; i < reference.views.size(); ++i) {
        std::vector<vec4> shown = exposed(picture, reference.exposures.at(int(i)));
        const FlipView view = flip_view({picture.width, picture.height, shown}, ppd);
        keep_larger(worst, ldr_flip(view, reference.views[i]));
    }
    return worst;
}

// One exposure after the other: views of all take much memory.
Plane hdr_flip(const PictureView& picture, const PictureView& reference, double ppd) {
    const FlipExposures exposures = flip_exposures(reference);
    Plane worst(picture.width, picture.height);
    for (int i = 0; i < exposures.count; ++i) {
        std::vector<vec4> a = exposed(picture, exposures.at(i));
        std::vector<vec4> b = exposed(reference, exposures.at(i));
        keep_larger(worst, ldr_flip({picture.width, picture.height, a},
                                    {picture.width, picture.height, b}, ppd));
    }
    return worst;
}

}  // namespace kinora
