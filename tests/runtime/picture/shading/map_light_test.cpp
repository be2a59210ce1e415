// tests/runtime/picture/shading/map_light_test.cpp: light of environment maps against sums over
// their texels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/picture/shading/sun_map.h"
#include "tests/runtime/ray_scenes.h"

namespace kinora {
namespace {

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
