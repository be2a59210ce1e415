// tests/runtime/picture/lights/light_tree_test.cpp: the choice among many lamps against sums over
// all of them in double precision.
#include "runtime/picture/lights/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

namespace kinora {
namespace {

using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// The formulas of collada_point and collada_spot, once more.
double light_of(const Lamp& lamp, dvec3 P) {
    const dvec3 way = P - dvec3(lamp.position);
    const double d = glm::length(way);
    const double light = lamp.strength / (lamp.fall[0] + d * (lamp.fall[1] + d * lamp.fall[2]));
    const double cosine = glm::dot(way, dvec3(lamp.axis)) / d;
    if (cosine < lamp.edge) return 0;
    return lamp.exponent > 0 ? light * std::pow(cosine, lamp.exponent) : light;
}

struct Ball {
    dvec3 center;
    double radius;
};

bool is_free(dvec3 from, dvec3 to, const std::vector<Ball>& balls) {
    const dvec3 way = to - from;
    return std::ranges::none_of(balls, [&](const Ball& ball) {
        const double t =
            std::clamp(glm::dot(ball.center - from, way) / glm::dot(way, way), 0.0, 1.0);
        return glm::length(from + t * way - ball.center) < ball.radius;
    });
}

struct World {
    std::vector<Lamp> lamps;
    std::vector<Ball> balls;
    std::vector<dvec3> points;  // of a floor that looks up, along z
    LightTree tree;
};

// Points on the floor of a field, and balls over it.
void add_field(World& world, double size, double ball_radius, int balls, Random& random) {
    for (int k = 0; k < balls; ++k)
        world.balls.push_back(
            {{uniform(random, 0, size), uniform(random, 0, size), uniform(random, 0, 2)},
             ball_radius});
    while (world.points.size() < 200)
        world.points.emplace_back(uniform(random, 0, size), uniform(random, 0, size), 0);
    world.tree.build(world.lamps);
}

Lamp lamp_at(dvec3 place, double strength) {
    Lamp lamp;
    lamp.position = vec3(place);
    lamp.strength = float(strength);
    lamp.fall[0] = 0.01f;
    lamp.fall[2] = 1;
    return lamp;
}

World row_of_lamps() {
    Random random(1);
    World world;
    for (int k = 0; k < 100; ++k) world.lamps.push_back(lamp_at({k * 0.5, 25, 3}, 1));
    add_field(world, 50, 1, 60, random);
    return world;
}

World city() {
    Random random(2);
    World world;
    for (int k = 0; k < 1000; ++k)
        world.lamps.push_back(
            lamp_at({uniform(random, 0, 100), uniform(random, 0, 100), uniform(random, 0.5, 6)},
                    std::pow(10.0, uniform(random, -2, 2))));
    add_field(world, 100, 2, 120, random);
    return world;
}

World spots() {
    Random random(3);
    World world;
    for (int k = 0; k < 400; ++k) {
        Lamp lamp = lamp_at({uniform(random, 0, 60), uniform(random, 0, 60), 5}, 1);
        lamp.axis =
            vec3(glm::normalize(dvec3(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), -1)));
        lamp.edge = float(std::cos(kPi / 180 * uniform(random, 20, 70)));
        lamp.exponent = float(uniform(random, 0, 4));
        world.lamps.push_back(lamp);
    }
    add_field(world, 60, 1.5, 80, random);
    return world;
}

// What a point has of each lamp, with the cosine of the floor and without shadows; and shadowed.
struct PointLight {
    std::vector<double> open, shown;
    double all = 0, sum = 0;  // of both
};

PointLight light_at(const World& world, dvec3 P) {
    PointLight light;
    for (const Lamp& lamp : world.lamps) {
        const dvec3 way = dvec3(lamp.position) - P;
        light.open.push_back(light_of(lamp, P) * std::max(way.z / glm::length(way), 0.0));
        light.shown.push_back(is_free(P, dvec3(lamp.position), world.balls) ? light.open.back()
                                                                            : 0);
        light.all += light.open.back();
        light.sum += light.shown.back();
    }
    return light;
}

// A point of the floor with sixteen of evenly spread starts, from the first on.
LampPoints starts_at(dvec3 P, int first, int starts) {
    LampPoints points;
    points.count = kLampPoints;
    for (size_t p = 0; p < kLampPoints; ++p) {
        for (int k = 0; k < 3; ++k) points.P[k][p] = float(P[k]);
        points.side[2][p] = 1;
        points.start[p] = float((first + int(p) + 0.5) / starts);
    }
    return points;
}

struct Moments {
    double mean = 0, variance = 0;
};

// Over evenly spread starts.
Moments moments(const World& world, dvec3 P, const PointLight& light, size_t lamps) {
    constexpr int kStarts = 256;
    Arena arena;
    std::vector<ChosenLamp> chosen(lamps * kLampPoints);
    double sum = 0, squares = 0;
    for (int k = 0; k < kStarts; k += kLampPoints) {
        const size_t count = world.tree.choose(starts_at(P, k, kStarts), lamps, arena, chosen);
        double value[kLampPoints] = {};
        for (const ChosenLamp& c : std::span(chosen).first(count))
            value[c.point] += double(c.weight) * light.shown[c.lamp];
        for (double v : value) {
            sum += v;
            squares += (v - light.sum) * (v - light.sum);
        }
    }
    return {sum / kStarts, squares / kStarts};
}

struct Choice {
    double own = 0, independent = 0;  // variances of all points, by the square of their light
};

Choice compare(const World& world, size_t lamps) {
    Choice choice;
    for (dvec3 P : world.points) {
        const PointLight light = light_at(world, P);
        if (!(light.all > 0)) continue;
        const Moments own = moments(world, P, light, lamps);
        EXPECT_NEAR(own.mean, light.sum, 0.01 * light.all);
        choice.own += own.variance / (light.all * light.all);
        // E. Veach 1997: of one sample of probability f / S, the square's mean is S times the sum.
        choice.independent += (light.all * light.sum - light.sum * light.sum) / double(lamps) /
                              (light.all * light.all);
    }
    return choice;
}

void expect_little_noise(const World& world, size_t lamps) {
    const Choice choice = compare(world, lamps);
    EXPECT_LT(choice.own, 1.5 * choice.independent) << choice.own / choice.independent;
    testing::Test::RecordProperty("ratio", std::to_string(choice.own / choice.independent));
}

// Of N independent choices in proportion to the light that each lamp sends without shadows.
TEST(LightTree, AddsLittleNoiseInARowOfLamps) {
    expect_little_noise(row_of_lamps(), 8);
}
TEST(LightTree, AddsLittleNoiseInACity) {
    expect_little_noise(city(), 8);
}
TEST(LightTree, AddsLittleNoiseUnderSpots) {
    expect_little_noise(spots(), 8);
}

// Each point is alone: what it chooses does not depend on the others, nor on the kernels.
TEST(LightTree, ChoosesForEachPointAlone) {
    const World world = city();
    Arena arena;
    std::vector<ChosenLamp> all(8 * kLampPoints), one(8 * kLampPoints);
    LampPoints points;
    points.count = kLampPoints;
    for (size_t p = 0; p < kLampPoints; ++p) {
        for (int k = 0; k < 3; ++k) points.P[k][p] = float(world.points[p][k]);
        points.side[2][p] = p % 2 ? 1.0f : 0.0f;
        points.start[p] = float(p) / kLampPoints;
    }
    const size_t count = world.tree.choose(points, 8, arena, all);
    for (size_t p = 0; p < kLampPoints; ++p) {
        LampPoints alone;
        alone.count = 1;
        for (int k = 0; k < 3; ++k) {
            alone.P[k][0] = points.P[k][p];
            alone.side[k][0] = points.side[k][p];
        }
        alone.start[0] = points.start[p];
        const size_t own = world.tree.choose(alone, 8, arena, one);
        EXPECT_EQ(own, 8u);
        size_t next = 0;
        for (const ChosenLamp& c : std::span(all).first(count)) {
            if (c.point != p) continue;
            ASSERT_LT(next, own);
            EXPECT_EQ(c.lamp, one[next].lamp);
            EXPECT_EQ(c.weight, one[next++].weight);
        }
        EXPECT_EQ(next, own);
    }
}

// All instruction sets see the same light, bit for bit.
TEST(LampKernels, GiveTheSameBits) {
    Random random(6);
    for (int round = 0; round < 200; ++round) {
        LampLanes lanes;
        lanes.cones = round % 2;
        for (size_t i = 0; i < kLampLanes; ++i) {
            for (int k = 0; k < 3; ++k) {
                lanes.center[k][i] = float(uniform(random, -2, 2));
                lanes.axis[k][i] = float(uniform(random, -0.6, 0.6));
                lanes.fall[k][i] = float(uniform(random, 0, 1));
            }
            lanes.radius[i] = i % 2 ? float(uniform(random, 0, 1)) : 0;
            lanes.spread[i] = 0.3f * lanes.radius[i];
            lanes.strength[i] = float(uniform(random, 0, 3));
            lanes.range[i] = float(uniform(random, 1, 4));
            lanes.edge[i] = float(uniform(random, -1.2, 1));
            lanes.slope[i] = float(uniform(random, -1, 4));
            lanes.exponent[i] = float(uniform(random, -1, 20));
        }
        const float P[] = {0.1f, 0.2f, 0.3f}, side[] = {0, 0, round % 3 ? 1.0f : 0.0f};
        float light[kLampLanes], doubt[kLampLanes];
        lamp_kernels().see(lanes, P, side, light, doubt);
        for (size_t k = 0; k < usable_lamp_kernels().count; ++k) {
            float other_light[kLampLanes], other_doubt[kLampLanes];
            usable_lamp_kernels().kernels[k]->see(lanes, P, side, other_light, other_doubt);
            EXPECT_EQ(std::memcmp(light, other_light, sizeof(light)), 0) << k;
            EXPECT_EQ(std::memcmp(doubt, other_doubt, sizeof(doubt)), 0) << k;
        }
    }
}

TEST(LightTree, TakesFewLampsForCertain) {
    World world;
    for (int k = 0; k < 5; ++k) world.lamps.push_back(lamp_at({k, 0, 1}, k));
    world.tree.build(world.lamps);
    Arena arena;
    std::vector<ChosenLamp> chosen(8 * kLampPoints);
    const size_t count = world.tree.choose(starts_at({0, 0, 0}, 0, 16), 8, arena, chosen);
    EXPECT_EQ(count, 4u * 16);  // one has no strength
    for (const ChosenLamp& c : std::span(chosen).first(count)) {
        EXPECT_NE(c.lamp, 0u);
        EXPECT_EQ(c.weight, 1);
    }
    world.tree.build({});
    EXPECT_TRUE(world.tree.empty());
    EXPECT_EQ(world.tree.choose(starts_at({0, 0, 0}, 0, 16), 8, arena, chosen), 0u);
}

// A point in a lamp, points at no place, lamps at one place.
TEST(LightTree, TakesPointsAndLampsAnywhere) {
    World world;
    for (int k = 0; k < 100; ++k) {
        Lamp lamp = lamp_at({1, 2, 3}, k + 1);
        lamp.fall[0] = 0;
        world.lamps.push_back(lamp);
    }
    world.tree.build(world.lamps);
    Arena arena;
    std::vector<ChosenLamp> chosen(4 * kLampPoints);
    const dvec3 places[] = {{1, 2, 3}, {NAN, 0, 0}, {INFINITY, 0, 0}, {1e30, 0, 0}, {1, 2, 3.001}};
    for (const dvec3 place : places)
        for (const ChosenLamp& c : std::span(chosen).first(
                 world.tree.choose(starts_at(place, 0, 16), 4, arena, chosen))) {
            EXPECT_LT(c.lamp, 100u);
            EXPECT_TRUE(c.weight >= 1 && std::isfinite(c.weight)) << c.weight;
        }
}

}  // namespace
}  // namespace kinora
