// runtime/scene/ri/state/transform_calls.cpp: the current transformation and named spaces.
#include <cmath>
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

bool is_of_picture(std::string_view space) {
    return space == "raster" || space == "NDC" || space == "screen";
}

// From a space of the picture to where it lies at z = 1, so that a point's z stays its distance.
// Pixels are those of the whole picture, not of the crop window.
dmat4 window_from(std::string_view space, const Options& options) {
    dmat4 m(1.0);
    if (space == "screen") {
        if (options.projection.perspective)
            m[0][0] = m[1][1] = std::tan(radians(options.projection.fov) / 2);
        return m;
    }
    WorldCamera camera = camera_of(options);
    const FilePicture& picture = camera.picture;
    const double* w = camera.window;
    double dx = (w[1] - w[0]) / picture.width, dy = (w[3] - w[2]) / picture.height;
    m[3][0] = w[0] - dx * picture.left, m[3][1] = w[3] + dy * picture.top;
    m[0][0] = space == "NDC" ? dx * picture.full_width : dx;
    m[1][1] = space == "NDC" ? -dy * picture.full_height : -dy;
    return m;
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

void TransformCalls::set(const dmat4& matrix) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(matrix[c][r]))
                return report_.add(Code::RI_RANGE, "the transformation",
                                   "it would not be finite, and stays as it is");
    state_.transform = matrix;
}

void TransformCalls::concat(const dmat4& matrix) {
    set(state_.transform * matrix);
}

void TransformCalls::identity(const Call&) {
    state_.transform = dmat4(1.0);
}

void TransformCalls::transform(const Call& call) {
    set(matrix_of(call.arguments[0]));
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
    if (!is_of_picture(space)) return std::nullopt;
    const Projection& projection = state_.options.projection;
    return glm::inverse(projection.from_camera) * window_from(space, state_.options);
}

// A point of camera space as it is projected to z = 1, or back.
dvec4 TransformCalls::at_unit_distance(dvec4 p, bool back) const {
    const dmat4& from_camera = state_.options.projection.from_camera;
    p = from_camera * p;
    double factor = back || p.z == 0 ? p.z : 1 / p.z;
    return glm::inverse(from_camera) * dvec4(p.x * factor, p.y * factor, p.z, p.w);
}

void TransformCalls::coord_sys_transform(const Call& call) {
    std::optional<dmat4> found = camera_from(call.arguments[0].string());
    if (!found) return report_.add(Code::RI_SPACE, call.arguments[0].string(), "");
    set(glm::inverse(state_.camera_from_world) * *found);
}

bool TransformCalls::transform_points(std::string_view from, std::string_view to,
                                      std::span<float> points) {
    std::optional<dmat4> a = camera_from(from), b = camera_from(to);
    if (!a || !b) return false;
    const bool perspective = state_.options.projection.perspective;
    const dmat4 to_from_camera = glm::inverse(*b);
    for (size_t i = 0; i + 2 < points.size(); i += 3) {
        dvec4 p = *a * dvec4(points[i], points[i + 1], points[i + 2], 1);
        if (perspective && is_of_picture(from)) p = at_unit_distance(p, true);
        if (perspective && is_of_picture(to)) p = at_unit_distance(p, false);
        p = to_from_camera * p;
        for (size_t k = 0; k < 3; ++k) points[i + k] = float(p[int(k)] / p.w);
    }
    return true;
}

}  // namespace kinora::ri
