// tests/raytrace/tile_planes_test.cpp: filters of planes at the edge of a square, against samples
// that are followed one by one in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "raytrace/tiles/integrator.h"
#include "raytrace/sampling.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

constexpr double kEdge = 0.0513;  // the square ends there; x of the plane z = 0
constexpr float kBackground = -7;

// Planes have x of the hit, colours too.
class PlaceLooks final : public SurfaceShading {
  public:
    void shade(const HitBatch& hits, int, ShadeResult& result) override {
        for (size_t k = 0; k < hits.count; ++k) {
            for (int c = 0; c < 3; ++c) {
                result.Ci[c][k] = float(c + 1) * hits.P[0][k];
                result.Oi[c][k] = 1;
            }
            for (float* plane : result.aov) plane[k] = hits.P[0][k];
        }
    }
};

struct EdgePicture {
    Accel accel;
    Camera camera;
    Film film;
    IntegratorSettings settings;
    FilterSampler sampler;

    explicit EdgePicture(int samples, const PixelFilter& filter = pixel_filters()[0])
        : sampler(filter) {
        CameraOptics optics;
        optics.x = radians(60.0);
        dmat4 node(1.0);
        node[3].z = 5;
        make_camera(optics, node, 24, 18, dvec3(0.0), 10, camera);
        settings.samples_per_pixel = samples;
        settings.filter = &filter;
        settings.seed = 5;
    }

    void take() {
        TestMesh square;
        for (auto [x, y] : {std::pair(-50.0, -50.0), {kEdge, -50.0}, {kEdge, 50.0}, {-50.0, 50.0}})
            square.positions.push_back(vec4(float(x), float(y), 0, 0));
        square.triangles = {0, 1, 2, 0, 2, 3};
        std::vector<Geometry> rows{square.geometry(0)};
        accel.update(rows);
        IntegratorScratch scratch;
        IntegratorCounters counters;
        PlaceLooks looks;
        integrate(accel, camera, looks, film, settings, scratch, counters);
    }

    // Where a sample of the pixel lies, from its centre.
    dvec2 offset(int x, int y, int sample) const {
        if (settings.samples_per_pixel == 1) return dvec2(0.0);
        const dvec2 u =
            stratified_sample(uint32_t(sample), hash(uint32_t(x), uint32_t(y), settings.seed));
        return {sampler.offset(u.x), sampler.offset(u.y)};
    }

    // x of the plane z = 0 that the sample sees, where that is on the square.
    std::optional<double> seen(int x, int y, int sample) const {
        const dvec2 at = dvec2(x + 0.5, y + 0.5) + offset(x, y, sample);
        const double width = 2 * 5 * std::tan(radians(30.0));
        const double place = (at.x / 24 - 0.5) * width;
        return place < kEdge ? std::optional(place) : std::nullopt;
    }
};

// What the filters make of a pixel's samples, by their definitions.
struct Wanted {
    double mean = 0, average = kBackground, nearest = 0, least = kBackground, most = kBackground;
    double variance = 0;  // of red
    size_t hits = 0;
};

Wanted wanted(const EdgePicture& picture, int x, int y) {
    const int n = picture.settings.samples_per_pixel;
    std::vector<double> seen, red;
    double nearest = 1e9;
    Wanted want;
    for (int s = 0; s < n; ++s) {
        const std::optional<double> place = picture.seen(x, y, s);
        if (place) seen.push_back(*place);
        red.push_back(place.value_or(0));
        const dvec2 from = picture.offset(x, y, s);
        const double distance = std::hypot(from.x, from.y);
        if (distance >= nearest) continue;
        nearest = distance;
        want.nearest = place.value_or(kBackground);
    }
    want.hits = seen.size();
    double mean_red = 0;
    for (double value : red) mean_red += value / n;
    for (double value : red)
        want.variance += n > 1 ? (value - mean_red) * (value - mean_red) / (n - 1) : 0;
    want.mean = mean_red;
    if (seen.empty()) return want;
    want.average = 0;
    for (double value : seen) want.average += value / double(seen.size());
    want.least = std::ranges::min(seen);
    want.most = std::ranges::max(seen);
    return want;
}

void expect_planes(EdgePicture& picture) {
    const AovFilter filters[] = {AovFilter::Mean, AovFilter::Average, AovFilter::Nearest,
                                 AovFilter::Least, AovFilter::Most};
    for (AovFilter filter : filters) {
        AovPlane& plane = picture.film.add_aov("x", filter);
        plane.background = filter == AovFilter::Mean ? 0 : kBackground;
    }
    picture.film.add_aov("n").origin = AovOrigin::Samples;
    AovPlane& variance = picture.film.add_aov("variance");
    variance.origin = AovOrigin::Variance;
    variance.component = 1;
    picture.take();
    size_t half_covered = 0;
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 24; ++x) {
            const Wanted want = wanted(picture, x, y);
            const size_t at = size_t(y) * 24 + size_t(x);
            const auto got = [&](size_t plane) { return picture.film.aovs[plane].values[at]; };
            EXPECT_NEAR(got(0), want.mean, 1e-5) << x << ' ' << y;
            EXPECT_NEAR(got(1), want.average, 1e-5) << x << ' ' << y;
            EXPECT_NEAR(got(2), want.nearest, 1e-5) << x << ' ' << y;
            EXPECT_NEAR(got(3), want.least, 1e-5) << x << ' ' << y;
            EXPECT_NEAR(got(4), want.most, 1e-5) << x << ' ' << y;
            EXPECT_EQ(got(5), float(picture.settings.samples_per_pixel));
            EXPECT_NEAR(got(6), 4 * want.variance, 1e-5 + 1e-4 * want.variance) << x << ' ' << y;
            half_covered += want.hits > 0 && want.hits < size_t(picture.settings.samples_per_pixel);
        }
    if (picture.settings.samples_per_pixel > 1) {
        EXPECT_GE(half_covered, 12u);
    }
}

TEST(TilePlanes, HaveAFilterEachWithOneSample) {
    EdgePicture picture(1);
    expect_planes(picture);
}

TEST(TilePlanes, HaveAFilterEachWithAnyPixelFilter) {
    for (const PixelFilter& filter : pixel_filters())
        for (int samples : {4, 13, 64}) {
            EdgePicture picture(samples, filter);
            expect_planes(picture);
        }
}

}  // namespace
}  // namespace kinora::raytrace::test
