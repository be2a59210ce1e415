// tests/runtime/picture/lights/reach_test.cpp: cones and ranges against points in spheres.
#include "runtime/picture/lights/reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace kinora {
namespace {

dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
}

bool lights(const LightReach& light, double half_angle, dvec3 p) {
    const dvec3 way = p - light.apex;
    const double distance = glm::length(way);
    return distance <= light.range && std::acos(glm::dot(way, light.axis) / distance) <= half_angle;
}

// Never false where some point of the sphere is lit, and false for most that are not.
TEST(LightReach, IsNeverTooShortAndSeldomTooLong) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    int unlit = 0, told = 0;
    for (int round = 0; round < 900; ++round) {
        LightReach light;
        light.apex = 5.0 * random_direction(random);
        light.axis = random_direction(random);
        const double half_angle = round % 3 != 0 ? kPi * uniform(random) : kPi;
        light.set_cone(half_angle);
        if (round % 3 != 1) light.range = 8 * uniform(random);
        const Sphere sphere{6.0 * uniform(random) * random_direction(random), uniform(random)};
        bool lit = false;
        for (int k = 0; k < 1000 && !lit; ++k)
            lit = lights(light, half_angle,
                         sphere.center +
                             sphere.radius * std::cbrt(uniform(random)) * random_direction(random));
        EXPECT_TRUE(!lit || reaches(light, sphere)) << round;
        unlit += !lit;
        told += !reaches(light, sphere);
    }
    EXPECT_GT(unlit, 300);
    EXPECT_GT(told, 0.97 * unlit);
}

// A floor around the foot of a lamp that looks up, of which a sphere holds more.
TEST(LightReach, ALampThatLooksAwayFromABoxDoesNotReachIt) {
    const float x[] = {-9, 9, 9}, y[] = {-9, -9, 9}, z[] = {0, 0, 0.5f};
    const float* P[] = {x, y, z};
    const Sphere floor = sphere_about(P, 3);
    LightReach light{.apex = dvec3(0, 0, 1)};
    light.set_cone(1.5);
    EXPECT_FALSE(reaches(light, floor));
    EXPECT_TRUE(reaches(light, {floor.center, floor.radius}));
    light.apex.z = 0.45;
    EXPECT_TRUE(reaches(light, floor));
    light.apex.z = 1, light.set_cone(1.6);  // it sends light below itself too
    EXPECT_TRUE(reaches(light, floor));
    light.set_cone(1.5), light.axis = {0, 0, -1};
    EXPECT_TRUE(reaches(light, floor));
    light.black = true;
    EXPECT_FALSE(reaches(light, floor));
}

TEST(LightReach, IsBoundedByAConeOrARange) {
    LightReach light;
    EXPECT_FALSE(light.bounded());
    EXPECT_TRUE(reaches(light, {dvec3(1e30), 0}));
    light.set_cone(3);
    EXPECT_TRUE(light.bounded());
}

TEST(LightReach, ASphereHoldsItsPoints) {
    const float x[] = {1, 3, 2}, y[] = {-1, 0, 0}, z[] = {0, 0, 4};
    const float* P[] = {x, y, z};
    const Sphere s = sphere_about(P, 3);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_LE(glm::length(dvec3(x[i], y[i], z[i]) - s.center), s.radius);
    EXPECT_DOUBLE_EQ(s.radius, 0.5 * std::sqrt(4.0 + 1 + 16));
}

}  // namespace
}  // namespace kinora
