// tests/runtime/columns/kernels_test.cpp: columns of hits against glm, point by point and bit by
// bit, by every kernel that this CPU runs; and by hand.
#include "runtime/columns/kernels.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "runtime/base/math.h"

namespace kinora::test {
namespace {

class EachColumnKernel : public testing::TestWithParam<size_t> {
  protected:
    const ColumnKernels& kernels() const { return *usable_column_kernels().kernels[GetParam()]; }
};
INSTANTIATE_TEST_SUITE_P(All, EachColumnKernel,
                         testing::Range<size_t>(0, usable_column_kernels().count),
                         [](const auto& kernel) {
                             return std::string(
                                 usable_column_kernels().kernels[kernel.param]->name);
                         });

struct Rows {
    float at[3][kColumnPoints];
    float* const to[3] = {at[0], at[1], at[2]};
    TripleColumns columns() const { return {{at[0], at[1], at[2]}}; }
    vec3 operator[](size_t i) const { return {at[0][i], at[1][i], at[2][i]}; }
};

// Numbers of all magnitudes, some of them 0, infinite or none.
class Random {
  public:
    float number() {
        switch (engine_() % 40) {
            case 0:
                return 0.0f;
            case 1:
                return -0.0f;
            case 2:
                return std::numeric_limits<float>::infinity();
            case 3:
                return std::numeric_limits<float>::quiet_NaN();
            default:
                return std::ldexp(float(int(engine_() % 200001) - 100000), -int(engine_() % 40));
        }
    }
    float share() { return float(engine_() % 4097) / 4096; }
    void fill(Rows& rows) {
        for (auto& row : rows.at)
            for (float& x : row) x = number();
    }
    mat3 matrix() {
        mat3 m;
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) m[c][r] = number();
        return m;
    }

  private:
    std::mt19937 engine_{7};
};

bool same(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}
void expect_same(vec3 found, vec3 expected, size_t i) {
    for (int k = 0; k < 3; ++k)
        ASSERT_TRUE(same(found[k], expected[k])) << found[k] << ' ' << expected[k] << " at " << i;
}

TEST_P(EachColumnKernel, TurnsAsGlmDoes) {
    Random random;
    for (int run = 0; run < 500; ++run) {
        Rows a, b, out;
        random.fill(a), random.fill(b);
        const mat3 m = random.matrix();
        const vec3 eye(random.number(), random.number(), random.number());
        kernels().turn(&m[0][0], a.columns(), out.to);
        for (size_t i = 0; i < kColumnPoints; ++i) expect_same(out[i], m * a[i], i);
        kernels().turn_from(&m[0][0], a.columns(), &eye.x, out.to);
        for (size_t i = 0; i < kColumnPoints; ++i) expect_same(out[i], m * (a[i] - eye), i);
        kernels().turn_between(&m[0][0], a.columns(), b.columns(), out.to);
        for (size_t i = 0; i < kColumnPoints; ++i) expect_same(out[i], m * (a[i] - b[i]), i);
        const Rows before = a;
        kernels().turn(&m[0][0], a.columns(), a.to);  // in place
        for (size_t i = 0; i < kColumnPoints; ++i) expect_same(a[i], m * before[i], i);
    }
}

TEST_P(EachColumnKernel, MixesNormalsAsGlmDoes) {
    Random random;
    uint32_t unsound = 0;
    for (int run = 0; run < 1000; ++run) {
        CornerNormals at;
        for (auto& corner : at.corner)
            for (auto& normal : corner)
                for (float& x : normal) x = random.number();
        for (size_t i = 0; i < kColumnPoints; ++i)
            at.u[i] = random.share(), at.v[i] = random.share();
        if (run % 3 == 0)
            for (auto& corner : at.corner)
                for (float& x : corner[run % kColumnPoints]) x = 0;
        const mat3 m = random.matrix();
        Rows out;
        const uint32_t bad = kernels().mix_normals(&m[0][0], at, out.to);
        unsound |= bad;
        for (size_t i = 0; i < kColumnPoints; ++i) {
            vec4 n[3];
            for (size_t k = 0; k < 3; ++k)
                for (int c = 0; c < 4; ++c) n[k][c] = at.corner[k][i][c];
            const float u = at.u[i], v = at.v[i];
            const vec3 N = m * vec3((1 - u - v) * n[0] + u * n[1] + v * n[2]);
            const float square = glm::dot(N, N);
            const bool sound = square > 0 && square < std::numeric_limits<float>::infinity();
            ASSERT_EQ(bad >> i & 1, sound ? 0u : 1u) << square;
            if (sound) expect_same(out[i], N / std::sqrt(square), i);
        }
    }
    EXPECT_EQ(unsound, 0xffffu);  // each place was met
}

// Half way between x and y, by a matrix that takes x to z, y to x and z to y.
TEST_P(EachColumnKernel, MixesTwoAxesByHand) {
    CornerNormals at{};
    for (size_t i = 0; i < kColumnPoints; ++i) {
        at.corner[1][i][0] = 2;
        at.corner[2][i][1] = 2;
        at.u[i] = at.v[i] = 0.5f;
    }
    const float m[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    Rows out;
    EXPECT_EQ(kernels().mix_normals(m, at, out.to), 0u);
    for (size_t i = 0; i < kColumnPoints; ++i) {
        EXPECT_FLOAT_EQ(out[i].x, 0.70710678f);
        EXPECT_EQ(out[i].y, 0);
        EXPECT_FLOAT_EQ(out[i].z, 0.70710678f);
    }
}

}  // namespace
}  // namespace kinora::test
