// tests/runtime/picture/columns/kernels_test.cpp: columns of hits against glm, point by point and
// bit by bit, by every kernel that this CPU runs; and by hand.
#include "runtime/picture/columns/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "raytrace/points/points.h"
#include "runtime/base/math.h"
#include "runtime/scene/description/affine_map.h"

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
        uint32_t kinds[kColumnPoints];
        const uint32_t bad = kernels().mix_normals(&m[0][0], at, out.to, kinds);
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
    uint32_t kinds[kColumnPoints];
    EXPECT_EQ(kernels().mix_normals(m, at, out.to, kinds), 0u);
    for (size_t i = 0; i < kColumnPoints; ++i) {
        EXPECT_FLOAT_EQ(out[i].x, 0.70710678f);
        EXPECT_EQ(out[i].y, 0);
        EXPECT_FLOAT_EQ(out[i].z, 0.70710678f);
    }
}

// Place 0: three unit normals; 1: the same normal thrice; 2: one that is too long; 3: two that are
// opposite, so that their mixture is short.
TEST_P(EachColumnKernel, KnowsWhatNormalsSayOfTheSurface) {
    CornerNormals at{};
    for (size_t i = 0; i < kColumnPoints; ++i) {
        at.u[i] = at.v[i] = 0.25f;
        for (int k = 0; k < 3; ++k) at.corner[k][i][2] = 1;
    }
    auto set = [&](size_t i, int k, float x, float z) {
        at.corner[k][i][0] = x;
        at.corner[k][i][2] = z;
    };
    set(0, 1, 0.6f, 0.8f);
    set(2, 1, 0.6f, 0.802f);
    set(3, 0, 0, -1);
    set(3, 1, 0.6f, 0.8f);
    const float one[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    Rows out;
    uint32_t kinds[kColumnPoints];
    EXPECT_EQ(kernels().mix_normals(one, at, out.to, kinds), 0u);
    EXPECT_EQ(kinds[0], raytrace::kUnitNormals);
    EXPECT_EQ(kinds[1], raytrace::kOneNormal);
    EXPECT_EQ(kinds[2], 0u);
    EXPECT_EQ(kinds[3], 0u);
}

// The definition, a number at a time; layers from 64 on lie in the upper half.
TEST_P(EachColumnKernel, HashesAsTheDefinitionSays) {
    std::mt19937 engine(11);
    for (uint32_t depth : {0u, 1u, 7u}) {
        const uint32_t seed = 1000 * depth;
        uint32_t x[kColumnPoints], y[kColumnPoints], sample[kColumnPoints], layer[kColumnPoints];
        uint32_t found[kColumnPoints];
        for (size_t i = 0; i < kColumnPoints; ++i) {
            x[i] = engine() % 4096, y[i] = engine() % 4096;
            sample[i] = uint32_t(engine()), layer[i] = engine() % 256;
        }
        kernels().random({x, y, sample, layer}, depth, seed, found);
        auto mixed = [](uint32_t n) {
            n = (n ^ n >> 16) * 0x7feb352du;
            n = (n ^ n >> 15) * 0x846ca68bu;
            return n ^ n >> 16;
        };
        auto both = [&](uint32_t a, uint32_t b) { return mixed(a ^ (mixed(b) + 0x9e3779b9u)); };
        for (size_t i = 0; i < kColumnPoints; ++i) {
            const uint32_t low = layer[i] & 63, high = layer[i] >> 6;
            const uint32_t passed = low + 64 * depth + 65536 * high;
            EXPECT_EQ(found[i], both(both(both(x[i], y[i]) ^ mixed(seed), sample[i]), passed))
                << depth;
        }
    }
}

// ---- places on triangles ------------------------------------------------------------------------

// Random points; every third triangle has no area in s, t.
struct Triangles {
    OnTriangles on{};
    CornerNumbers s{}, t{}, x{};
    CornerPlaces places{};
    explicit Triangles(Random& random) {
        for (size_t i = 0; i < kColumnPoints; ++i) {
            on.u[i] = random.share(), on.v[i] = random.share();
            for (int k = 0; k < 3; ++k) {
                s.at[k][i] = random.number(), t.at[k][i] = random.number();
                x.at[k][i] = random.number();
                for (float& p : places.at[k][i]) p = random.number();
                if (i % 3 == 0) t.at[k][i] = 0.5f * s.at[k][i];
            }
        }
    }
    vec3 place(int k, size_t i) const {
        return {places.at[k][i][0], places.at[k][i][1], places.at[k][i][2]};
    }
};

TEST_P(EachColumnKernel, SolvesAsTheAffineMapDoes) {
    Random random;
    size_t flat = 0;
    for (int run = 0; run < 500; ++run) {
        Triangles at(random);
        TwoRows st, uv, along;
        float value[kColumnPoints];
        const mat3 m = random.matrix();
        TripleRows dPdu, dPdv;
        kernels().find_parameters(at.on, at.s, at.t, st, uv);
        kernels().mix(at.on, at.x, value, along);
        kernels().tangents(&m[0][0], at.on, at.places, dPdu, dPdv);
        for (size_t i = 0; i < kColumnPoints; ++i) {
            const float u = at.on.u[i], v = at.on.v[i];
            auto change = [&](const CornerNumbers& c, int k) { return c.at[k][i] - c.at[0][i]; };
            auto between = [&](const CornerNumbers& c) {
                return c.at[0][i] + u * change(c, 1) + v * change(c, 2);
            };
            AffineMap map;
            const bool area =
                solve(map, change(at.s, 1), change(at.t, 1), change(at.s, 2), change(at.t, 2));
            flat += !area;
            EXPECT_TRUE(same(st.at[0][i], between(at.s)) && same(st.at[1][i], between(at.t)));
            EXPECT_TRUE(same(uv.at[0][i], area ? between(at.s) : u));
            EXPECT_TRUE(same(uv.at[1][i], area ? between(at.t) : v));
            EXPECT_TRUE(same(value[i], between(at.x)));
            const float d1 = change(at.x, 1), d2 = change(at.x, 2);
            EXPECT_TRUE(same(along.at[0][i], map.along_u(d1, d2)));
            EXPECT_TRUE(same(along.at[1][i], map.along_v(d1, d2)));
            const vec3 e1 = m * (at.place(1, i) - at.place(0, i)),
                       e2 = m * (at.place(2, i) - at.place(0, i));
            expect_same({dPdu.at[0][i], dPdu.at[1][i], dPdu.at[2][i]}, map.along_u(e1, e2), i);
            expect_same({dPdv.at[0][i], dPdv.at[1][i], dPdv.at[2][i]}, map.along_v(e1, e2), i);
        }
    }
    EXPECT_GT(flat, 2000u);
}

// A step of a dPdu + b dPdv changes u by a and v by b; the larger of two steps counts.
TEST_P(EachColumnKernel, FindsHowFarStepsGo) {
    Random random;
    TripleRows dPdu, dPdv, dPdx, dPdy;
    float steps[2][2][kColumnPoints];
    for (size_t i = 0; i < kColumnPoints; ++i) {
        const vec3 du(2, random.share(), 0), dv(random.share(), 3, 1);
        for (auto& step : steps)
            for (auto& amount : step) amount[i] = 4 * random.share() - 2;
        for (int c = 0; c < 3; ++c) {
            dPdu.at[c][i] = du[c];
            dPdv.at[c][i] = dv[c];
            dPdx.at[c][i] = steps[0][0][i] * du[c] + steps[0][1][i] * dv[c];
            dPdy.at[c][i] = steps[1][0][i] * du[c] + steps[1][1][i] * dv[c];
        }
    }
    for (int c = 0; c < 3; ++c) dPdv.at[c][5] = dPdu.at[c][5];  // no area: no answer but 0
    TwoRows extents;
    kernels().extents(dPdu, dPdv, dPdx, dPdy, extents);
    for (size_t i = 0; i < kColumnPoints; ++i)
        for (int k = 0; k < 2; ++k) {
            const float most = std::max(std::abs(steps[0][k][i]), std::abs(steps[1][k][i]));
            EXPECT_NEAR(extents.at[k][i], i == 5 ? 0 : most, 1e-5f);
        }
}

}  // namespace
}  // namespace kinora::test
