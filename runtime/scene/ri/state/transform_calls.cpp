// runtime/scene/ri/state/transform_calls.cpp: the current transformation and named spaces.
#include <glm/matrix.hpp>

#include "runtime/base/transform_matrix.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/state/transform_calls.h"

namespace kinora::ri {
namespace {

// Rows of 16 numbers are columns here, since the interface's vectors are rows.
dmat4 matrix_of(const Values& values) {
    dmat4 m(1.0);
    auto numbers = values.floats();
    for (int i = 0; i < 16 && numbers.size() == 16; ++i)
        m[i / 4][i % 4] = double(numbers[size_t(i)]);
    return m;
}

double real(const Call& call, size_t at) {
    return double(call.arguments[at].real());
}

}  // namespace

bool TransformCalls::call(const Call& call) {
    using R = Request;
    using C = TransformCalls;
    static const Handlers<C> kHandlers = {
        {R::Identity, &C::identity},
        {R::Transform, &C::transform},
        {R::ConcatTransform, &C::concat_transform},
        {R::Perspective, &C::perspective},
        {R::Translate, &C::translate},
        {R::Rotate, &C::rotate},
        {R::Scale, &C::scale},
        {R::Skew, &C::skew},
        {R::CoordinateSystem, &C::coordinate_system},
        {R::ScopedCoordinateSystem, &C::scoped_coordinate_system},
        {R::CoordSysTransform, &C::coord_sys_transform},
    };
    return kHandlers.call(*this, call);
}

void TransformCalls::concat(const dmat4& matrix) {
    state_.transform = state_.transform * matrix;
}

void TransformCalls::identity(const Call&) {
    state_.transform = dmat4(1.0);
}

void TransformCalls::transform(const Call& call) {
    state_.transform = matrix_of(call.arguments[0]);
}

void TransformCalls::concat_transform(const Call& call) {
    concat(matrix_of(call.arguments[0]));
}

void TransformCalls::perspective(const Call&) {
    report_.not_done("Perspective", "only Projection \"perspective\" makes one");
}

void TransformCalls::translate(const Call& call) {
    double v[] = {real(call, 0), real(call, 1), real(call, 2)};
    concat(translation_matrix(v));
}

void TransformCalls::rotate(const Call& call) {
    double v[] = {real(call, 1), real(call, 2), real(call, 3), real(call, 0)};
    concat(rotation_matrix(v));
}

void TransformCalls::scale(const Call& call) {
    double v[] = {real(call, 0), real(call, 1), real(call, 2)};
    concat(scale_matrix(v));
}

// In the plane of both axes points move along the second, so that the first turns towards it by
// the angle.
void TransformCalls::skew(const Call& call) {
    dvec3 from(real(call, 1), real(call, 2), real(call, 3));
    dvec3 to(real(call, 4), real(call, 5), real(call, 6));
    double angle = radians(real(call, 0));
    if (!(glm::length(from) > 0) || !(glm::length(to) > 0)) return;
    from = glm::normalize(from), to = glm::normalize(to);
    double along = glm::dot(from, to);
    dvec3 across = from - along * to;
    double width = glm::length(across);
    if (!(width > 1e-12)) return report_.add(Code::RI_RANGE, "Skew", "both axes are one");
    across /= width;
    double now = std::atan2(width, along), then = now - angle;
    double shear = (std::cos(then) / std::sin(then)) * width - along;
    if (!std::isfinite(shear)) return report_.add(Code::RI_RANGE, "Skew", "the angle is too large");
    shear /= width;
    dmat4 m(1.0);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] += shear * to[r] * across[c];
    concat(m);
}

void TransformCalls::coordinate_system(const Call& call) {
    state_.spaces.insert_or_assign(std::string(call.arguments[0].string()), state_.to_camera());
}

void TransformCalls::scoped_coordinate_system(const Call& call) {
    if (state_.blocks.empty()) return coordinate_system(call);
    state_.blocks.back().scoped.insert_or_assign(std::string(call.arguments[0].string()),
                                                 state_.to_camera());
}

std::optional<dmat4> TransformCalls::camera_from(std::string_view space) const {
    if (space == "camera" || space == "current") return dmat4(1.0);
    if (space == "world") return state_.camera_from_world;
    if (space == "object" || space == "shader") return state_.to_camera();
    for (size_t b = state_.blocks.size(); b-- > 0;)
        if (auto found = state_.blocks[b].scoped.find(space);
            found != state_.blocks[b].scoped.end())
            return found->second;
    if (auto found = state_.spaces.find(space); found != state_.spaces.end()) return found->second;
    WorldCamera camera = camera_of(state_.options);
    const double* w = camera.window;
    double width = w[1] - w[0], height = w[3] - w[2];
    bool raster = space == "raster", ndc = space == "NDC";
    if (!raster && !ndc && space != "screen") return std::nullopt;
    // Screen: the window at z = 1, so that a point's z stays its distance.
    dmat4 m(1.0);
    if (raster || ndc) {
        double x = raster ? camera.picture.width : 1, y = raster ? camera.picture.height : 1;
        m[0][0] = width / x, m[1][1] = -height / y;
        m[3][0] = w[0], m[3][1] = w[3];
    }
    return m;
}

void TransformCalls::coord_sys_transform(const Call& call) {
    std::optional<dmat4> found = camera_from(call.arguments[0].string());
    if (!found) return report_.add(Code::RI_SPACE, call.arguments[0].string(), "");
    state_.transform = glm::inverse(state_.camera_from_world) * *found;
}

bool TransformCalls::transform_points(std::string_view from, std::string_view to,
                                      std::span<float> points) {
    std::optional<dmat4> a = camera_from(from), b = camera_from(to);
    if (!a || !b) return false;
    dmat4 m = glm::inverse(*b) * *a;
    for (size_t i = 0; i + 2 < points.size(); i += 3) {
        dvec4 p = m * dvec4(points[i], points[i + 1], points[i + 2], 1);
        for (size_t k = 0; k < 3; ++k) points[i + k] = float(p[int(k)] / p.w);
    }
    return true;
}

}  // namespace kinora::ri
