// tests/runtime/picture/shading/sun_map.h: maps of a sky and a sun, and the sums of their light in
// double precision.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "raytrace/tiles/integrator.h"
#include "runtime/base/math.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

inline constexpr int kMapWidth = 256, kMapHeight = 128;

// A map as long as the object lives: a smooth sky over a dim ground, and a sun `wide` texels wide
// whose light is `peak` times the map's mean.
struct SunMap {
    SunMap(double peak, int wide, int row) : texels(size_t(kMapWidth) * kMapHeight) {
        for (int y = 0; y < kMapHeight; ++y)
            for (int x = 0; x < kMapWidth; ++x) {
                const double up = direction(x, y).y, turn = 2 * kPi * x / kMapWidth;
                at(x, y) = up > 0 ? 0.4 + up + 0.2 * std::cos(turn) : 0.15;
            }
        // The mean counts the sun: m = (rest + peak m share) / 1.
        double rest = 0, share = 0, all = 0;
        for (int y = 0; y < kMapHeight; ++y)
            for (int x = 0; x < kMapWidth; ++x) {
                const bool sun = in_sun(x, y, wide, row);
                all += solid_angle(y);
                (sun ? share : rest) += solid_angle(y) * (sun ? 1 : at(x, y));
            }
        const double mean = rest / all / (1 - peak * share / all);
        for (int y = 0; y < kMapHeight; ++y)
            for (int x = 0; x < kMapWidth; ++x)
                if (in_sun(x, y, wide, row)) at(x, y) = peak * mean;
        write();
    }
    ~SunMap() { std::filesystem::remove(path); }

    static bool in_sun(int x, int y, int wide, int row) {
        return x >= 170 && x < 170 + wide && y >= row && y < row + wide;
    }
    // Of a texel's middle: y is up, the centre looks along +z, +x lies left of it.
    static dvec3 direction(double x, double y) {
        const double theta = kPi * (y + 0.5) / kMapHeight, s = (x + 0.5) / kMapWidth;
        const double phi = 2 * kPi * (s - 0.25);
        return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
    }
    static double solid_angle(int y) {
        return 2 * kPi / kMapWidth *
               (std::cos(kPi * y / kMapHeight) - std::cos(kPi * (y + 1) / kMapHeight));
    }
    double& at(int x, int y) { return texels[size_t(y) * kMapWidth + size_t(x)]; }

    // The mean light over the hemisphere of n by cosine: the integral of what lies between texels'
    // middles, by 16 looks a texel.
    double irradiance(dvec3 n) const {
        constexpr int kLooks = 4;
        double sum = 0;
        for (int y = 0; y < kMapHeight * kLooks; ++y)
            for (int x = 0; x < kMapWidth * kLooks; ++x) {
                const double tx = (x + 0.5) / kLooks - 0.5, ty = (y + 0.5) / kLooks - 0.5;
                const dvec3 d = direction(tx, ty);
                const double across = kPi / (kMapHeight * kLooks) * 2 * kPi / (kMapWidth * kLooks);
                sum += std::max(0.0, glm::dot(d, n)) * between(tx, ty) * std::sqrt(1 - d.y * d.y) *
                       across;
            }
        return sum / kPi;
    }

    std::vector<double> texels;
    std::string name = fmt::format("kinora_map_light_test_{}_{}.exr", getpid(), number++);
    std::filesystem::path path = std::filesystem::temp_directory_path() / name;

    // Between four texels' middles.
    double between(double x, double y) const {
        const double left = std::floor(x), top = std::floor(y), u = x - left, v = y - top;
        auto texel = [&](double i, double j) {
            const int column = (int(i) + kMapWidth) % kMapWidth;
            const int row = std::clamp(int(j), 0, kMapHeight - 1);
            return texels[size_t(row) * kMapWidth + size_t(column)];
        };
        return (1 - v) * ((1 - u) * texel(left, top) + u * texel(left + 1, top)) +
               v * ((1 - u) * texel(left, top + 1) + u * texel(left + 1, top + 1));
    }
    void write();

  private:
    static inline int number = 0;
};

inline void SunMap::write() {
    raytrace::Film film;
    film.resize(kMapWidth, kMapHeight);
    for (int y = 0; y < kMapHeight; ++y)
        for (int x = 0; x < kMapWidth; ++x) film.at(x, y) = vec4(vec3(float(at(x, y))), 1);
    EXPECT_EQ(
        write_image(path.string(), film, ColorEncoding::Linear, {}, nullptr, PictureDepth::Float),
        "");
}

}  // namespace kinora
