// tests/runtime/picture/shading/map_light_test.cpp: light of environment maps against sums over
// their texels.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "runtime/scene/images/image_io.h"
#include "tests/runtime/ray_scenes.h"

namespace kinora {
namespace {

constexpr int kWidth = 256, kHeight = 128;

// A map as long as the object lives: a smooth sky over a dim ground, and a sun `wide` texels wide
// whose light is `peak` times the map's mean.
struct SunMap {
    SunMap(double peak, int wide, int row) : texels(size_t(kWidth) * kHeight) {
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double up = direction(x, y).y, turn = 2 * kPi * x / kWidth;
                at(x, y) = up > 0 ? 0.4 + up + 0.2 * std::cos(turn) : 0.15;
            }
        // The mean counts the sun: m = (rest + peak m share) / 1.
        double rest = 0, share = 0, all = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const bool sun = in_sun(x, y, wide, row);
                all += solid_angle(y);
                (sun ? share : rest) += solid_angle(y) * (sun ? 1 : at(x, y));
            }
        const double mean = rest / all / (1 - peak * share / all);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                if (in_sun(x, y, wide, row)) at(x, y) = peak * mean;
        write();
    }
    ~SunMap() { std::filesystem::remove(path); }

    static bool in_sun(int x, int y, int wide, int row) {
        return x >= 170 && x < 170 + wide && y >= row && y < row + wide;
    }
    // Of a texel's middle: y is up, the centre looks along +z, +x lies left of it.
    static dvec3 direction(double x, double y) {
        const double theta = kPi * (y + 0.5) / kHeight, s = (x + 0.5) / kWidth;
        const double phi = 2 * kPi * (s - 0.25);
        return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
    }
    static double solid_angle(int y) {
        return 2 * kPi / kWidth * (std::cos(kPi * y / kHeight) - std::cos(kPi * (y + 1) / kHeight));
    }
    double& at(int x, int y) { return texels[size_t(y) * kWidth + size_t(x)]; }

    // The mean light over the hemisphere of n by cosine: the integral of what lies between texels'
    // middles, by 16 looks a texel.
    double irradiance(dvec3 n) const {
        constexpr int kLooks = 4;
        double sum = 0;
        for (int y = 0; y < kHeight * kLooks; ++y)
            for (int x = 0; x < kWidth * kLooks; ++x) {
                const double tx = (x + 0.5) / kLooks - 0.5, ty = (y + 0.5) / kLooks - 0.5;
                const dvec3 d = direction(tx, ty);
                const double across = kPi / (kHeight * kLooks) * 2 * kPi / (kWidth * kLooks);
                sum += std::max(0.0, glm::dot(d, n)) * between(tx, ty) * std::sqrt(1 - d.y * d.y) *
                       across;
            }
        return sum / kPi;
    }

    std::vector<double> texels;
    std::string name = fmt::format("kinora_map_light_test_{}_{}.exr", getpid(), number++);
    std::filesystem::path path = std::filesystem::temp_directory_path() / name;

  private:
    double between(double x, double y) const {
        const double left = std::floor(x), top = std::floor(y), u = x - left, v = y - top;
        auto texel = [&](double i, double j) {
            const int column = (int(i) + kWidth) % kWidth;
            const int row = std::clamp(int(j), 0, kHeight - 1);
            return texels[size_t(row) * kWidth + size_t(column)];
        };
        return (1 - v) * ((1 - u) * texel(left, top) + u * texel(left + 1, top)) +
               v * ((1 - u) * texel(left, top + 1) + u * texel(left + 1, top + 1));
    }
    void write();
    static inline int number = 0;
};

void SunMap::write() {
    raytrace::Film film;
    film.resize(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) film.at(x, y) = vec4(vec3(float(at(x, y))), 1);
    EXPECT_EQ(
        write_image(path.string(), film, ColorEncoding::Linear, {}, nullptr, PictureDepth::Float),
        "");
}

// What three ways to sum a map over the hemisphere of +z give: a map alone, a map behind rays that
// meet nothing, solid angles.
std::string three_sums(const std::string& map, int samples) {
    return floor_code(fmt::format(
        "color c = 0, sum = 0; float angle = 0; vector way = 0;"
        " gather(\"environment:{0}\", P, n, PI/2, {1}, \"environment:color\", c,"
        " \"environment:solidangle\", angle, \"environment:direction\", way)"
        " sum += c * angle * max(normalize(way) . n, 0) / PI;"
        " Ci = color(comp(indirectdiffuse(\"{0}\", n, {1}), 0),"
        " comp(indirectdiffuse(P, n, {1}, \"environmentmap\", \"{0}\"), 0), comp(sum, 0));",
        map, samples));
}

struct MapLight : testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Peaks, MapLight, testing::Values(40.0, 800.0, 3700.0));

TEST_P(MapLight, HasTheSameMeanForAnyNumberOfSamples) {
    SunMap map(GetParam(), GetParam() < 100 ? 8 : 2, 40);
    const double truth = map.irradiance({0, 0, 1});
    for (int samples : {1, 3, 4, 16, 256}) {
        SceneText scene;
        scene.square("floor", 1.5).look("floor-look", three_sums(map.name, samples));
        scene.place("floor", "floor-look");
        Rendering r(scene.text());
        r.settings.integrator.samples_per_pixel = std::max(1, 4096 / samples);
        r.frame(4, 4);
        dvec3 mean(0.0);
        for (int k = 0; k < 16; ++k) mean += dvec3(r.color(k % 4, k / 4)) / 16.0;
        for (int way = 0; way < 3; ++way)
            EXPECT_NEAR(mean[way] / truth, 1, 0.005) << samples << " samples, way " << way;
        EXPECT_EQ(r.findings(), "");
    }
}

TEST_P(MapLight, HasLittleNoise) {
    SunMap map(GetParam(), GetParam() < 100 ? 8 : 2, 40);
    const double truth = map.irradiance({0, 0, 1});
    SceneText scene;
    scene.square("floor", 1.5).look("floor-look", three_sums(map.name, 16));
    scene.place("floor", "floor-look");
    Rendering r(scene.text());
    r.frame(64, 64);
    dvec3 square(0.0);
    for (int k = 0; k < 4096; ++k) {
        const dvec3 off = dvec3(r.color(k % 64, k / 64)) / truth - 1.0;
        square += off * off / 4096.0;
    }
    for (int way = 0; way < 3; ++way) EXPECT_LT(std::sqrt(square[way]), 0.3) << way;
}

}  // namespace
}  // namespace kinora
