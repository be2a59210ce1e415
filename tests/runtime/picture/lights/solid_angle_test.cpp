// tests/runtime/picture/lights/solid_angle_test.cpp: shapes of lamps, and samples of the directions
// in which they are seen.
#include "runtime/picture/lights/solid_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "runtime/picture/lights/angles.h"

namespace kinora {
namespace {

using Corners = std::vector<dvec3>;

TEST(Angles, AreThoseOfTheLibrary) {
    for (int k = -4000; k <= 4000; ++k) {
        const double angle = k * 0.0023;
        EXPECT_NEAR(sine_cosine(angle).sine, std::sin(angle), 2e-15) << angle;
        EXPECT_NEAR(sine_cosine(angle).cosine, std::cos(angle), 2e-15) << angle;
    }
    for (double size : {1e-200, 1e-9, 1.0, 1e9})
        for (int k = 0; k <= 2000; ++k) {
            const double angle = kPi * k / 2000, x = std::cos(angle), y = std::abs(std::sin(angle));
            const double want = std::atan2(size * y, x);
            EXPECT_NEAR(angle_of(size * y, x), want, 1e-15 * want) << k << " " << size;
        }
    EXPECT_EQ(angle_of(0, 0), 0);
}

// ---- shapes -------------------------------------------------------------------------------------

// A rectangle of cells from `low` to `high` in the plane z = 0; `cell` moves or drops corners.
Corners grid(dvec2 low, dvec2 high, int cells) {
    Corners corners;
    auto at = [&](int x, int y) {
        return dvec3(low + (high - low) * dvec2(x, y) / double(cells), 0);
    };
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
            for (const dvec3& p : {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y),
                                   at(x + 1, y + 1), at(x, y + 1)})
                corners.push_back(p);
    return corners;
}

Corners ball(int rings, int sectors, double radius = 1) {
    Corners corners;
    auto at = [&](int i, int j) {
        const double down = kPi * i / rings, turn = 2 * kPi * j / sectors;
        return radius * dvec3(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn),
                              std::cos(down));
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j)
            for (const dvec3& p : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j),
                                   at(i + 1, j + 1), at(i, j + 1)})
                corners.push_back(p);
    return corners;
}

// As floats hold them, as the ray tracer does.
Corners placed(Corners corners, const dmat4& M) {
    for (dvec3& p : corners) p = dvec3(vec3(dvec3(M * dvec4(p, 1))));
    return corners;
}

dmat4 turned(dvec3 by, double degrees, dvec3 size = dvec3(1.0)) {
    const dmat4 M = glm::translate(dmat4(1.0), by) *
                    glm::rotate(dmat4(1.0), glm::radians(degrees), glm::normalize(dvec3(1, 2, 3)));
    return glm::scale(M, size);
}

LampShape::Kind kind_of(const Corners& corners) {
    return find_lamp_shape(corners).kind;
}

TEST(LampShapes, OfRectanglesAreFoundWhereverTheyStand) {
    for (int cells : {1, 2, 7})
        for (const dmat4& M :
             {dmat4(1.0), turned({3, -2, 9}, 40), turned({300, 100, 5}, 77),
              turned({0, 0, 0}, 10, {1e-6, 1e-6, 1e-6}), turned({0, 0, 0}, 10, {1e6, 1e4, 1})}) {
            const LampShape shape = find_lamp_shape(placed(grid({-1, -0.3}, {1, 0.3}, cells), M));
            ASSERT_EQ(shape.kind, LampShape::Kind::Rectangle) << cells;
            const double sides = shape.side[0] * shape.side[1];
            const double area = 1.2 * glm::length(glm::cross(dvec3(M * dvec4(1, 0, 0, 0)),
                                                             dvec3(M * dvec4(0, 1, 0, 0))));
            EXPECT_NEAR(sides / area, 1, 1e-4);
        }
}

TEST(LampShapes, ThatAreNoRectanglesAreOther) {
    const Corners whole = grid({0, 0}, {1, 1}, 4);
    dmat4 shear(1.0);
    shear[1][0] = 0.1;
    Corners hole = whole, bent = whole, doubled = whole, trapezoid = whole;
    hole.erase(hole.begin() + 36, hole.begin() + 42);
    for (dvec3& p : bent) p.z = 0.01 * p.x * p.x;
    doubled.insert(doubled.end(), whole.begin(), whole.begin() + 6);
    for (dvec3& p : trapezoid) p.x *= 1 - 0.2 * p.y;
    for (const Corners& corners : {placed(whole, shear), hole, bent, doubled, trapezoid})
        EXPECT_EQ(kind_of(corners), LampShape::Kind::Other);
    EXPECT_EQ(kind_of(placed(whole, turned({1e6, 0, 0}, 30))), LampShape::Kind::Other);
}

TEST(LampShapes, OfSpheresAreFoundWhereverTheyStand) {
    for (const dmat4& M : {dmat4(1.0), turned({3, -2, 9}, 40), turned({200, 100, 5}, 77),
                           turned({0, 0, 0}, 10, dvec3(1e-6))}) {
        const LampShape shape = find_lamp_shape(placed(ball(8, 16), M));
        ASSERT_EQ(shape.kind, LampShape::Kind::Sphere);
        const double size = glm::length(dvec3(M[0]));
        EXPECT_NEAR(shape.radius / size, 1, 1e-4);
        EXPECT_LE(glm::length(shape.center - dvec3(M[3])), 1e-4 * size);
    }
}

TEST(LampShapes, ThatAreNoSpheresAreOther) {
    Corners half = ball(8, 16);
    half.resize(half.size() / 2);
    Corners dented = ball(8, 16);
    for (dvec3& p : dented)
        if (p.z > 0.999) p.z = 0.9;
    EXPECT_EQ(kind_of(placed(ball(8, 16), turned({0, 0, 0}, 0, {1, 1, 1.01}))),
              LampShape::Kind::Other);
    EXPECT_EQ(kind_of(half), LampShape::Kind::Other);
    EXPECT_EQ(kind_of(dented), LampShape::Kind::Other);
    EXPECT_EQ(kind_of(ball(2, 4)), LampShape::Kind::Other);  // 8 faces have .55 of the area
    EXPECT_EQ(kind_of({}), LampShape::Kind::Other);
    EXPECT_EQ(kind_of(Corners(9, dvec3(1.0))), LampShape::Kind::Other);
}

// ---- directions ---------------------------------------------------------------------------------

// A. Van Oosterom and J. Strackee 1983.
double angle_of_triangle(dvec3 a, dvec3 b, dvec3 c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double over = glm::dot(a, glm::cross(b, c)),
                 under =
                     la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    return 2 * std::atan2(std::abs(over), under);
}

// Of a polygon, the integral of directions over its solid angle: a sum over its edges (J. Lambert
// 1760).
dvec3 integral_of_directions(const Corners& polygon) {
    dvec3 sum(0.0);
    for (size_t k = 0; k < polygon.size(); ++k) {
        const dvec3 across = glm::cross(polygon[k], polygon[(k + 1) % polygon.size()]);
        const double sine = glm::length(across);
        if (sine > 0)
            sum +=
                across *
                (0.5 * std::atan2(sine, glm::dot(polygon[k], polygon[(k + 1) % polygon.size()])) /
                 sine);
    }
    return sum;
}

constexpr int kSteps = 400;

// The mean of unit directions of samples at the middles of a grid.
dvec3 mean_direction(const SolidAngle& seen) {
    dvec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j)
            sum += glm::normalize(seen.sample((i + 0.5) / kSteps, (j + 0.5) / kSteps).direction);
    return sum / double(kSteps * kSteps);
}

TEST(SolidAngles, OfRectanglesAreEvenFromTinyOnesToHalfTheSky) {
    const Corners polygon = {{-1, -0.3, 0}, {1, -0.3, 0}, {1, 0.3, 0}, {-1, 0.3, 0}};
    const LampShape shape = find_lamp_shape(grid({-1, -0.3}, {1, 0.3}, 1));
    for (const dvec3& P : {dvec3(0.2, 0.1, 1), dvec3(0.2, 0.1, -1), dvec3(0, 0, 1e-3),
                           dvec3(1, 0.3, 1e-2), dvec3(1, 0, 0.5), dvec3(-0.999, 0.299, 1e-4),
                           dvec3(3, 2, 1e-2), dvec3(40, 300, 500), dvec3(0.5, 0.3, 2)}) {
        Corners from = polygon;
        for (dvec3& p : from) p -= P;
        const double angle = angle_of_triangle(from[0], from[1], from[2]) +
                             angle_of_triangle(from[0], from[2], from[3]);
        const SolidAngle seen(shape, P);
        EXPECT_NEAR(seen.density() * angle, 1, 1e-7) << P.x << " " << P.z;
        const dvec3 want = integral_of_directions(from) * (P.z > 0 ? -1.0 : 1.0) / angle;
        const dvec3 got = mean_direction(seen);
        EXPECT_LE(glm::length(got - want), 1e-4 * glm::length(want)) << P.x << " " << P.z;
    }
}

// A sample lies on the rectangle, and within the range that its ray is given.
TEST(SolidAngles, SamplesLieOnTheRectangle) {
    const LampShape shape = find_lamp_shape(grid({-1, -0.3}, {1, 0.3}, 1));
    for (const dvec3& P : {dvec3(0.2, 0.1, 1), dvec3(0, 0, 1e-5), dvec3(1, 0.3, -1e-4)})
        for (int k = 0; k < 4096; ++k) {
            const SolidAngle::Way way =
                SolidAngle(shape, P).sample((k % 64) / 63.999, (k / 64) / 63.999);
            const dvec3 at = P + way.direction;
            EXPECT_LE(std::abs(at.x), 1 + 1e-9);
            EXPECT_LE(std::abs(at.y), 0.3 + 1e-9);
            EXPECT_NEAR(at.z, 0, 1e-12);
            EXPECT_TRUE(way.near < 1 && 1 < way.far);
        }
}

TEST(SolidAngles, OfSpheresAreEvenInTheirCones) {
    const LampShape shape = find_lamp_shape(ball(8, 16));
    for (double distance : {1.001, 1.2, 3.0, 1e3, 9e4}) {
        const dvec3 axis = glm::normalize(dvec3(1, -2, 0.5));
        const SolidAngle seen(shape, distance * axis);
        const double sine2 = 1 / (distance * distance), cosine = std::sqrt(1 - sine2);
        const double opening = sine2 / (1 + cosine);
        EXPECT_NEAR(seen.density() * 2 * kPi * opening, 1, 1e-9);
        const dvec3 mean = mean_direction(seen);
        EXPECT_LE(glm::length(mean + axis * (1 - 0.5 * opening)), 1e-6) << distance;
        for (int k = 0; k < 1024; ++k) {
            const SolidAngle::Way way = seen.sample((k % 32) / 31.999, (k / 32) / 31.999);
            EXPECT_LE(1 + glm::dot(way.direction, axis), opening * (1 + 1e-6) + 1e-15);
        }
    }
}

// There the caller takes samples by area.
TEST(SolidAngles, AreLeftOutWhereTheyAreTooSmallOrTheLampTooNear) {
    const LampShape square = find_lamp_shape(grid({-1, -1}, {1, 1}, 1)),
                    sphere = find_lamp_shape(ball(8, 16));
    for (const dvec3& P : {dvec3(0, 0, 0), dvec3(0.5, 0, 1e-8), dvec3(5, 5, 0), dvec3(0, 0, 1e6)})
        EXPECT_EQ(SolidAngle(square, P).density(), 0) << P.x << " " << P.z;
    for (double distance : {0.0, 0.5, 1.0, 1e6})
        EXPECT_EQ(SolidAngle(sphere, {0, 0, distance}).density(), 0) << distance;
    EXPECT_EQ(SolidAngle(LampShape{}, {0, 0, 1}).density(), 0);
}

}  // namespace
}  // namespace kinora
