// tests/runtime/picture/lights/solid_angle_test.cpp: shapes of lamps, and samples of the directions
// in which they are seen.
#include "runtime/picture/lights/solid_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <string>
#include <vector>

#include "runtime/picture/lights/angles.h"

namespace kinora {
namespace {

using Corners = std::vector<dvec3>;

TEST(Angles, AreThoseOfTheLibrary) {
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

// All kernels that this CPU runs; what they give is the same.
class SolidAngles : public testing::TestWithParam<size_t> {
  protected:
    const AngleKernels& kernels() const { return *usable_angle_kernels().kernels[GetParam()]; }

    // From P to samples at the middles of a grid of steps x steps; of a rectangle as they are.
    std::vector<dvec3> ways(const LampShape& shape, dvec3 P, int steps) const {
        const SolidAngle seen(shape, P);
        const bool sphere = shape.kind == LampShape::Kind::Sphere;
        RectangleLanes rectangles;
        SphereLanes spheres;
        for (size_t lane = 0; lane < kAngleLanes; ++lane)
            sphere ? seen.put(spheres, lane) : seen.put(rectangles, lane);
        std::vector<dvec3> found;
        for (int k = 0; k < steps * steps; k += int(kAngleLanes)) {
            AngleLanes u, v, at[3];
            for (int j = 0; j < int(kAngleLanes); ++j) {
                u[j] = ((k + j) % steps + 0.5) / steps;
                v[j] = ((k + j) / steps + 0.5) / steps;
            }
            if (sphere)
                kernels().to_spheres(spheres, u, v, at);
            else
                kernels().to_rectangles(rectangles, u, v, at[0], at[1]);
            for (size_t j = 0; j < kAngleLanes; ++j)
                found.push_back(sphere ? dvec3(at[0][j], at[1][j], at[2][j])
                                       : shape.corner + at[0][j] * shape.axis[0] +
                                             at[1][j] * shape.axis[1] - P);
        }
        return found;
    }

    dvec3 mean_direction(const LampShape& shape, dvec3 P) const {
        const std::vector<dvec3> all = ways(shape, P, 400);
        dvec3 sum(0.0);
        for (const dvec3& way : all) sum += glm::normalize(way);
        return sum / double(all.size());
    }
};
INSTANTIATE_TEST_SUITE_P(All, SolidAngles, testing::Range<size_t>(0, usable_angle_kernels().count),
                         [](const auto& kernel) {
                             return std::string(usable_angle_kernels().kernels[kernel.param]->name);
                         });

TEST_P(SolidAngles, OfRectanglesAreEvenFromTinyOnesToHalfTheSky) {
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
        const dvec3 got = mean_direction(shape, P);
        EXPECT_LE(glm::length(got - want), 1e-4 * glm::length(want)) << P.x << " " << P.z;
    }
}

TEST_P(SolidAngles, SamplesLieOnTheRectangle) {
    const LampShape shape = find_lamp_shape(grid({-1, -0.3}, {1, 0.3}, 1));
    for (const dvec3& P : {dvec3(0.2, 0.1, 1), dvec3(0, 0, 1e-5), dvec3(1, 0.3, -1e-4)})
        for (const dvec3& way : ways(shape, P, 64)) {
            const dvec3 at = P + way;
            EXPECT_LE(std::abs(at.x), 1 + 1e-9);
            EXPECT_LE(std::abs(at.y), 0.3 + 1e-9);
            EXPECT_NEAR(at.z, 0, 1e-12);
        }
}

// Places of a rectangle of triangles whose corners come in any order.
TEST_P(SolidAngles, FacetsAreThoseOfThePlaces) {
    Corners corners = placed(grid({-1, -0.3}, {1, 0.3}, 2), turned({3, -2, 9}, 40));
    for (size_t t = 0; t < 8; t += 3) std::swap(corners[3 * t], corners[3 * t + 1]);
    for (size_t t = 0; t < 8; t += 2) std::swap(corners[3 * t + 1], corners[3 * t + 2]);
    Corners whole = placed(grid({-1, -0.3}, {1, 0.3}, 2), turned({3, -2, 9}, 40));
    LampShape found = find_lamp_shape(whole);
    ASSERT_EQ(found.kind, LampShape::Kind::Rectangle);
    const std::vector<uint32_t> numbers = {7, 6, 5, 4, 3, 2, 1, 0};
    const PlaneFacets facets = facets_of(found, corners, numbers);
    ASSERT_EQ(facets.count, 8u);
    for (int k = 0; k < 400; k += int(kAngleLanes)) {
        AngleLanes x, y;
        for (int j = 0; j < int(kAngleLanes); ++j) {
            x[j] = found.side[0] * ((k + j) % 20 + 0.5) / 20;
            y[j] = found.side[1] * ((k + j) / 20 + 0.5) / 20;
        }
        uint32_t triangle[kAngleLanes];
        float u[kAngleLanes], v[kAngleLanes];
        kernels().on_facets(facets, x, y, triangle, u, v);
        for (size_t j = 0; j < kAngleLanes; ++j) {
            ASSERT_LT(triangle[j], 8u);
            const dvec3* p = &corners[3 * (7 - triangle[j])];
            const dvec3 at = p[0] + double(u[j]) * (p[1] - p[0]) + double(v[j]) * (p[2] - p[0]);
            const dvec3 want = found.corner + x[j] * found.axis[0] + y[j] * found.axis[1];
            EXPECT_LE(glm::length(at - want), 2e-6) << k + int(j);
            EXPECT_TRUE(u[j] >= 0 && v[j] >= 0 && u[j] + v[j] <= 1 + 1e-6f);
        }
    }
    EXPECT_EQ(facets_of(found, whole, std::vector<uint32_t>(9)).count, 0u);
}

TEST_P(SolidAngles, OfSpheresAreEvenInTheirCones) {
    const LampShape shape = find_lamp_shape(ball(8, 16));
    for (double distance : {1.001, 1.2, 3.0, 1e3, 9e4}) {
        const dvec3 axis = glm::normalize(dvec3(1, -2, 0.5));
        const SolidAngle seen(shape, distance * axis);
        const double sine2 = 1 / (distance * distance), cosine = std::sqrt(1 - sine2);
        const double opening = sine2 / (1 + cosine);
        EXPECT_NEAR(seen.density() * 2 * kPi * opening, 1, 1e-9);
        const dvec3 mean = mean_direction(shape, distance * axis);
        EXPECT_LE(glm::length(mean + axis * (1 - 0.5 * opening)), 1e-6) << distance;
        EXPECT_LT(seen.near(), distance - 1);
        EXPECT_GT(seen.far(), distance + 1);
        for (const dvec3& way : ways(shape, distance * axis, 32)) {
            EXPECT_NEAR(glm::length(way), 1, 1e-12);
            EXPECT_LE(1 + glm::dot(way, axis), opening * (1 + 1e-6) + 1e-15);
        }
    }
}

TEST_P(SolidAngles, HaveTheSameBitsAsThePortableOnes) {
    const AngleKernels& portable =
        *usable_angle_kernels().kernels[usable_angle_kernels().count - 1];
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-3, 3), part(0, 1);
    const LampShape square = find_lamp_shape(grid({-1, -0.3}, {1, 0.3}, 1)),
                    sphere = find_lamp_shape(ball(8, 16));
    for (int k = 0; k < 200; ++k) {
        RectangleLanes rectangles{};
        SphereLanes spheres{};
        AngleLanes u, v, here[3], there[3];
        for (size_t lane = 0; lane < kAngleLanes; ++lane) {
            const dvec3 P(number(random), number(random), number(random));
            SolidAngle(square, P).put(rectangles, lane);
            SolidAngle(sphere, P + 4.0 * glm::normalize(P)).put(spheres, lane);
            u[lane] = part(random), v[lane] = part(random);
        }
        kernels().to_rectangles(rectangles, u, v, here[0], here[1]);
        portable.to_rectangles(rectangles, u, v, there[0], there[1]);
        EXPECT_EQ(std::memcmp(here, there, 2 * sizeof(AngleLanes)), 0);
        kernels().to_spheres(spheres, u, v, here);
        portable.to_spheres(spheres, u, v, there);
        EXPECT_EQ(std::memcmp(here, there, sizeof(here)), 0);
    }
}

// There the caller takes samples by area.
TEST_P(SolidAngles, AreLeftOutWhereTheyAreTooSmallOrTheLampTooNear) {
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
