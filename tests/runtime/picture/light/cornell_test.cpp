// tests/runtime/picture/light/cornell_test.cpp: a box with coloured walls, a block and a lamp on
// geometry: three bounces of light, by region, against paths in double precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/runtime/picture/light/lamp_classes.h"
#include "tests/runtime/picture/light/path_tracer.h"

namespace kinora {
namespace {

constexpr uint32_t kBounces = 3;
constexpr int kPixels = 32, kSide = 4, kRegions = kSide * kSide;  // a region has 8 x 8 pixels
constexpr double kEye = 0.9, kRadiance = 10;
const double kSlope = std::tan(kPi / 6);  // of a view of 60 degrees, from the eye along -z

// The room [-1,1]^3 with a red and a green wall, a block on its floor, and the lamp below its
// ceiling, which looks down.
const PathWall kLampWall = {1, 0.98, {-0.3, -0.3}, {0.3, 0.3}, dvec3(0.0), kRadiance, -1};
std::vector<PathWall> room() {
    const dvec3 grey(0.7), red(0.7, 0.1, 0.1), green(0.1, 0.6, 0.1);
    const dvec2 low(-1), high(1);
    return {
        kLampWall,
        {0, -1, low, high, red},
        {0, 1, low, high, green},
        {1, -1, low, high, grey},
        {1, 1, low, high, grey},
        {2, -1, low, high, grey},
        {2, 1, low, high, grey},
        // The block [-0.5,0.1] x [-1,-0.2] x [-0.7,-0.1].
        {0, -0.5, {-1, -0.7}, {-0.2, -0.1}, grey},
        {0, 0.1, {-1, -0.7}, {-0.2, -0.1}, grey},
        {1, -0.2, {-0.7, -0.5}, {-0.1, 0.1}, grey},
        {2, -0.7, {-0.5, -1}, {0.1, -0.2}, grey},
        {2, -0.1, {-0.5, -1}, {0.1, -0.2}, grey},
    };
}

dvec3 corner_of(const PathWall& wall, double x, double y) {
    dvec3 at(0.0);
    at[wall.axis] = wall.at;
    at[(wall.axis + 1) % 3] = x;
    at[(wall.axis + 2) % 3] = y;
    return at;
}

void add_wall(SceneText& scene, const PathWall& wall, size_t number) {
    const std::string id = fmt::format("wall{}", number);
    const dvec2 low = wall.low, high = wall.high;
    std::vector<int> triangles = {0, 1, 2, 0, 2, 3};  // its front looks along the axis
    if (wall.shines < 0) triangles = {0, 2, 1, 0, 3, 2};
    scene.mesh(id,
               {corner_of(wall, low.x, low.y), corner_of(wall, high.x, low.y),
                corner_of(wall, high.x, high.y), corner_of(wall, low.x, high.y)},
               triangles);
    if (wall.shines != 0)
        scene.look(id + "-look", geometry_lamp((high.x - low.x) * (high.y - low.y), wall.radiance),
                   "<shader stage=\"LIGHT\"/>");
    else
        scene.look(id + "-look",
                   fmt::format("surface wall() {{ normal n = faceforward(normalize(N), I); Oi = 1;"
                               " Ci = color({}, {}, {}) * (diffuse(n) +"
                               " indirectdiffuse(P, n, 1)); }}",
                               wall.albedo.x, wall.albedo.y, wall.albedo.z));
    scene.place(id, id + "-look");
}

SceneText cornell() {
    SceneText scene;
    scene.cameras = R"(<camera id="eye"><optics><technique_common><perspective><yfov>60</yfov>
        <aspect_ratio>1</aspect_ratio><znear>0.01</znear><zfar>100</zfar>
        </perspective></technique_common></optics></camera>)";
    look_from_below(scene, kEye);
    const std::vector<PathWall> walls = room();
    for (size_t k = 0; k < walls.size(); ++k) add_wall(scene, walls[k], k);
    return scene;
}

// Sums over repeated estimates of a region's light.
struct Estimates {
    int count = 0;
    dvec3 sum{0.0}, squares{0.0};
    void add(dvec3 value) {
        ++count;
        sum += value;
        squares += value * value;
    }
    dvec3 mean() const { return sum / double(count); }
    dvec3 error2() const {  // of the mean
        return (squares / double(count) - mean() * mean()) / double(count - 1);
    }
};

using Regions = std::array<Estimates, kRegions>;

// Of so many runs, each of paths through all places of the picture.
Regions traced() {
    constexpr int kRuns = 64, kPathsOfRegion = 4000;
    Regions regions;
    PathTracer tracer(room(), 0, int(kBounces), 7);
    for (int run = 0; run < kRuns; ++run)
        for (int region = 0; region < kRegions; ++region) {
            dvec3 sum(0.0);
            for (int k = 0; k < kPathsOfRegion; ++k) {
                const double x = (region % kSide + tracer.number()) * 2 / kSide - 1;
                const double y = 1 - (region / kSide + tracer.number()) * 2 / kSide;
                sum += tracer.path({0, 0, kEye}, {x * kSlope, y * kSlope, -1}) /
                       double(kPathsOfRegion);
            }
            regions[size_t(region)].add(sum);
        }
    return regions;
}

Regions rendered() {
    constexpr int kSeeds = 16, kOfRegion = kPixels / kSide;
    SceneOptions options;
    options.lights = LightSet::Scene;
    options.quality.diffuse_depth = kBounces;
    options.quality.light_samples = 1;
    Rendering r(cornell().text(), options);
    r.settings.integrator.samples_per_pixel = 64;
    Regions regions;
    for (int seed = 0; seed < kSeeds; ++seed) {
        r.settings.integrator.seed = uint32_t(seed);
        r.frame(kPixels, kPixels);
        std::array<dvec3, kRegions> sums{};
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x)
                sums[size_t(y / kOfRegion * kSide + x / kOfRegion)] +=
                    dvec3(r.color(x, y)) / double(kOfRegion * kOfRegion);
        for (size_t k = 0; k < kRegions; ++k) regions[k].add(sums[k]);
    }
    EXPECT_EQ(r.findings(), "");
    return regions;
}

TEST(CornellBox, HasTheLightOfPathsInDoublePrecision) {
    const Regions got = rendered(), want = traced();
    for (size_t region = 0; region < kRegions; ++region)
        for (int k = 0; k < 3; ++k) {
            const double is = got[region].mean()[k], be = want[region].mean()[k];
            const double error = std::sqrt(got[region].error2()[k] + want[region].error2()[k]);
            EXPECT_GT(be, 0) << region;
            EXPECT_LT(error, 0.01 * be) << region;  // else nothing would be noticed
            EXPECT_LT(std::abs(is - be), 4 * error)
                << "region " << region << " component " << k << ": " << is << " not " << be;
        }
}

}  // namespace
}  // namespace kinora
