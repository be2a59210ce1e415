// runtime/picture/compare/flip.cpp: LDR-FLIP; the constants are those of section 4 of the 2020
// paper.
#include "runtime/picture/compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/base/check.h"

namespace kinora {

namespace {

constexpr double kColorPower = 0.7;        // q_c
constexpr double kBendAt = 0.4;            // p_c: of the largest colour error ...
constexpr double kBendTo = 0.95;           // p_t: ... becomes this
constexpr double kFeatureDegrees = 0.082;  // w
constexpr double kFeaturePower = 0.5;      // q_f

using Planes = std::array<Plane, 3>;

// Linear sRGB to CIE XYZ and back; columns.
const dmat3 kXyzFromRgb{10135552.0 / 24577794, 2613072.0 / 12288897, 1425312.0 / 73733382,
                        8788810.0 / 24577794,  8788810.0 / 12288897, 8788810.0 / 73733382,
                        4435075.0 / 24577794,  887015.0 / 12288897,  70074185.0 / 73733382};
const dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const dvec3 kWhite = kXyzFromRgb * dvec3(1);

// The opponent space of S-CIELAB, which the contrast sensitivities are measured in.
dvec3 opponent(const dvec3& rgb) {
    dvec3 n = kXyzFromRgb * rgb / kWhite;
    return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}
dvec3 rgb_of_opponent(const dvec3& c) {
    double y = (c.x + 16) / 116;
    return kRgbFromXyz * (dvec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

double lab_curve(double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

Planes opponent_planes(const PictureView& picture) {
    Planes planes{Plane(picture.width, picture.height), Plane(picture.width, picture.height),
                  Plane(picture.width, picture.height)};
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
        dvec3 rgb = glm::clamp(dvec3(picture.rgba[i].x, picture.rgba[i].y, picture.rgba[i].z),
                               dvec3(0), dvec3(1));
        dvec3 c = opponent(rgb);
        for (int k = 0; k < 3; ++k) planes[size_t(k)][i] = c[k];
    }
    return planes;
}

// The contrast sensitivity of a channel as a blur: a sum of Gaussians a sqrt(pi/b) e^(-pi^2 x^2/b),
// x in degrees.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivities[3] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
constexpr double kWidestB = 0.04;  // one radius for all channels

Plane blurred(const Plane& plane, const Sensitivity& s, double ppd) {
    const int radius = int(std::ceil(3 * std::sqrt(kWidestB / (2 * kPi * kPi)) * ppd));
    Plane sum(plane.width, plane.height);
    double weights = 0;
    for (auto [a, b] : {std::pair(s.a1, s.b1), std::pair(s.a2, s.b2)}) {
        if (a == 0) continue;
        Kernel1 kernel = gaussian_kernel(std::sqrt(b / (2 * kPi * kPi)) * ppd, radius);
        double side = 0;
        for (double w : kernel) side += w;
        const double scale = a * std::sqrt(kPi / b);
        weights += scale * side * side;
        Plane part = convolve(plane, kernel, kernel);
        for (size_t i = 0; i < part.size(); ++i) sum[i] += scale * part[i];
    }
    for (double& value : sum.values) value /= weights;
    return sum;
}

// What is seen of a picture at that distance, as Lab after the Hunt effect.
std::vector<dvec3> seen(const Planes& planes, double ppd) {
    Planes blurs;
    for (size_t k = 0; k < 3; ++k) blurs[k] = blurred(planes[k], kSensitivities[k], ppd);
    std::vector<dvec3> colors(planes[0].size());
    for (size_t i = 0; i < colors.size(); ++i) {
        dvec3 rgb = rgb_of_opponent({blurs[0][i], blurs[1][i], blurs[2][i]});
        colors[i] = hunt_lab(glm::clamp(rgb, dvec3(0), dvec3(1)));
    }
    return colors;
}

// The power of the error, its lower part spread to 0..0.95.
double redistributed(double error) {
    const double most = flip_largest_color_error(), bend = kBendAt * most;
    if (error < bend) return kBendTo / bend * error;
    return kBendTo + (error - bend) / (most - bend) * (1 - kBendTo);
}

// Scaled so that its positive weights sum to 1, and its negative ones to -1.
Kernel1 balanced(Kernel1 kernel) {
    double positive = 0, negative = 0;
    for (double w : kernel) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : kernel) w /= w > 0 ? positive : negative;
    return kernel;
}

// How strong edges and points are at each pixel: the lengths of two gradients.
void find_features(const Plane& opponent_y, double ppd, FlipView& view) {
    const double sigma = 0.5 * kFeatureDegrees * ppd;
    const int radius = int(std::ceil(3 * sigma));
    Kernel1 smooth = gaussian_kernel(sigma, radius), edge = smooth, point = smooth;
    double sum = 0;
    for (double w : smooth) sum += w;
    for (double& w : smooth) w /= sum;
    for (int k = -radius; k <= radius; ++k) {
        edge[size_t(k + radius)] *= -k;
        point[size_t(k + radius)] *= double(k) * k / (sigma * sigma) - 1;
    }
    edge = balanced(edge);
    point = balanced(point);
    Plane y(opponent_y.width, opponent_y.height);
    for (size_t i = 0; i < y.size(); ++i) y[i] = (opponent_y[i] + 16) / 116;
    auto gradient = [&](const Kernel1& kernel) {
        Plane dx = convolve(y, kernel, smooth), dy = convolve(y, smooth, kernel);
        for (size_t i = 0; i < dx.size(); ++i) dx[i] = std::hypot(dx[i], dy[i]);
        return dx;
    };
    view.edges = gradient(edge);
    view.points = gradient(point);
}

}  // namespace

double flip_pixels_per_degree(double distance_m, double screen_m, double screen_pixels) {
    return distance_m * screen_pixels / screen_m * kPi / 180;
}

dvec3 hunt_lab(const dvec3& linear_rgb) {
    dvec3 n = kXyzFromRgb * linear_rgb / kWhite;
    double fx = lab_curve(n.x), fy = lab_curve(n.y), fz = lab_curve(n.z);
    double L = 116 * fy - 16;
    return {L, 0.01 * L * 500 * (fx - fy), 0.01 * L * 200 * (fy - fz)};
}

double hyab(const dvec3& a, const dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

double flip_largest_color_error() {
    static const double most =
        std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorPower);
    return most;
}

FlipView flip_view(const PictureView& picture, double ppd) {
    FlipView view;
    const Planes planes = opponent_planes(picture);
    view.colors = seen(planes, ppd);
    find_features(planes[0], ppd, view);
    return view;
}

Plane ldr_flip(const FlipView& a, const FlipView& b) {
    CHECK_EQ(a.edges.width, b.edges.width);
    CHECK_EQ(a.edges.height, b.edges.height);
    Plane flip(a.edges.width, a.edges.height);
    for (size_t i = 0; i < flip.size(); ++i) {
        double color = redistributed(std::pow(hyab(a.colors[i], b.colors[i]), kColorPower));
        double most =
            std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        double feature = std::pow(most / std::sqrt(2.0), kFeaturePower);
        flip[i] = std::clamp(std::pow(std::clamp(color, 0.0, 1.0), 1 - feature), 0.0, 1.0);
    }
    return flip;
}

Plane ldr_flip(const PictureView& a, const PictureView& b, double ppd) {
    return ldr_flip(flip_view(a, ppd), flip_view(b, ppd));
}

}  // namespace kinora
