// tests/runtime/rays/ray_kernels_test.cpp: rays sixteen at a time against their definitions in
// double precision; all instruction sets give the same bits.
#include "runtime/rays/ray_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

namespace kinora {
namespace {

// ---- the sequence, by its definition ------------------------------------------------------------

uint32_t mix(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
uint32_t mix(uint32_t a, uint32_t b) {
    return mix(a ^ (mix(b) + 0x9e3779b9u));
}
uint32_t turned_round(uint32_t x) {
    uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1) << (31 - bit);
    return result;
}
uint32_t owen(uint32_t x, uint32_t seed) {
    x = turned_round(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return turned_round(x);
}
// Column k of the second generator matrix is row k of Pascal's triangle modulo 2.
uint32_t sobol(uint32_t index) {
    uint32_t result = 0;
    for (uint32_t column = 1u << 31; index; index >>= 1, column ^= column >> 1)
        if (index & 1) result ^= column;
    return result;
}

dvec3 direction_by_definition(const Cone& cone, uint32_t k, uint32_t seed) {
    double u = owen(turned_round(k), mix(seed, 0x68bc21ebu)) * 0x1p-32;
    double turn = owen(sobol(k), mix(seed, 0x02e5be93u)) * 0x1p-32;
    double c = double(cone.cosine);
    double up = cone.by_cosine ? std::sqrt(1 - u * (1 - c * c)) : 1 - u * (1 - c);
    double out = std::sqrt(std::max(0.0, 1 - up * up));
    return out * std::cos(2 * kPi * turn) * dvec3(cone.x) +
           out * std::sin(2 * kPi * turn) * dvec3(cone.y) + up * dvec3(cone.z);
}

// ---- random input -------------------------------------------------------------------------------

// Drawn one by one: the order in which arguments are evaluated is the compiler's.
class Random {
  public:
    float number(float least, float most) {  // the same with every standard library
        return least + (most - least) * float(engine_() >> 8) * 0x1p-24f;
    }
    vec3 unit() {
        for (;;) {
            vec3 v{number(-1, 1), number(-1, 1), number(-1, 1)};
            float square = v.x * v.x + v.y * v.y + v.z * v.z;
            if (square > 0.01f && square < 1) return v / std::sqrt(square);
        }
    }
    RaySource source() {
        RaySource s;
        s.P = unit();
        s.P *= number(0.1f, 50);
        s.error = glm::abs(s.P) * 4e-7f;
        s.Ng = s.in_Ng = unit();
        s.in = unit();
        s.dDdx = unit() * 1e-3f;
        s.dDdy = unit() * 1e-3f;
        return s;
    }
    uint32_t bits() { return uint32_t(engine_()); }

  private:
    std::mt19937 engine_{7};
};

TEST(RayKernels, DirectionsAreTheSequencesSamplesInTheCone) {
    Random random;
    for (const RayKernels* kernels : all_ray_kernels())
        for (int turn = 0; turn < 200; ++turn) {
            bool by_cosine = turn % 2;
            float angle = random.number(0, 3.2f);
            Cone cone(random.unit(), angle, by_cosine);
            uint32_t seed = random.bits(), first = random.bits() % 100000;
            SixteenRays rays;
            kernels->directions(cone, first, seed, rays);
            for (uint32_t i = 0; i < kSixteen; ++i) {
                dvec3 got(rays.dir[0][i], rays.dir[1][i], rays.dir[2][i]);
                dvec3 want = direction_by_definition(cone, first + i, seed);
                ASSERT_LT(glm::length(got - want), 2e-7) << kernels->name << " " << turn;
                ASSERT_NEAR(glm::length(got), 1, 4e-7);
                ASSERT_GT(glm::dot(got, dvec3(cone.z)), double(cone.cosine) - 4e-7);
            }
        }
}

TEST(RayKernels, RaysLeaveJustOutsideTheErrorBox) {
    Random random;
    for (const RayKernels* kernels : all_ray_kernels())
        for (int turn = 0; turn < 200; ++turn) {
            RaySource source = random.source();
            SixteenRays rays;
            uint32_t seed = random.bits();
            kernels->directions(Cone(random.unit(), 3.2f, false), 0, seed, rays);
            kernels->leave(source, rays);
            dvec3 n(source.Ng);
            double box = glm::dot(glm::abs(n), dvec3(source.error));
            for (int i = 0; i < kSixteen; ++i) {
                dvec3 org(rays.org[0][i], rays.org[1][i], rays.org[2][i]);
                dvec3 dir(rays.dir[0][i], rays.dir[1][i], rays.dir[2][i]);
                double side = glm::dot(n, dir) < 0 ? -1 : 1;
                double height = side * glm::dot(n, org - dvec3(source.P));
                ASSERT_GE(height, box * (1 - 1e-6)) << kernels->name;
                ASSERT_LE(height, box + 3 * 50 * 0x1p-22) << kernels->name;
            }
        }
}

// On no surface that is known: along the ray, twice the largest error.
TEST(RayKernels, RaysFromFreePointsLeaveAlongThemselves) {
    Random random;
    for (const RayKernels* kernels : all_ray_kernels()) {
        RaySource source = random.source();
        source.P = vec3(0.0f);
        source.Ng = vec3(0.0f);
        source.error = vec3(1e-3f, 2e-3f, 5e-4f);
        SixteenRays rays;
        kernels->directions(Cone(random.unit(), 1, true), 0, 3, rays);
        kernels->leave(source, rays);
        for (int i = 0; i < kSixteen; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(rays.org[k][i], 4e-3f * rays.dir[k][i], 1e-9f) << kernels->name;
    }
}

// A ray that a flat mirror sends back has its differentials mirrored (Igehy 1999, equation 15 for a
// flat surface); one that goes straight on keeps them.
TEST(RayKernels, SpreadsAreThoseOfFlatMirrorsAndOfRaysThatGoOn) {
    Random random;
    for (const RayKernels* kernels : all_ray_kernels())
        for (int turn = 0; turn < 100; ++turn) {
            RaySource source = random.source();
            dvec3 in(source.in), n(source.Ng);
            dvec3 out = turn % 2 ? in : in - 2 * glm::dot(in, n) * n;
            if (std::abs(glm::dot(in, n)) < 0.05) continue;
            SixteenRays rays;
            for (int k = 0; k < 3; ++k)
                for (float& x : rays.dir[k]) x = float(out[k]);
            kernels->leave(source, rays);
            dvec3 dx(source.dDdx), dy(source.dDdy);
            dvec3 want_x = turn % 2 ? dx : dx - 2 * glm::dot(dx, n) * n;
            dvec3 want_y = turn % 2 ? dy : dy - 2 * glm::dot(dy, n) * n;
            for (int k = 0; k < 3; ++k) {
                ASSERT_NEAR(rays.dDdx[k][5], want_x[k], 2e-8) << kernels->name << " " << turn;
                ASSERT_NEAR(rays.dDdy[k][5], want_y[k], 2e-8) << kernels->name << " " << turn;
            }
        }
}

// One number for all instruction sets and CPUs.
TEST(RayKernels, AllInstructionSetsGiveTheSameBits) {
    for (const RayKernels* kernels : all_ray_kernels()) {
        Random random;
        uint32_t all = 0;
        for (int turn = 0; turn < 500; ++turn) {
            RaySource source = random.source();
            if (turn % 7 == 0) source.Ng = vec3(0.0f);
            if (turn % 11 == 0) source.in = vec3(0.0f);
            Cone cone(random.unit(), 0.5f, turn % 2);
            cone.cosine = random.number(-1, 1);
            SixteenRays rays;
            uint32_t first = random.bits(), seed = random.bits();
            kernels->directions(cone, first, seed, rays);
            kernels->leave(source, rays);
            uint32_t words[sizeof(rays) / 4];
            std::memcpy(words, &rays, sizeof(rays));
            for (uint32_t word : words) all = mix(all, word);
        }
        EXPECT_EQ(all, 3927610888u) << kernels->name;
    }
}

}  // namespace
}  // namespace kinora
