// runtime/picture/lights/lamp_shape.cpp: recognises rectangles and spheres among meshes.
#include "runtime/picture/lights/lamp_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace kinora {

namespace {

constexpr double kOfSize = 1e-5;       // of the shape's size
constexpr double kOfPlace = 4e-7;      // of the largest coordinate: floats of some operations
constexpr double kLeastCovered = 0.7;  // of a sphere's area: a regular body of 20 faces has .76
constexpr double kMostBlurred = 1e-3;  // of the size: a shape so far from 0 is known no better
constexpr size_t kMostCorners = 3u << 18;

struct Extent {
    dvec3 middle{0.0};
    double size = 0, tolerance = 0;
};

Extent extent_of(std::span<const dvec3> corners) {
    dvec3 low = corners[0], high = corners[0];
    for (const dvec3& p : corners) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const dvec3 far = glm::max(glm::abs(low), glm::abs(high));
    Extent extent;
    extent.middle = 0.5 * (low + high);
    extent.size = glm::length(high - low);
    extent.tolerance = kOfSize * extent.size + kOfPlace * std::max({far.x, far.y, far.z});
    return extent;
}

// The corner for which `measure` is greatest.
template <class F>
dvec3 farthest(std::span<const dvec3> corners, F&& measure) {
    return *std::max_element(corners.begin(), corners.end(), [&](const dvec3& a, const dvec3& b) {
        return measure(a) < measure(b);
    });
}

double square(dvec3 v) {
    return glm::dot(v, v);
}

// Twice the area of a triangle along its normal.
dvec3 across(std::span<const dvec3> corners, size_t triangle) {
    const dvec3* p = &corners[3 * triangle];
    return glm::cross(p[1] - p[0], p[2] - p[0]);
}

// The rectangle of three corners that are farthest apart; what else lies where is not looked at.
LampShape rectangle_about(std::span<const dvec3> corners, const Extent& extent) {
    LampShape shape;
    const dvec3 first = farthest(corners, [&](dvec3 p) { return square(p - extent.middle); });
    const dvec3 last = farthest(corners, [&](dvec3 p) { return square(p - first); });
    const dvec3 diagonal = last - first;
    const dvec3 beside =
        farthest(corners, [&](dvec3 p) { return square(glm::cross(p - first, diagonal)); });
    const dvec3 edges[2] = {beside - first, last - beside};
    shape.corner = first;
    for (int k = 0; k < 2; ++k) {
        shape.side[k] = glm::length(edges[k]);
        if (!(shape.side[k] > extent.tolerance)) return {};
        shape.axis[k] = edges[k] / shape.side[k];
    }
    if (std::abs(glm::dot(shape.axis[0], edges[1])) > extent.tolerance) return {};
    shape.axis[1] -= glm::dot(shape.axis[0], shape.axis[1]) * shape.axis[0];
    shape.axis[1] /= glm::length(shape.axis[1]);
    shape.axis[2] = glm::cross(shape.axis[0], shape.axis[1]);
    shape.kind = LampShape::Kind::Rectangle;
    return shape;
}

// Whether the triangles fill a rectangle, all from the same side.
bool fill(std::span<const dvec3> corners, const LampShape& shape, double tolerance) {
    for (const dvec3& p : corners) {
        const dvec3 at = p - shape.corner;
        if (std::abs(glm::dot(at, shape.axis[2])) > tolerance) return false;
        for (int k = 0; k < 2; ++k) {
            const double along = glm::dot(at, shape.axis[k]);
            if (!(along >= -tolerance && along <= shape.side[k] + tolerance)) return false;
        }
    }
    double sum = 0, turned = 0;
    for (size_t t = 0; t < corners.size() / 3; ++t) {
        const double area = 0.5 * glm::dot(across(corners, t), shape.axis[2]);
        sum += area;
        turned += std::abs(area);
    }
    const double slack = 2 * tolerance * (shape.side[0] + shape.side[1]);
    return std::abs(turned - std::abs(sum)) <= slack &&
           std::abs(turned - shape.side[0] * shape.side[1]) <= slack;
}

// Makes the sides as long as what lies within, so that no triangle sticks out.
void fit(LampShape& shape, std::span<const dvec3> corners) {
    for (int k = 0; k < 2; ++k) {
        double low = 0, high = 0;
        for (const dvec3& p : corners) {
            const double along = glm::dot(p - shape.corner, shape.axis[k]);
            low = std::min(low, along);
            high = std::max(high, along);
        }
        shape.corner += low * shape.axis[k];
        shape.side[k] = high - low;
    }
}

// The sphere nearest to all corners, by least squares: |p|^2 = 2 c.p + k about their middle.
LampShape sphere_about(std::span<const dvec3> corners, const Extent& extent) {
    dvec3 mean(0.0);
    for (const dvec3& p : corners) mean += (p - extent.middle) / double(corners.size());
    dmat3 products(0.0);
    dvec3 right(0.0);
    for (const dvec3& p : corners) {
        const dvec3 at = p - extent.middle - mean;
        products += glm::outerProduct(at, at);
        right += 0.5 * square(at) * at;
    }
    const double flat = glm::determinant(products);
    if (!(std::abs(flat) > 0)) return {};
    LampShape shape;
    shape.kind = LampShape::Kind::Sphere;
    shape.center = extent.middle + mean + glm::inverse(products) * right;
    double least = extent.size;
    for (const dvec3& p : corners) {
        const double far = glm::length(p - shape.center);
        least = std::min(least, far);
        shape.radius = std::max(shape.radius, far);
    }
    return shape.radius - least <= extent.tolerance ? shape : LampShape{};
}

// The distance of the nearest triangle's plane.
double inner_radius(std::span<const dvec3> corners, const LampShape& sphere) {
    double least = sphere.radius;
    for (size_t t = 0; t < corners.size() / 3; ++t) {
        const dvec3 normal = across(corners, t);
        const double length = glm::length(normal);
        if (length > 0)
            least = std::min(least,
                             std::abs(glm::dot(normal, corners[3 * t] - sphere.center)) / length);
    }
    return least;
}

bool cover(std::span<const dvec3> corners, const LampShape& sphere) {
    double area = 0;
    for (size_t t = 0; t < corners.size() / 3; ++t) area += 0.5 * glm::length(across(corners, t));
    const double whole = 4 * kPi * sphere.radius * sphere.radius;
    return area >= kLeastCovered * whole && area <= whole;
}

}  // namespace

LampShape find_lamp_shape(std::span<const dvec3> corners) {
    if (corners.empty() || corners.size() > kMostCorners) return {};
    const Extent extent = extent_of(corners);
    if (!(extent.tolerance < kMostBlurred * extent.size)) return {};
    LampShape shape = rectangle_about(corners, extent);
    if (shape.kind != LampShape::Kind::Other && fill(corners, shape, extent.tolerance)) {
        fit(shape, corners);
        return shape;
    }
    shape = sphere_about(corners, extent);
    if (shape.kind == LampShape::Kind::Other || !cover(corners, shape)) return {};
    shape.inner = inner_radius(corners, shape);
    return shape;
}

PlaneFacets facets_of(const LampShape& rectangle, std::span<const dvec3> corners,
                      std::span<const uint32_t> numbers) {
    PlaneFacets facets;
    if (numbers.size() > PlaneFacets::kMost) return facets;
    auto on_plane = [&](dvec3 p) {
        return dvec2(glm::dot(p, rectangle.axis[0]), glm::dot(p, rectangle.axis[1]));
    };
    auto across_of = [](dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; };
    for (size_t t = 0; t < numbers.size(); ++t) {
        const dvec3* p = &corners[3 * t];
        const dvec2 at = on_plane(p[0] - rectangle.corner), a = on_plane(p[1] - p[0]),
                    b = on_plane(p[2] - p[0]);
        const double area = across_of(a, b);
        if (area == 0) continue;
        const size_t f = facets.count++;
        const double u[3] = {b.y / area, -b.x / area, -across_of(at, b) / area};
        const double v[3] = {-a.y / area, a.x / area, -across_of(a, at) / area};
        std::copy_n(u, 3, facets.u[f]);
        std::copy_n(v, 3, facets.v[f]);
        facets.triangle[f] = numbers[t];
    }
    return facets;
}

}  // namespace kinora
