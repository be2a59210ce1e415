// tests/runtime/picture/lights/unseen_light_test.cpp: lights that are dropped, against the
// definition.
#include "runtime/picture/lights/unseen_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "rsl/lower/lower.h"
#include "runtime/base/math.h"

namespace kinora {
namespace {

using rsl::LitSide;
using Column = std::vector<float>;

struct Light {
    Column L[3], Cl[3];
    bool casts = true;
    SentLight sent() {
        SentLight s;
        s.casts = casts;
        for (size_t k = 0; k < 3; ++k) s.L[k] = L[k].data(), s.Cl[k] = Cl[k].data();
        return s;
    }
};

// ---- the weakest lights

struct Lights {
    std::vector<Light> lights;
    std::vector<std::vector<float>> before;  // largest component, [light][point]

    Lights(size_t n, size_t points, uint32_t seed, float spread, bool some_cast_none = false) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> from(0, 1);
        for (size_t l = 0; l < n; ++l) {
            Light& light = lights.emplace_back();
            std::vector<float>& most = before.emplace_back();
            light.casts = !some_cast_none || l % 3 != 0;
            for (size_t i = 0; i < points; ++i) {
                const float strength = std::exp2(-spread * from(random));
                const float c[3] = {strength, 0.5f * strength, from(random) * strength};
                for (size_t k = 0; k < 3; ++k) light.Cl[k].push_back(c[(k + l) % 3]);
                most.push_back(strength);
            }
            for (auto& row : light.L) row.assign(points, 1);
        }
    }
    void drop(float share) {
        Arena arena;
        std::vector<SentLight> sent;
        for (Light& light : lights) sent.push_back(light.sent());
        drop_weak(share, before[0].size(), arena, sent);
    }
    bool dark(size_t l, size_t i) const {
        return lights[l].Cl[0][i] == 0 && lights[l].Cl[1][i] == 0 && lights[l].Cl[2][i] == 0;
    }
};

// What is dropped stays under the share; what is kept keeps its bits; and one exponent more would
// have been too much.
TEST(WeakLights, StayUnderTheirShareAndAreTheWeakest) {
    const float share = 0x1p-9f;
    for (uint32_t seed = 0; seed < 20; ++seed) {
        Lights made(2 + seed * 5, 37, seed, 4.0f + float(seed), seed % 2 == 1);
        const std::vector<Light> old = made.lights;
        made.drop(share);
        for (size_t i = 0; i < 37; ++i) {
            double sum = 0, gone = 0, weakest_kept = 1e30, strongest_gone = 0, next = 0;
            for (size_t l = 0; l < made.lights.size(); ++l) {
                const double x = double(made.before[l][i]);
                sum += x;
                if (made.dark(l, i)) {
                    EXPECT_TRUE(made.lights[l].casts);
                    gone += x;
                    strongest_gone = std::max(strongest_gone, x);
                } else {
                    for (size_t k = 0; k < 3; ++k)
                        EXPECT_EQ(made.lights[l].Cl[k][i], old[l].Cl[k][i]);
                    if (made.lights[l].casts) weakest_kept = std::min(weakest_kept, x);
                }
            }
            EXPECT_LE(gone, double(share) * sum * (1 + 1e-5)) << seed;
            EXPECT_LT(strongest_gone, weakest_kept);
            // The kept ones of the weakest kept exponent would not have fitted.
            for (size_t l = 0; l < made.lights.size(); ++l)
                if (!made.dark(l, i) && made.lights[l].casts &&
                    std::ilogb(made.before[l][i]) == std::ilogb(weakest_kept))
                    next += double(made.before[l][i]);
            EXPECT_GT(gone + next, double(share) * sum * (1 - 1e-5)) << seed;
        }
    }
}

TEST(WeakLights, AreKeptWhereTheShareIsNoneOrOneLightIsAlone) {
    Lights many(30, 5, 1, 20), one(1, 5, 2, 20);
    many.drop(0);
    one.drop(0.5f);
    for (size_t i = 0; i < 5; ++i) {
        for (size_t l = 0; l < 30; ++l) EXPECT_FALSE(many.dark(l, i));
        EXPECT_FALSE(one.dark(0, i));
    }
}

TEST(WeakLights, LeaveWhatIsNoNumber) {
    const float inf = std::numeric_limits<float>::infinity();
    Lights made(3, 2, 3, 0);
    made.lights[0].Cl[1][0] = inf;
    made.lights[1].Cl[2][0] = std::nanf("");
    made.lights[2].Cl[0][0] = made.lights[2].Cl[1][0] = made.lights[2].Cl[2][0] = 1e-30f;
    made.drop(0.002f);
    EXPECT_EQ(made.lights[0].Cl[1][0], inf);
    EXPECT_TRUE(std::isnan(made.lights[1].Cl[2][0]));
    EXPECT_EQ(made.lights[2].Cl[0][0], 1e-30f);  // alone among numbers
}

// ---- lights behind

struct Asked {
    vec3 N, Ng, I;
    int sides;
    vec3 L;
    bool dropped;
};

// A light from the other side of all that the kernel looks about; nothing near the edges.
TEST(LightsBehind, AreDroppedWhereEveryLoopLooksAway) {
    const vec3 up(0, 0, 2), down(0, 0, -3), slant(5, 0, 1), below(5, 0, -1), edge(1, 0, -5e-5f);
    const vec3 from_above(0, 1, -1), from_below(0, 1, 1), along(1, 0, 0);
    using enum LitSide;
    const Asked kAsked[] = {
        {up, up, from_above, kLitN, down, true},
        {up, up, from_above, kLitN, below, true},
        {up, up, from_above, kLitN, slant, false},
        {up, up, from_above, kLitN, edge, false},
        {up, up, from_above, kLitBehindN, down, false},
        {up, up, from_above, kLitBehindN, slant, true},
        {up, up, from_above, kLitN | kLitBehindN, down, false},
        {up, up, from_above, kLitAround, down, false},
        {up, up, from_above, kLitN | kLitAround, down, false},
        {up, up, from_above, 0, up, true},  // no loop looks at it
        {up, up, from_above, kLitFacing, down, true},
        {up, up, from_above, kLitFacing, slant, false},
        {up, up, from_below, kLitFacing, down, false},
        {up, up, from_below, kLitFacing, slant, true},
        {up, down, from_below, kLitFacing, down, true},  // by Ng
        {up, down, from_below, kLitFacingByN, down, false},
        {up, down, from_above, kLitFacing, down, false},
        {up, up, from_above, kLitAverted, slant, true},
        {up, up, from_above, kLitAvertedByN, slant, true},
        {up, up, from_above, kLitAvertedByN, down, false},
        {up, up, from_above, kLitFacing | kLitAverted, down, false},
        {up, up, along, kLitFacing, down, false},  // which side the eye is on is not sure
        {up, up, along, kLitFacing, slant, false},
        {vec3(0), up, from_above, kLitN, down, false},
    };
    for (const Asked& a : kAsked) {
        Arena arena;
        SeenPoints points;
        points.count = 1;
        points.sides = uint8_t(a.sides);
        Light light;
        for (int k = 0; k < 3; ++k) {
            points.N[k] = &a.N[k], points.Ng[k] = &a.Ng[k], points.I[k] = &a.I[k];
            light.L[k] = {a.L[k]}, light.Cl[k] = {0.25f};
        }
        const SentLight sent[] = {light.sent()};
        drop_behind(points, arena, sent);
        EXPECT_EQ(light.Cl[1][0], a.dropped ? 0 : 0.25f) << &a - kAsked;
        // Light that casts no shadow costs no ray.
        Light free = light;
        free.casts = false, free.Cl[1] = {0.5f};
        const SentLight sent_free[] = {free.sent()};
        drop_behind(points, arena, sent_free);
        EXPECT_EQ(free.Cl[1][0], 0.5f);
    }
}

TEST(LightsBehind, StayWhereColumnsAreMissing) {
    Arena arena;
    const float zero = 0, one = 1;
    SeenPoints points;
    points.count = 1;
    points.sides = rsl::kLitFacing;
    for (size_t k = 0; k < 3; ++k)
        points.N[k] = k == 2 ? &one : &zero, points.Ng[k] = nullptr, points.I[k] = nullptr;
    Light light;
    for (size_t k = 0; k < 3; ++k) light.L[k] = {k == 2 ? -1.0f : 0.0f}, light.Cl[k] = {1};
    const SentLight sent[] = {light.sent()};
    drop_behind(points, arena, sent);
    EXPECT_EQ(light.Cl[0][0], 1);
}

}  // namespace
}  // namespace kinora
