// runtime/picture/compare/errors.cpp: errors of pictures, pixel by pixel and by structure.
#include "runtime/picture/compare/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/base/check.h"
#include "runtime/picture/compare/flip.h"

namespace kinora {

namespace {

constexpr double kMostKeptPixels = 4e6;  // of a reference's exposures: 40 bytes each

bool finite(const vec4& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w);
}

// The picture with black where it is not finite; counts such pixels.
std::vector<vec4> finite_pixels(const PictureView& picture, size_t& broken) {
    std::vector<vec4> pixels(picture.rgba.begin(), picture.rgba.end());
    for (vec4& c : pixels) {
        if (finite(c)) continue;
        ++broken;
        c = vec4(0, 0, 0, 1);
    }
    return pixels;
}

void add_differences(const PictureView& picture, const PictureView& reference, PictureErrors& e) {
    constexpr double kDark = 0.01;
    double squares = 0, relative = 0, encoded = 0;
    size_t uncovered = 0;
    for (size_t i = 0; i < reference.rgba.size(); ++i) {
        const vec4 &a = picture.rgba[i], &b = reference.rgba[i];
        uncovered += (a.w >= 0.5f) != (b.w >= 0.5f);
        for (int k = 0; k < 3; ++k) {
            double x = double(a[k]), r = double(b[k]), d = x - r;
            squares += d * d;
            relative += d * d / (r * r + kDark);
            double shown = encode_srgb(x) - encode_srgb(r);
            encoded += shown * shown;
            e.max_error = std::max(e.max_error, std::abs(d));
        }
    }
    double pixels = double(std::max<size_t>(reference.rgba.size(), 1)), numbers = 3 * pixels;
    e.mask_mismatch = double(uncovered) / pixels;
    e.rmse = std::sqrt(squares / numbers);
    e.relative_mse = relative / numbers;
    e.psnr =
        encoded > 0 ? -10 * std::log10(encoded / numbers) : std::numeric_limits<double>::infinity();
}

Plane product(const Plane& a, const Plane& b) {
    Plane result(a.width, a.height);
    for (size_t i = 0; i < a.size(); ++i) result[i] = a[i] * b[i];
    return result;
}

}  // namespace

double encode_srgb(double linear) {
    double x = std::clamp(linear, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

Plane encoded_luma(const PictureView& picture) {
    Plane luma(picture.width, picture.height);
    for (size_t i = 0; i < luma.size(); ++i) {
        const vec4& c = picture.rgba[i];
        luma[i] = 0.2126 * encode_srgb(double(c.x)) + 0.7152 * encode_srgb(double(c.y)) +
                  0.0722 * encode_srgb(double(c.z));
    }
    return luma;
}

double ssim(const Plane& a, const Plane& b) {
    CHECK_EQ(a.size(), b.size());
    constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
    Kernel1 kernel = gaussian_kernel(1.5, 5);
    double sum = 0;
    for (double w : kernel) sum += w;
    for (double& w : kernel) w /= sum;
    auto local = [&](const Plane& plane) { return convolve(plane, kernel, kernel); };
    Plane mean_a = local(a), mean_b = local(b);
    Plane aa = local(product(a, a)), bb = local(product(b, b)), ab = local(product(a, b));
    Plane map(a.width, a.height);
    for (size_t i = 0; i < a.size(); ++i) {
        double ma = mean_a[i], mb = mean_b[i];
        double va = aa[i] - ma * ma, vb = bb[i] - mb * mb, vab = ab[i] - ma * mb;
        map[i] =
            (2 * ma * mb + kC1) * (2 * vab + kC2) / ((ma * ma + mb * mb + kC1) * (va + vb + kC2));
    }
    return map.size() ? mean(map) : 1;
}

double mean(const Plane& plane) {
    double sum = 0;
    for (double value : plane.values) sum += value;
    return plane.size() ? sum / double(plane.size()) : 0;
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    size_t rank = size_t(std::ceil(share * double(values.size())));
    auto at = values.begin() + ptrdiff_t(std::clamp<size_t>(rank, 1, values.size()) - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

ReferencePicture::ReferencePicture(const PictureView& reference)
    : width_(reference.width), height_(reference.height) {
    size_t broken = 0;
    pixels_ = finite_pixels(reference, broken);
    luma_ = encoded_luma(view());
    flip_ = flip_view(view());
    if (double(flip_exposures(view()).count) * double(pixels_.size()) <= kMostKeptPixels)
        hdr_ = hdr_flip_views(view());
}

PictureErrors ReferencePicture::errors_of(const PictureView& picture, Plane* map) const {
    CHECK_EQ(picture.width, width_);
    CHECK_EQ(picture.height, height_);
    PictureErrors e;
    const std::vector<vec4> pixels = finite_pixels(picture, e.non_finite);
    const PictureView finite{picture.width, picture.height, pixels};
    add_differences(finite, view(), e);
    e.ssim = ssim(encoded_luma(finite), luma_);
    Plane flip = ldr_flip(flip_view(finite), flip_);
    e.flip = mean(flip);
    e.flip_p99 = percentile(flip.values, 0.99);
    e.hdr_flip = mean(hdr_.views.empty() ? hdr_flip(finite, view()) : hdr_flip(finite, hdr_));
    if (map) *map = std::move(flip);
    return e;
}

PictureErrors picture_errors(const PictureView& picture, const PictureView& reference, Plane* map) {
    return ReferencePicture(reference).errors_of(picture, map);
}

}  // namespace kinora
