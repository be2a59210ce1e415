// tests/raytrace/points/points_test.cpp: points, normals and footprints against long double, by
// every kernel that this CPU runs.
#include "raytrace/points/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace kinora::raytrace::test {
namespace {

using Real = long double;

constexpr float kGamma7 = 7 * 0x1p-24f / (1 - 7 * 0x1p-24f);
constexpr float kLeast = 1e-30f, kMost = 1e30f;

class EachKernel : public testing::TestWithParam<size_t> {
  protected:
    const PointKernels& kernels() const { return *usable_point_kernels().kernels[GetParam()]; }
};
INSTANTIATE_TEST_SUITE_P(All, EachKernel, testing::Range<size_t>(0, usable_point_kernels().count),
                         [](const auto& kernel) {
                             return std::string(usable_point_kernels().kernels[kernel.param]->name);
                         });

// Triangles of any size at any place; the fourth float of a corner is not to be read.
TrianglePoints random_triangles(std::mt19937& random, float size, float distance) {
    std::uniform_real_distribution<float> unit(-1, 1);
    TrianglePoints at;
    for (size_t i = 0; i < kPoints; ++i) {
        float centre[3];
        for (float& c : centre) c = distance * unit(random);
        for (auto& corner : at.corner) {
            for (int c = 0; c < 3; ++c) corner[i][c] = centre[c] + size * unit(random);
            corner[i][3] = std::numeric_limits<float>::quiet_NaN();
        }
        const float u = std::abs(unit(random)), v = std::abs(unit(random));
        at.u[i] = u + v > 1 ? 1 - u : u;
        at.v[i] = u + v > 1 ? 1 - v : v;
    }
    return at;
}

TEST_P(EachKernel, TheTruePointLiesWithinTheError) {
    std::mt19937 random(3);
    for (float size : {1e-3f, 1.0f, 1e6f})
        for (float distance : {0.0f, 1.0f, 1e7f}) {
            const TrianglePoints at = random_triangles(random, size, distance);
            PointBlock out;
            kernels().interpolate(at, kGamma7, kLeast, kMost, out);
            for (size_t i = 0; i < kPoints; ++i)
                for (int c = 0; c < 3; ++c) {
                    const Real u = at.u[i], v = at.v[i];
                    const Real truth = (1 - u - v) * Real(at.corner[0][i][c]) +
                                       u * Real(at.corner[1][i][c]) + v * Real(at.corner[2][i][c]);
                    EXPECT_LE(std::abs(Real(out.P[c][i]) - truth), Real(out.error[c][i]));
                    Real sum = std::abs((1 - u - v) * Real(at.corner[0][i][c])) +
                               std::abs(u * Real(at.corner[1][i][c])) +
                               std::abs(v * Real(at.corner[2][i][c]));
                    EXPECT_NEAR(double(out.error[c][i]), double(sum * Real(kGamma7)),
                                1e-5 * double(sum * Real(kGamma7)));
                }
        }
}

TEST_P(EachKernel, NormalsAreTheTrianglesAndUnit) {
    std::mt19937 random(4);
    for (float size : {1e-3f, 1.0f, 1e4f}) {
        const TrianglePoints at = random_triangles(random, size, 0);
        PointBlock out;
        EXPECT_EQ(kernels().interpolate(at, kGamma7, kLeast, kMost, out), 0u);
        kernels().normalize(out);
        for (size_t i = 0; i < kPoints; ++i) {
            Real e[3], f[3];
            for (int c = 0; c < 3; ++c) {
                e[c] = Real(at.corner[1][i][c]) - Real(at.corner[0][i][c]);
                f[c] = Real(at.corner[2][i][c]) - Real(at.corner[0][i][c]);
            }
            const Real n[3] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                               e[0] * f[1] - e[1] * f[0]};
            const Real length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            // What the edges' products lose beside the triangle's area, and some units.
            const Real edges = std::sqrt((e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) *
                                         (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(double(out.N[c][i]), double(n[c] / length),
                            double(edges / length) * 4e-7);
        }
    }
}

TEST_P(EachKernel, NormalsOutsideTheSafeRangeAreNamed) {
    std::mt19937 random(6);
    TrianglePoints at = random_triangles(random, 1, 0);
    for (auto& corner : at.corner) {
        for (int c = 0; c < 3; ++c) {
            corner[1][c] *= 1e-12f;  // squared length of 1e-48
            corner[4][c] *= 1e12f;   // infinite
            corner[15][c] = 0.5f;    // a point
        }
        corner[9][1] = std::numeric_limits<float>::quiet_NaN();
    }
    PointBlock out;
    EXPECT_EQ(kernels().interpolate(at, kGamma7, kLeast, kMost, out),
              1u << 1 | 1u << 4 | 1u << 9 | 1u << 15);
    kernels().normalize(out);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(out.N[c][15], 0);
}

struct Rays {
    float dO[3][kPoints], dD[3][kPoints], dir[3][kPoints], Ng[3][kPoints], t[kPoints];
    FootprintRays view() const {
        return {{dO[0], dO[1], dO[2]},
                {dD[0], dD[1], dD[2]},
                {dir[0], dir[1], dir[2]},
                {Ng[0], Ng[1], Ng[2]},
                t};
    }
};

Rays random_rays(std::mt19937& random) {
    std::normal_distribution<float> normal(0, 1);
    Rays r;
    for (size_t i = 0; i < kPoints; ++i) {
        for (auto* unit : {&r.dir, &r.Ng}) {
            Real v[3], square = 0;
            for (Real& x : v) x = normal(random), square += x * x;
            for (int c = 0; c < 3; ++c) (*unit)[c][i] = float(v[c] / std::sqrt(square));
        }
        for (int c = 0; c < 3; ++c) {
            r.dO[c][i] = i % 3 ? 1e-3f * normal(random) : 0.0f;
            r.dD[c][i] = 1e-3f * normal(random);
        }
        r.t[i] = std::abs(10 * normal(random));
    }
    return r;
}

TEST_P(EachKernel, FootprintsLieInThePlaneOrAreCapped) {
    constexpr float kLeastCosine = 0.05f;
    std::mt19937 random(8);
    for (int round = 0; round < 50; ++round) {
        Rays r = random_rays(random);
        for (int c = 0; c < 3; ++c) r.Ng[c][7] = r.dir[(c + 1) % 3][7] * float(c != 1);
        float x[kPoints], y[kPoints], z[kPoints];
        float* const dP[3] = {x, y, z};
        kernels().footprint(r.view(), kLeastCosine, dP);
        for (size_t i = 0; i < kPoints; ++i) {
            Real q[3], cosine = 0, along = 0, size = 0;
            for (int c = 0; c < 3; ++c) {
                q[c] = Real(r.dO[c][i]) + Real(r.t[i]) * Real(r.dD[c][i]);
                cosine += Real(r.Ng[c][i]) * Real(r.dir[c][i]);
                along += Real(r.Ng[c][i]) * q[c];
                size += std::abs(q[c]);
            }
            if (std::abs(std::abs(cosine) - Real(kLeastCosine)) < 1e-5L) continue;
            if (std::abs(cosine) < Real(kLeastCosine))
                cosine = std::copysign(Real(kLeastCosine), cosine);
            for (int c = 0; c < 3; ++c) {
                const Real truth = q[c] - along / cosine * Real(r.dir[c][i]);
                EXPECT_NEAR(double(dP[c][i]), double(truth),
                            double(size / std::abs(cosine) / std::abs(cosine)) * 1e-6);
            }
        }
    }
}

// One lane at a time is what it may be, on the edge of it or beyond.
TEST_P(EachKernel, PacketsAreSoundWhereEachOfTheirRaysIs) {
    constexpr float kFar = 1e18f, kShort = 0x1p-40f, kLong = 0x1p40f;
    const float inf = std::numeric_limits<float>::infinity(),
                nan = std::numeric_limits<float>::quiet_NaN(),
                largest = std::numeric_limits<float>::max();
    struct Case {
        int column;  // org, dir, tnear, tfar
        float value;
        bool sound;
    };
    const Case cases[] = {
        {0, kFar, true},     {1, -kFar, true},   {2, std::nextafter(kFar, inf), false},
        {0, -inf, false},    {1, nan, false},    {3, 0x1p-20f, true},
        {4, 0x1p20f, true},  {5, 0, false},      {3, 0x1p-21f, false},
        {4, 0x1p21f, false}, {5, nan, false},    {3, inf, false},
        {6, 0, true},        {6, -0.0f, true},   {6, -1e-30f, false},
        {6, nan, false},     {6, 5, true},       {6, std::nextafter(5.0f, inf), false},
        {6, inf, false},     {7, nan, false},    {7, -1, false},
        {7, inf, true},      {7, largest, true},
    };
    for (const Case& one : cases)
        for (size_t lane = 0; lane < kPoints; ++lane) {
            float column[8][kPoints];
            for (size_t i = 0; i < kPoints; ++i) {
                for (int c = 0; c < 6; ++c) column[c][i] = c == one.column || c < 3 ? 1.0f : 0.0f;
                if (one.column < 3 || one.column > 5) column[3][i] = 1;
                column[6][i] = 0;
                column[7][i] = 5;
            }
            column[one.column][lane] = one.value;
            const PacketRays rays{{column[0], column[1], column[2]},
                                  {column[3], column[4], column[5]},
                                  column[6],
                                  column[7]};
            EXPECT_EQ(kernels().sound(rays, kFar, kShort, kLong), one.sound)
                << "column " << one.column << " = " << one.value << ", lane " << lane;
        }
}

TEST(PointKernels, GiveTheSameBits) {
    const UsableKernels<PointKernels>& usable = usable_point_kernels();
    const PointKernels& plain = *usable.kernels[usable.count - 1];
    std::mt19937 random(9);
    for (size_t k = 0; k < usable.count; ++k)
        for (int round = 0; round < 200; ++round) {
            const PointKernels& other = *usable.kernels[k];
            const float size = std::ldexp(1.0f, round % 80 - 40);
            const TrianglePoints at = random_triangles(random, size, round % 7 ? 0.0f : 1e5f);
            PointBlock a, b;
            ASSERT_EQ(plain.interpolate(at, kGamma7, kLeast, kMost, a),
                      other.interpolate(at, kGamma7, kLeast, kMost, b));
            ASSERT_EQ(std::memcmp(&a, &b, sizeof(a)), 0) << other.name;
            plain.normalize(a);
            other.normalize(b);
            ASSERT_EQ(std::memcmp(&a, &b, sizeof(a)), 0) << other.name;
            const Rays rays = random_rays(random);
            float p[3][kPoints], q[3][kPoints];
            float *const to_p[3] = {p[0], p[1], p[2]}, *const to_q[3] = {q[0], q[1], q[2]};
            plain.footprint(rays.view(), 0.01f, to_p);
            other.footprint(rays.view(), 0.01f, to_q);
            ASSERT_EQ(std::memcmp(p, q, sizeof(p)), 0) << other.name;
        }
}

// Every set of lanes: those that are kept come in their order, from `at` on.
TEST_P(EachKernel, KeepsTheRowsOfTheLanes) {
    uint32_t rows[2][48], kept[2][64];
    for (uint32_t i = 0; i < 48; ++i) rows[0][i] = i, rows[1][i] = 1000 + i;
    const KeptColumn columns[] = {{rows[0], kept[0]}, {rows[1], kept[1]}};
    for (uint32_t lanes = 1; lanes < 0x10000; ++lanes) {
        const size_t first = lanes % 3 * 16, at = lanes % 33;
        for (auto& row : kept) std::fill(std::begin(row), std::end(row), 7u);
        kernels().keep(lanes, columns, 2, first, at);
        size_t next = at;
        for (uint32_t lane = 0; lane < 16; ++lane) {
            if (!(lanes >> lane & 1)) continue;
            ASSERT_EQ(kept[0][next], first + lane) << lanes;
            ASSERT_EQ(kept[1][next++], 1000 + first + lane) << lanes;
        }
        if (at > 0) {
            ASSERT_EQ(kept[1][at - 1], 7u);
        }
        ASSERT_EQ(kept[1][at + 16], 7u);
    }
}

// Numbers one behind the other, some left out, and far apart.
TEST_P(EachKernel, PicksRowsByTheirNumbers) {
    std::vector<uint32_t> column[2];
    for (uint32_t i = 0; i < 1024; ++i) column[0].push_back(i), column[1].push_back(5000 + i);
    std::mt19937 random(5);
    for (uint32_t step : {1u, 2u, 3u, 60u})
        for (int run = 0; run < 100; ++run) {
            uint32_t rows[kPoints], found[2][kPoints];
            rows[0] = random() % (1024 - 16 * step);
            for (size_t i = 1; i < kPoints; ++i)
                rows[i] = rows[i - 1] + 1 + (step > 1 ? random() % (step - 1) : 0);
            const KeptColumn columns[] = {{column[0].data(), found[0]},
                                          {column[1].data(), found[1]}};
            kernels().pick(rows, columns, 2);
            for (size_t i = 0; i < kPoints; ++i) {
                ASSERT_EQ(found[0][i], rows[i]);
                ASSERT_EQ(found[1][i], 5000 + rows[i]);
            }
        }
}

// Where a kernel says that the facet surely sees the light, so do exact unit normals.
TEST_P(EachKernel, SeesLightOnlyWhereItSurelyDoes) {
    constexpr float kCosine = 0.1f;
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(-1, 1);
    int seen = 0, flat = 0, other = 0;
    for (int round = 0; round < 2000; ++round) {
        TrianglePoints at = random_triangles(random, 0, 0);
        LeavingRays from{};
        for (size_t i = 0; i < kPoints; ++i) {
            float g[3], length = 0;
            for (int c = 0; c < 3; ++c) g[c] = unit(random);
            for (int c = 0; c < 3; ++c) length += g[c] * g[c];
            for (int c = 0; c < 3; ++c) {
                from.Ng[c][i] = g[c] / std::sqrt(length);
                from.way[c][i] = 5 * unit(random);
            }
            for (auto& corner : at.corner) {
                float square = 0;
                for (int c = 0; c < 3; ++c) {
                    corner[i][c] = i == 0 ? float(c == 0) : from.Ng[c][i] + 0.5f * unit(random);
                    square += corner[i][c] * corner[i][c];
                }
                const float off = 1 + 0.9e-3f * (i == 0 ? 0 : unit(random));
                for (int c = 0; c < 3; ++c) corner[i][c] *= off / std::sqrt(square);
            }
        }
        float N[3][kPoints];
        uint32_t normals[kPoints];
        for (size_t i = 0; i < kPoints; ++i) {
            const float weight[] = {1 - at.u[i] - at.v[i], at.u[i], at.v[i]};
            float square = 0;
            for (int c = 0; c < 3; ++c) {
                N[c][i] = 0;
                for (int k = 0; k < 3; ++k) N[c][i] += weight[k] * at.corner[k][i][c];
                square += N[c][i] * N[c][i];
            }
            for (auto& row : N) row[i] /= std::sqrt(square);
            normals[i] = i == 0 ? kOneNormal : square > 0.25f ? kUnitNormals : 0;
        }
        const float* const rows[3] = {N[0], N[1], N[2]};
        const uint32_t bits = kernels().sees_light(from, rows, normals, kCosine);
        for (size_t i = 0; i < kPoints; ++i) {
            const Real weight[] = {1 - Real(at.u[i]) - Real(at.v[i]), at.u[i], at.v[i]};
            Real mixed[3] = {}, facet = 0, light = 0, cosine = 0, square = 0;
            for (int k = 0; k < 3; ++k) {
                Real length = 0;
                for (int c = 0; c < 3; ++c) length += Real(at.corner[k][i][c]) * at.corner[k][i][c];
                for (int c = 0; c < 3; ++c)
                    mixed[c] += weight[k] * at.corner[k][i][c] / std::sqrt(length);
            }
            for (int c = 0; c < 3; ++c) {
                facet += mixed[c] * from.Ng[c][i];
                light += mixed[c] * from.way[c][i];
                cosine += Real(from.Ng[c][i]) * from.way[c][i];
                square += Real(from.way[c][i]) * from.way[c][i];
            }
            const Real facing = (facet < 0) != (light < 0) ? -1 : 1;
            const bool truth = facing * cosine > kCosine * std::sqrt(square);
            const bool said = bits >> i & 1;
            if (i == 0) {
                flat += said;
                continue;
            }
            EXPECT_TRUE(truth || !said) << round << " " << i;
            seen += said;
            other += truth && !said;
        }
    }
    EXPECT_EQ(flat, 2000);  // the same normal at all corners
    EXPECT_GT(seen, 20 * other);
    EXPECT_GT(seen, 5000);
}

}  // namespace
}  // namespace kinora::raytrace::test
