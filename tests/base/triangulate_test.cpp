// tests/collada/triangulate_test.cpp: random concave polygons against area and inside tests.
#include "runtime/base/polygons/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace kinora {
namespace {

double twice_area(dvec2 a, dvec2 b, dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const std::vector<dvec2>& loop, dvec2 p) {  // even-odd rule
    bool in = false;
    for (size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
        if ((loop[i].y > p.y) != (loop[j].y > p.y) &&
            p.x < (loop[j].x - loop[i].x) * (p.y - loop[i].y) / (loop[j].y - loop[i].y) + loop[i].x)
            in = !in;
    return in;
}

// A star-shaped loop around a centre: simple by construction, as concave as one likes.
std::vector<dvec2> star(std::mt19937& random, int corners, dvec2 center, double low, double high) {
    std::uniform_real_distribution<double> radius(low, high);
    std::vector<dvec2> loop;
    for (int i = 0; i < corners; ++i) {
        double angle = 2 * kPi * i / corners, r = radius(random);
        loop.push_back(center + r * dvec2(std::cos(angle), std::sin(angle)));
    }
    return loop;
}

struct Polygon {
    std::vector<std::vector<dvec2>> loops;
    std::vector<dvec2> points;
    std::vector<uint32_t> sizes, triangles;
    Triangulation result;

    void cut(bool tilted) {
        std::vector<dvec3> corners;
        for (const auto& loop : loops) {
            sizes.push_back(uint32_t(loop.size()));
            for (dvec2 p : loop) {
                points.push_back(p);
                // Any plane will do; this one leans away from all three axes.
                corners.push_back(tilted ? dvec3(p.x, p.y, 0.7 * p.x - 0.4 * p.y + 3)
                                         : dvec3(p.x, p.y, 0));
            }
        }
        result = triangulate(corners, sizes, triangles);
    }
    double area() const {
        double sum = 0;
        for (const auto& loop : loops)
            for (size_t i = 0; i < loop.size(); ++i) {
                dvec2 a = loop[i], b = loop[(i + 1) % loop.size()];
                sum += (a.x * b.y - a.y * b.x) / 2;
            }
        return sum;
    }
};

// `touching`: of the holes, those that are joined where they touch, without a way there and back.
void expect_exact_cover(const Polygon& p, size_t touching = 0) {
    size_t corners = p.points.size(), holes = p.loops.size() - 1 - touching;
    EXPECT_EQ(p.triangles.size(), 3 * (corners + 2 * holes - 2));
    EXPECT_FALSE(p.result.self_intersecting);
    EXPECT_EQ(p.result.lost_holes, 0u);
    double sum = 0;
    for (size_t t = 0; t < p.triangles.size(); t += 3) {
        dvec2 a = p.points[p.triangles[t]], b = p.points[p.triangles[t + 1]],
              c = p.points[p.triangles[t + 2]];
        double area = twice_area(a, b, c) / 2;
        EXPECT_GE(area, -1e-12);
        sum += area;
        if (area < 1e-9) continue;
        dvec2 middle = (a + b + c) / 3.0;
        EXPECT_TRUE(inside(p.loops[0], middle));
        for (size_t h = 1; h < p.loops.size(); ++h) EXPECT_FALSE(inside(p.loops[h], middle));
    }
    EXPECT_NEAR(sum, p.area(), 1e-9 * std::abs(p.area()));
}

TEST(Triangulate, CoversConcavePolygonsExactly) {
    std::mt19937 random(3);
    for (int i = 0; i < 400; ++i) {
        Polygon p;
        p.loops = {star(random, 4 + int(random() % 60), {0, 0}, 0.1, 1)};
        p.cut(i % 2);
        expect_exact_cover(p);
    }
}

// A hole with a corner at one of the outline's, or at one of another hole's.
TEST(Triangulate, CoversPolygonsWithHolesThatTouch) {
    std::mt19937 random(9);
    for (int i = 0; i < 400; ++i) {
        Polygon p;
        p.loops = {star(random, 20 + int(random() % 20), {0, 0}, 3, 5)};
        dvec2 corner = p.loops[0][random() % p.loops[0].size()];
        double a = std::atan2(corner.y, corner.x);
        auto polar = [&](double angle, double r) {
            return r * dvec2(std::cos(a + angle), std::sin(a + angle));
        };
        bool at_outline = i % 4 < 2;
        dvec2 tip = at_outline ? corner : corner * 0.5, shared = polar(0.3, 1);
        p.loops.push_back({tip, polar(-0.3, 1), shared});
        if (!at_outline) p.loops.push_back({shared, polar(1.3, 0.5), polar(2.3, 0.5)});
        for (size_t h = 1; h < p.loops.size(); ++h)
            if (twice_area(p.loops[h][0], p.loops[h][1], p.loops[h][2]) > 0)
                std::reverse(p.loops[h].begin(), p.loops[h].end());
        p.cut(i % 2);
        expect_exact_cover(p, 1);
    }
}

TEST(Triangulate, CoversPolygonsWithHoles) {
    std::mt19937 random(5);
    for (int i = 0; i < 400; ++i) {
        Polygon p;
        p.loops = {star(random, 20 + int(random() % 40), {0, 0}, 3, 5)};
        for (dvec2 center : {dvec2(1.2, 0.9), dvec2(-1.2, 0.9), dvec2(0, -1.4)}) {
            auto hole = star(random, 3 + int(random() % 12), center, 0.2, 0.8);
            std::reverse(hole.begin(), hole.end());
            p.loops.push_back(hole);
        }
        p.cut(i % 2);
        expect_exact_cover(p);
    }
}

TEST(Triangulate, DegenerateInputEndsWithTheRightNumberOfTriangles) {
    std::vector<std::vector<dvec3>> cases = {
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},                        // a line
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},                        // a point
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                        // a bow tie
        {{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}},  // double corner
    };
    for (const auto& corners : cases) {
        std::vector<uint32_t> sizes{uint32_t(corners.size())}, triangles;
        triangulate(corners, sizes, triangles);
        EXPECT_EQ(triangles.size(), 3 * (corners.size() - 2));
        for (uint32_t i : triangles) EXPECT_LT(i, corners.size());
    }
}

TEST(Triangulate, HugePolygonsEndInBoundedTime) {
    std::vector<dvec3> comb;  // every other corner is reflex
    for (int i = 0; i < 100000; ++i) comb.push_back({double(i), i % 2 ? 100000.0 : 0.0, 0});
    comb.push_back({100000, -1, 0});
    comb.push_back({-1, -1, 0});
    std::vector<uint32_t> sizes{uint32_t(comb.size())}, triangles;
    triangulate(comb, sizes, triangles);
    EXPECT_EQ(triangles.size(), 3 * (comb.size() - 2));
}

}  // namespace
}  // namespace kinora
