// tests/runtime/scene/tessellate/surfaces.h: surfaces that tests make, and what they count.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "runtime/scene/tessellate/tessellate.h"

namespace kinora {

inline CurvedSurface quadric(CurvedKind kind, std::vector<double> numbers) {
    CurvedSurface s;
    s.kind = kind;
    std::copy(numbers.begin(), numbers.end(), s.numbers);
    return s;
}

// Of RISpec, rows of M for [t^3 t^2 t 1] M G.
using BasisRows = std::array<std::array<double, 4>, 4>;
inline constexpr BasisRows kBezier = {{{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}}};
inline constexpr BasisRows kBspline = {{{-1 / 6., 3 / 6., -3 / 6., 1 / 6.},
                                        {3 / 6., -6 / 6., 3 / 6., 0},
                                        {-3 / 6., 0, 3 / 6., 0},
                                        {1 / 6., 4 / 6., 1 / 6., 0}}};
inline constexpr BasisRows kCatmullRom = {
    {{-.5, 1.5, -1.5, .5}, {1, -2.5, 2, -.5}, {-.5, 0, .5, 0}, {0, 1, 0, 0}}};
inline constexpr BasisRows kHermite = {
    {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}}};
inline constexpr BasisRows kPower = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

inline PatchDirection cubic(uint32_t points, const BasisRows& rows, uint32_t step,
                            bool periodic = false) {
    PatchDirection d;
    d.points = points;
    d.step = step;
    d.periodic = periodic;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) d.basis[c][r] = rows[size_t(r)][size_t(c)];
    return d;
}

inline PatchDirection spline(uint32_t order, std::vector<double> knots, double low, double high) {
    PatchDirection d;
    d.order = order;
    d.points = uint32_t(knots.size()) - order;
    d.knots = std::move(knots);
    d.low = low;
    d.high = high;
    return d;
}

inline PatchDirection line_spline() {
    return spline(2, {0, 0, 1, 1}, 0, 1);
}

// A circle of nine rational points (Piegl and Tiller, The NURBS Book, section 7.5) about z.
inline std::vector<dvec4> circle_points(double radius, double z) {
    const double w = std::sqrt(0.5);
    const int corners[9][2] = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                               {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    std::vector<dvec4> points;
    for (int k = 0; k < 9; ++k) {
        double weight = k % 2 ? w : 1;
        points.push_back(
            {weight * radius * corners[k][0], weight * radius * corners[k][1], weight * z, weight});
    }
    return points;
}
inline PatchDirection circle_spline() {
    return spline(3, {0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1}, 0, 1);
}

// A cone's or cylinder's side, of two circles.
inline CurvedSurface between_circles(double radius0, double z0, double radius1, double z1) {
    CurvedSurface s;
    s.kind = CurvedKind::Nurbs;
    s.rational = true;
    s.u = circle_spline();
    s.v = line_spline();
    s.points = circle_points(radius0, z0);
    for (dvec4 p : circle_points(radius1, z1)) s.points.push_back(p);
    return s;
}

// Seen from far enough along z that `radius` around the origin is so many pixels wide.
inline PictureScale seen(double radius, double pixels) {
    PictureScale scale;
    scale.orthographic = true;
    scale.pixels = pixels / (2 * radius);
    return scale;
}

inline std::array<dvec3, 3> triangle(const Tessellation& t, size_t k) {
    const auto& index = t.group.triangles;
    return {t.positions[index[k]], t.positions[index[k + 1]], t.positions[index[k + 2]]};
}

inline double area(const Tessellation& t) {
    double sum = 0;
    for (size_t k = 0; k < t.group.triangles.size(); k += 3) {
        auto [a, b, c] = triangle(t, k);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

inline size_t triangle_count(const Tessellation& t) {
    return t.group.triangles.size() / 3;
}

inline const VertexAttribute* attribute(const Tessellation& t, const std::string& name) {
    for (const VertexAttribute& a : t.group.attributes)
        if (a.semantic == name) return &a;
    return nullptr;
}

// How many edges have so many triangles, and whether their directions oppose.
struct EdgeCount {
    size_t rim = 0, inner = 0, more = 0, alike = 0;
};
inline EdgeCount count_edges(const Tessellation& t) {
    std::map<std::pair<uint32_t, uint32_t>, std::pair<int, int>> edges;
    for (size_t k = 0; k < t.group.triangles.size(); ++k) {
        uint32_t a = t.group.triangles[k], b = t.group.triangles[k - k % 3 + (k + 1) % 3];
        auto& [count, turn] = edges[std::minmax(a, b)];
        ++count;
        turn += a < b ? 1 : -1;
    }
    EdgeCount result;
    for (const auto& [edge, uses] : edges) {
        result.rim += uses.first == 1;
        result.inner += uses.first == 2;
        result.more += uses.first > 2;
        result.alike += uses.first == 2 && uses.second != 0;
    }
    return result;
}

// Sound indices and numbers, and that normals agree with the winding.
inline void expect_sound(const Tessellation& t) {
    ASSERT_EQ(t.group.triangles.size() % 3, 0u);
    for (uint32_t k : t.group.triangles) ASSERT_LT(k, t.positions.size());
    for (dvec3 p : t.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const VertexAttribute& a : t.group.attributes) {
        ASSERT_EQ(a.corners.size(), t.group.triangles.size()) << a.semantic;
        for (uint32_t k : a.corners) ASSERT_LT((size_t(k) + 1) * a.stride, a.values.size() + 1);
    }
    if (t.group.triangles.empty()) return;
    const VertexAttribute* n = attribute(t, "NORMAL");
    ASSERT_NE(n, nullptr);
    for (size_t k = 0; k < n->values.size(); k += 3) {
        float square = 0;
        for (size_t c = 0; c < 3; ++c) square += n->values[k + c] * n->values[k + c];
        ASSERT_NEAR(square, 1, 1e-5);
    }
}

inline dvec3 normal_at(const Tessellation& t, size_t corner) {
    const VertexAttribute& n = *attribute(t, "NORMAL");
    const float* v = &n.values[3 * n.corners[corner]];
    return {v[0], v[1], v[2]};
}

// The least cosine between a triangle's side and the normals of its corners.
inline double least_agreement(const Tessellation& t) {
    double least = 1;
    for (size_t k = 0; k < t.group.triangles.size(); k += 3) {
        auto [a, b, c] = triangle(t, k);
        dvec3 side = glm::normalize(glm::cross(b - a, c - a));
        for (size_t i = 0; i < 3; ++i) least = std::min(least, glm::dot(side, normal_at(t, k + i)));
    }
    return least;
}

}  // namespace kinora
