// tests/runtime/picture/rays/ray_kernels_test.cpp: rays sixteen at a time against their definitions
// in double precision; all instruction sets give the same bits.
#include "runtime/picture/rays/ray_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>
#include <span>
#include <vector>

#include "tests/raytrace/random/sequence_by_definition.h"

namespace kinora {
namespace {

std::span<const RayKernels* const> all_kernels() {
    const UsableKernels<RayKernels>& usable = usable_ray_kernels();
    return {usable.kernels, usable.count};
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

// ---- one source for all lanes -------------------------------------------------------------------

// The surface that rays leave, and the ray that saw it.
struct RaySource {
    vec3 P, error, Ng, in_Ng, in, dDdx, dDdy, dNdx{0.0f}, dNdy{0.0f};
};

void fill(float (&rows)[3][kSixteen], int lane, vec3 v) {
    for (int k = 0; k < 3; ++k) rows[k][lane] = v[k];
}
void set_lane(RayLanes& lanes, int lane, const RaySource& source) {
    fill(lanes.P, lane, source.P), fill(lanes.error, lane, source.error);
    fill(lanes.Ng, lane, source.Ng), fill(lanes.in_Ng, lane, source.in_Ng);
    fill(lanes.in, lane, source.in);
    fill(lanes.dDdx, lane, source.dDdx), fill(lanes.dDdy, lane, source.dDdy);
    fill(lanes.dNdx, lane, source.dNdx), fill(lanes.dNdy, lane, source.dNdy);
}
void set_lane(RayLanes& lanes, int lane, const Cone& cone, uint32_t seed) {
    fill(lanes.x, lane, cone.x), fill(lanes.y, lane, cone.y), fill(lanes.z, lane, cone.z);
    lanes.cosine[lane] = cone.cosine;
    lanes.seed[lane] = seed;
}

// Rays first, first + 1, ... of a cone from one source.
void shoot(const RayKernels& kernels, const RaySource& source, const Cone& cone, uint32_t first,
           uint32_t seed, SixteenRays& rays) {
    RayLanes lanes{};
    RaySamples samples{};
    set_lane(lanes, 0, source);
    set_lane(lanes, 0, cone, seed);
    for (uint32_t i = 0; i < kSixteen; ++i) samples.number[i] = first + i;
    kernels.shoot(lanes, samples, {true, cone.by_cosine, true}, rays);
}

// A ray in a given direction from the source.
void shoot(const RayKernels& kernels, const RaySource& source, vec3 direction, SixteenRays& rays) {
    RayLanes lanes{};
    set_lane(lanes, 0, source);
    fill(lanes.axis, 0, direction);
    kernels.shoot(lanes, RaySamples{}, {false, false, true}, rays);
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
    for (const RayKernels* kernels : all_kernels())
        for (int turn = 0; turn < 200; ++turn) {
            bool by_cosine = turn % 2;
            float angle = random.number(0, 3.2f);
            Cone cone(random.unit(), angle, by_cosine);
            uint32_t seed = random.bits(), first = random.bits() % 100000;
            float dir[3][kSixteen];
            kernels->directions(cone, first, seed, dir);
            for (uint32_t i = 0; i < kSixteen; ++i) {
                dvec3 got(dir[0][i], dir[1][i], dir[2][i]);
                dvec3 want = direction_by_definition(cone, first + i, seed);
                ASSERT_LT(glm::length(got - want), 2e-7) << kernels->name << " " << turn;
                ASSERT_NEAR(glm::length(got), 1, 4e-7);
                ASSERT_GT(glm::dot(got, dvec3(cone.z)), double(cone.cosine) - 4e-7);
            }
        }
}

TEST(RayKernels, RaysLeaveJustOutsideTheErrorBox) {
    Random random;
    for (const RayKernels* kernels : all_kernels())
        for (int turn = 0; turn < 200; ++turn) {
            RaySource source = random.source();
            SixteenRays rays;
            uint32_t seed = random.bits();
            shoot(*kernels, source, Cone(random.unit(), 3.2f, false), 0, seed, rays);
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
    for (const RayKernels* kernels : all_kernels()) {
        RaySource source = random.source();
        source.P = vec3(0.0f);
        source.Ng = vec3(0.0f);
        source.error = vec3(1e-3f, 2e-3f, 5e-4f);
        SixteenRays rays;
        shoot(*kernels, source, Cone(random.unit(), 1, true), 0, 3, rays);
        for (int i = 0; i < kSixteen; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(rays.org[k][i], 4e-3f * rays.dir[k][i], 1e-9f) << kernels->name;
    }
}

// A ray that a flat mirror sends back has its differentials mirrored (Igehy 1999, equation 15 for a
// flat surface); one that goes straight on keeps them.
TEST(RayKernels, SpreadsAreThoseOfFlatMirrorsAndOfRaysThatGoOn) {
    Random random;
    for (const RayKernels* kernels : all_kernels())
        for (int turn = 0; turn < 100; ++turn) {
            RaySource source = random.source();
            dvec3 in(source.in), n(source.Ng);
            dvec3 out = turn % 2 ? in : in - 2 * glm::dot(in, n) * n;
            if (std::abs(glm::dot(in, n)) < 0.05) continue;
            SixteenRays rays;
            shoot(*kernels, source, vec3(out), rays);
            dvec3 dx(source.dDdx), dy(source.dDdy);
            dvec3 want_x = turn % 2 ? dx : dx - 2 * glm::dot(dx, n) * n;
            dvec3 want_y = turn % 2 ? dy : dy - 2 * glm::dot(dy, n) * n;
            for (int k = 0; k < 3; ++k) {
                ASSERT_NEAR(rays.dDdx[k][5], want_x[k], 2e-8) << kernels->name << " " << turn;
                ASSERT_NEAR(rays.dDdy[k][5], want_y[k], 2e-8) << kernels->name << " " << turn;
            }
        }
}

// What a mirror whose normal turns sends back, by differences of the law of reflection in double.
TEST(RayKernels, SpreadsCarryTheTurnOfTheNormal) {
    Random random;
    auto reflected = [](dvec3 d, dvec3 n) {
        n = glm::normalize(n);
        return d - 2 * glm::dot(d, n) * n;
    };
    for (const RayKernels* kernels : all_kernels())
        for (int turn = 0; turn < 100; ++turn) {
            RaySource source = random.source();
            source.in *= random.number(0.5f, 2);
            if (glm::dot(source.in, source.Ng) > 0) source.in = -source.in;
            if (glm::dot(source.in, source.Ng) > -0.05f) continue;
            for (vec3* dN : {&source.dNdx, &source.dNdy}) {
                const vec3 any = random.unit() * 0.1f;
                *dN = any - source.Ng * glm::dot(any, source.Ng);
            }
            const dvec3 in(source.in), n(source.Ng);
            SixteenRays rays;
            shoot(*kernels, source, vec3(reflected(in, n)), rays);
            auto want = [&](vec3 dD, vec3 dN) {
                const double h = 1e-6;
                return (reflected(in + h * dvec3(dD), n + h * dvec3(dN)) -
                        reflected(in - h * dvec3(dD), n - h * dvec3(dN))) /
                       (2 * h);
            };
            const dvec3 x = want(source.dDdx, source.dNdx), y = want(source.dDdy, source.dNdy);
            for (int k = 0; k < 3; ++k) {
                ASSERT_NEAR(rays.dDdx[k][5], x[k], 1e-6) << kernels->name << " " << turn;
                ASSERT_NEAR(rays.dDdy[k][5], y[k], 1e-6) << kernels->name << " " << turn;
            }
        }
}

// One number for all instruction sets and CPUs.
TEST(RayKernels, AllInstructionSetsGiveTheSameBits) {
    for (const RayKernels* kernels : all_kernels()) {
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
            shoot(*kernels, source, cone, first, seed, rays);
            uint32_t words[offsetof(SixteenRays, path) / 4];
            std::memcpy(words, &rays, sizeof(words));
            for (uint32_t word : words) all = mix(all, word);
        }
        EXPECT_EQ(all, 3927610888u) << kernels->name;
    }
}

// Whatever lanes its samples are of, a ray is what its lane's own sixteen would have it.
TEST(RayKernels, RaysOfManyLanesAreThoseOfEachLane) {
    Random random;
    for (const RayKernels* kernels : all_kernels())
        for (int turn = 0; turn < 50; ++turn) {
            const bool by_cosine = turn % 2;
            RayLanes lanes{};
            RaySamples samples{};
            std::vector<RaySource> sources;
            std::vector<Cone> cones;
            for (int lane = 0; lane < kSixteen; ++lane) {
                RaySource source = random.source();
                if (lane % 5 == 3) source.Ng = vec3(0.0f);
                if (lane % 7 == 2) source.in = vec3(0.0f);
                sources.push_back(source);
                cones.emplace_back(random.unit(), random.number(0.01f, 3), by_cosine);
                set_lane(lanes, lane, source);
                set_lane(lanes, lane, cones.back(), random.bits());
                fill(lanes.axis, lane, random.unit());
                lanes.straight[lane] = lane % 4 == 1;
                for (auto& row : lanes.carried) row[lane] = random.bits();
                samples.lane[lane] = random.bits() % kSixteen;
                samples.number[lane] = random.bits() % 1000;
            }
            SixteenRays rays;
            kernels->shoot(lanes, samples, {true, by_cosine, true}, rays);
            for (int i = 0; i < kSixteen; ++i) {
                const uint32_t lane = samples.lane[i], number = samples.number[i];
                SixteenRays own;
                if (lanes.straight[lane])
                    shoot(*kernels, sources[lane],
                          vec3(lanes.axis[0][lane], lanes.axis[1][lane], lanes.axis[2][lane]), own);
                else
                    shoot(*kernels, sources[lane], cones[lane], number, lanes.seed[lane], own);
                for (int k = 0; k < 3; ++k) {
                    ASSERT_EQ(rays.dir[k][i], own.dir[k][0]) << kernels->name;
                    ASSERT_EQ(rays.org[k][i], own.org[k][0]) << kernels->name;
                    ASSERT_EQ(rays.dDdx[k][i], own.dDdx[k][0]) << kernels->name;
                    ASSERT_EQ(rays.dDdy[k][i], own.dDdy[k][0]) << kernels->name;
                }
                ASSERT_EQ(rays.path[i], mix(lanes.seed[lane], number));
                for (int c = 0; c < kCarried; ++c)
                    ASSERT_EQ(rays.carried[c][i], lanes.carried[c][lane]);
            }
        }
}

TEST(RayKernels, LanesAreAimedAsConesAre) {
    Random random;
    for (const RayKernels* kernels : all_kernels()) {
        RayLanes lanes{};
        std::vector<Cone> cones;
        for (int lane = 0; lane < kSixteen; ++lane) {
            const vec3 axis = random.unit() * random.number(0.01f, 100);
            cones.emplace_back(axis, 1.0f, true);
            fill(lanes.axis, lane, axis);
        }
        kernels->aim(lanes);
        for (int lane = 0; lane < kSixteen; ++lane)
            for (int k = 0; k < 3; ++k) {
                EXPECT_EQ(lanes.x[k][lane], cones[size_t(lane)].x[k]) << kernels->name;
                EXPECT_EQ(lanes.y[k][lane], cones[size_t(lane)].y[k]) << kernels->name;
                EXPECT_EQ(lanes.z[k][lane], cones[size_t(lane)].z[k]) << kernels->name;
            }
    }
}

// A point that is the hit's keeps the hit's error and normal; one beside it has the error of its
// way through another space, which brute force in double stays within.
TEST(RayKernels, PointsBesideTheirHitsStartOnNoSurface) {
    Random random;
    for (const RayKernels* kernels : all_kernels())
        for (int turn = 0; turn < 50; ++turn) {
            const vec3 x = random.unit(), side = random.unit();
            const vec3 y = glm::normalize(glm::cross(x, side)), z = glm::cross(x, y);
            const mat3 M(x, y, z);
            const vec3 eye = random.unit() * 20.0f;
            RayLanes lanes{};
            float at[3][kSixteen];
            std::vector<RaySource> sources;
            for (int lane = 0; lane < kSixteen; ++lane) {
                sources.push_back(random.source());
                set_lane(lanes, lane, sources.back());
                vec3 P = M * (sources.back().P - eye);
                if (lane % 3 == 0) P[lane % 2] += 0.01f;
                fill(at, lane, P);
            }
            kernels->start(&M[0][0], &eye.x, at, lanes);
            for (int lane = 0; lane < kSixteen; ++lane) {
                const RaySource& hit = sources[size_t(lane)];
                dvec3 P = glm::transpose(dmat3(M)) * dvec3(at[0][lane], at[1][lane], at[2][lane]) +
                          dvec3(eye);
                for (int k = 0; k < 3; ++k) {
                    EXPECT_NEAR(lanes.P[k][lane], P[k], lanes.error[k][lane] + 1e-5);
                    EXPECT_EQ(lanes.Ng[k][lane], lane % 3 ? hit.Ng[k] : 0) << kernels->name;
                    if (lane % 3) {
                        EXPECT_EQ(lanes.error[k][lane], hit.error[k]);
                        EXPECT_EQ(lanes.P[k][lane], hit.P[k]);
                    }
                }
            }
        }
}

}  // namespace
}  // namespace kinora
