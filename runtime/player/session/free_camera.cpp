// runtime/player/session/free_camera.cpp: a camera moved by hand.
#include "runtime/player/session/free_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "runtime/scene/load/override_scene.h"

namespace kinora {

namespace {

constexpr double kNearestPole = 0.999;  // cosine between back and up that an orbit stops at
constexpr double kLeastDistance = 1e-9, kMostDistance = 1e15;

// v turned about the axis (unit) by the angle: Rodrigues' formula.
dvec3 turned(dvec3 v, dvec3 axis, double angle) {
    double c = std::cos(angle), s = std::sin(angle);
    return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

dmat3 turned(const dmat3& axes, dvec3 axis, double angle) {
    return {turned(axes[0], axis, angle), turned(axes[1], axis, angle),
            turned(axes[2], axis, angle)};
}

// Without what rounding has left: unit and at right angles.
dmat3 squared(const dmat3& axes) {
    dvec3 back = glm::normalize(axes[2]);
    dvec3 right = glm::normalize(glm::cross(axes[1], back));
    return {right, glm::cross(back, right), back};
}

// Turned about `up`, then about the camera's right, but not over the poles.
dmat3 turned_by(const dmat3& axes, dvec3 up, double right_angle, double up_angle) {
    dmat3 turned_axes = turned(axes, up, right_angle);
    dmat3 tilted = turned(turned_axes, turned_axes[0], up_angle);
    double now = std::abs(glm::dot(turned_axes[2], up)), then = std::abs(glm::dot(tilted[2], up));
    bool over = glm::dot(tilted[1], up) < 0 && glm::dot(turned_axes[1], up) >= 0;
    if ((then > kNearestPole && then > now) || over) return squared(turned_axes);
    return squared(tilted);
}

}  // namespace

std::optional<FreeCamera> moved(const FreeCamera& camera, const dmat4& moves) {
    const dmat3 turns(moves);
    const double size = std::cbrt(glm::determinant(turns));
    if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    constexpr double kRounding = 1e-5;
    const dmat3 squares = glm::transpose(turns) * turns;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            if (!(std::abs(squares[c][r] / (size * size) - (c == r)) < kRounding))
                return std::nullopt;
    FreeCamera made = camera;
    made.pivot = dvec3(moves * dvec4(camera.pivot, 1));
    made.axes = squared(turns * camera.axes);
    made.distance = std::clamp(camera.distance * size, kLeastDistance, kMostDistance);
    made.znear *= size;
    made.zfar *= size;
    return made;
}

dmat4 FreeCamera::world_from_camera() const {
    return {dvec4(axes[0], 0), dvec4(axes[1], 0), dvec4(axes[2], 0), dvec4(eye(), 1)};
}

raytrace::CameraOptics FreeCamera::optics() const {
    raytrace::CameraOptics optics;
    optics.orthographic = parallel;
    optics.y = parallel ? half_height * distance : 2 * std::atan(half_height);
    optics.znear = znear;
    optics.zfar = zfar;
    return optics;
}

FreeCamera free_camera_of(const raytrace::Camera& view, dvec3 origin, double distance) {
    FreeCamera camera;
    camera.axes = {view.right, view.up, -view.forward};
    camera.distance = std::max(distance, kLeastDistance);
    camera.pivot = origin + view.eye + camera.distance * view.forward;
    camera.parallel = view.orthographic;
    camera.half_height = view.orthographic ? view.half_height / camera.distance : view.half_height;
    camera.znear = view.znear;
    camera.zfar = view.zfar;
    return camera;
}

void orbit(FreeCamera& camera, dvec3 up, double right_degrees, double up_degrees) {
    camera.axes = turned_by(camera.axes, up, radians(right_degrees), -radians(up_degrees));
}

void pan(FreeCamera& camera, double right, double up) {
    double height = 2 * camera.half_height * camera.distance;
    camera.pivot += height * (right * camera.axes[0] + up * camera.axes[1]);
}

void dolly(FreeCamera& camera, double factor) {
    camera.distance = std::clamp(camera.distance / factor, kLeastDistance, kMostDistance);
}

void fly(FreeCamera& camera, dvec3 step) {
    camera.pivot += step.x * camera.axes[0] + step.y * camera.axes[1] - step.z * camera.axes[2];
}

void look(FreeCamera& camera, dvec3 up, double right_degrees, double up_degrees) {
    dvec3 eye = camera.eye();
    camera.axes = turned_by(camera.axes, up, -radians(right_degrees), radians(up_degrees));
    camera.pivot = eye - camera.distance * camera.axes[2];
}

void frame_box(FreeCamera& camera, dvec3 low, dvec3 high, double aspect) {
    constexpr double kShare = 0.85;  // of the picture
    dvec3 center = 0.5 * (low + high), half = 0.5 * (high - low);
    double window_y = camera.half_height * kShare, window_x = window_y * aspect;
    double distance = 0, depth = 0;
    for (int corner = 0; corner < 8; ++corner) {
        dvec3 p = half * dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        double across = std::max(std::abs(glm::dot(p, camera.axes[0])) / window_x,
                                 std::abs(glm::dot(p, camera.axes[1])) / window_y);
        double towards = camera.parallel ? 0 : glm::dot(p, camera.axes[2]);
        distance = std::max(distance, across + towards);
        depth = std::max(depth, std::abs(glm::dot(p, camera.axes[2])));
    }
    camera.pivot = center;
    camera.distance = std::clamp(distance, kLeastDistance, kMostDistance);
    camera.znear = camera.zfar = 0;  // by the scene's size
}

void look_along(FreeCamera& camera, AxisView view, UpAxis up_axis) {
    // COLLADA 1.4.1, chapter 5: X_UP has right -Y and in Z, Z_UP right X and in -Y.
    dvec3 up = up_of(up_axis);
    dvec3 right = up_axis == UpAxis::X ? dvec3(0, -1, 0) : dvec3(1, 0, 0);
    dvec3 front = glm::cross(right, up);
    dvec3 back = front, top = up;
    switch (view) {
        case AxisView::Front:
            break;
        case AxisView::Back:
            back = -front;
            break;
        case AxisView::Right:
            back = right;
            break;
        case AxisView::Left:
            back = -right;
            break;
        case AxisView::Top:
            back = up, top = -front;
            break;
        case AxisView::Bottom:
            back = -up, top = front;
            break;
    }
    camera.axes = {glm::cross(top, back), top, back};
}

dvec3 up_of(UpAxis axis) {
    return {axis == UpAxis::X, axis == UpAxis::Y, axis == UpAxis::Z};
}

std::string camera_text(const FreeCamera& c) {
    return fmt::format("{} {} {}  {}  {} {} {}  {} {} {}  {} {} {}  {} {} {} {:d}", c.pivot.x,
                       c.pivot.y, c.pivot.z, c.distance, c.axes[0].x, c.axes[0].y, c.axes[0].z,
                       c.axes[1].x, c.axes[1].y, c.axes[1].z, c.axes[2].x, c.axes[2].y, c.axes[2].z,
                       c.half_height, c.znear, c.zfar, c.parallel);
}

std::optional<FreeCamera> camera_of(const std::string& text) {
    constexpr size_t kLeast = 13, kMost = 17;
    constexpr double kSkew = 1e-6;
    const std::optional<std::vector<double>> n = parse_numbers(text);
    if (!n || n->size() < kLeast || n->size() > kMost) return std::nullopt;
    const auto triple = [&](size_t k) { return dvec3((*n)[k], (*n)[k + 1], (*n)[k + 2]); };
    FreeCamera c;
    c.pivot = triple(0);
    c.distance = (*n)[3];
    c.axes = {triple(4), triple(7), triple(10)};
    if (n->size() > 13) c.half_height = (*n)[13];
    if (n->size() > 14) c.znear = (*n)[14];
    if (n->size() > 15) c.zfar = (*n)[15];
    c.parallel = n->size() > 16 && (*n)[16] != 0;
    bool upright = c.distance > 0 && c.half_height > 0;
    for (int k = 0; k < 3; ++k)  // of length 1, each at a right angle to the next
        upright &= std::abs(glm::dot(c.axes[k], c.axes[k]) - 1) < kSkew &&
                   std::abs(glm::dot(c.axes[k], c.axes[(k + 1) % 3])) < kSkew;
    return upright ? std::optional(c) : std::nullopt;
}

}  // namespace kinora
