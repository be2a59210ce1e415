// tests/raytrace/allocation_test.cpp: after the first frame of a size, a frame allocates nothing.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "raytrace/integrator.h"
#include "tests/raytrace/meshes.h"

namespace {
std::atomic<bool> g_counting{false};
std::atomic<int> g_count{0};

void* counted(size_t bytes) {
    if (g_counting.load(std::memory_order_relaxed)) ++g_count;
    if (void* p = std::malloc(bytes ? bytes : 1)) return p;
    throw std::bad_alloc();
}
}  // namespace

void* operator new(size_t bytes) {
    return counted(bytes);
}
void* operator new[](size_t bytes) {
    return counted(bytes);
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete[](void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, size_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, size_t) noexcept {
    std::free(p);
}

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
int count_allocations(F&& work) {
    g_count = 0;
    g_counting = true;
    work();
    g_counting = false;
    return g_count;
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
    EXPECT_GT(count_allocations(frame), 0);  // the counter works
    EXPECT_EQ(count_allocations(frame), 0);
    settings.samples_per_pixel = 5;
    EXPECT_EQ(count_allocations(frame), 0);
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
    const int first = count_allocations(move), second = count_allocations(move);
    EXPECT_LE(second, first);
    RecordProperty("allocations", second);
    EXPECT_LE(second, 8);  // measured; all within rtcCommitScene
    set_thread_count(threads_before);
}

}  // namespace
}  // namespace kinora::raytrace::test
