// tests/raytrace/allocation_test.cpp: after the first frame of a size, a frame allocates nothing.
#include <gtest/gtest.h>

#include "raytrace/tiles/integrator.h"
#include "tests/anim/allocation_count.h"
#include "tests/raytrace/meshes.h"

namespace kinora::raytrace::test {
namespace {

class HalfGrey final : public SurfaceShading {
  public:
    void shade(const HitBatch& hits, int, ShadeResult& result) override {
        for (int c = 0; c < 3; ++c)
            for (size_t k = 0; k < hits.count; ++k) result.Ci[c][k] = result.Oi[c][k] = 0.5f;
    }
};

template <class F>
size_t count_allocations(F&& work) {
    size_t before = allocation_count();
    work();
    return allocation_count() - before;
}

// One thread: what TBB allocates to share work is not ours.
TEST(Allocation, AFrameAllocatesNothingAfterTheFirst) {
    const int threads_before = thread_count();
    set_thread_count(1);
    TestMesh ball = sphere(1, {0, 0, 0}, 100, 100);
    std::vector<Geometry> rows{ball.geometry(1)};
    Accel accel;
    Camera camera;
    CameraOptics optics;
    optics.x = 1;
    dmat4 node(1.0);
    node[3].z = 5;
    make_camera(optics, node, 200, 150, dvec3(0.0), 10, camera);
    Film film;
    film.add_aov("z");
    IntegratorScratch scratch;
    IntegratorCounters counters;
    IntegratorSettings settings;
    settings.samples_per_pixel = 2;
    HalfGrey looks;
    auto frame = [&] {
        accel.update(rows);
        integrate(accel, camera, looks, film, settings, scratch, counters);
    };
    EXPECT_GT(count_allocations(frame), 0u);  // the counter works
    EXPECT_EQ(count_allocations(frame), 0u);
    settings.samples_per_pixel = 5;
    EXPECT_EQ(count_allocations(frame), 0u);
    set_thread_count(threads_before);
}

TEST(Allocation, OfARefitIsEmbreesAlone) {
    const int threads_before = thread_count();
    set_thread_count(1);
    TestMesh mesh = tube(100, 100);
    std::vector<Geometry> rows{mesh.geometry(1, GeometryKind::Deforming)};
    Accel accel;
    accel.update(rows);
    auto move = [&] {
        for (vec4& p : mesh.positions) p.x += 0.001f;
        ++rows[0].positions_version;
        accel.update(rows);
    };
    move();
    const size_t first = count_allocations(move), second = count_allocations(move);
    EXPECT_LE(second, first);
    RecordProperty("allocations", int(second));
    EXPECT_LE(second, 8u);  // measured; all within rtcCommitScene
    set_thread_count(threads_before);
}

}  // namespace
}  // namespace kinora::raytrace::test
