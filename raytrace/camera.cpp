// raytrace/camera.cpp: optics to window, node matrix to axes, raster position to ray.
#include "raytrace/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace kinora::raytrace {

namespace {

double length(dvec3 a) {
    return std::hypot(a.x, a.y, a.z);
}
bool finite(dvec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// Half a side of the window at distance 1, or the magnification itself.
double half_side(const CameraOptics& optics, double value) {
    return optics.orthographic ? value : std::tan(0.5 * value);
}

CameraStatus check_window(const std::array<double, 4>& window) {
    for (double side : window)
        if (!std::isfinite(side)) return CameraStatus::BadWindow;
    bool area = window[0] != window[1] && window[2] != window[3];
    return area ? CameraStatus::Ok : CameraStatus::BadWindow;
}

CameraStatus check_optics(const CameraOptics& optics) {
    if (optics.window) return check_window(*optics.window);
    if (!optics.x && !optics.y) return CameraStatus::FieldOfViewOutOfRange;
    for (const std::optional<double>& side : {optics.x, optics.y}) {
        if (!side) continue;
        bool positive = *side > 0 && std::isfinite(*side);
        if (optics.orthographic && !positive) return CameraStatus::MagnificationNotPositive;
        if (!optics.orthographic && !(positive && *side < kPi))
            return CameraStatus::FieldOfViewOutOfRange;
    }
    if (optics.aspect && !(*optics.aspect > 0 && std::isfinite(*optics.aspect)))
        return CameraStatus::AspectNotPositive;
    return CameraStatus::Ok;
}

// COLLADA 1.4.1, <perspective>: x, y, or one of them with aspect_ratio; with all three, x and y
// win. One side alone is kept, two are fitted inside the picture.
void fit_window(const CameraOptics& optics, double picture_aspect, Camera& out) {
    if (optics.window) {
        const std::array<double, 4>& window = *optics.window;
        dvec2 low(window[0], window[2]), high(window[1], window[3]);
        out.sign = glm::sign(high - low);
        out.middle = 0.5 * (low + high);
        out.half_width = 0.5 * std::abs(high.x - low.x);
        out.half_height = 0.5 * std::abs(high.y - low.y);
        return;
    }
    std::optional<double> w, h;
    if (optics.x) w = half_side(optics, *optics.x);
    if (optics.y) h = half_side(optics, *optics.y);
    if (optics.aspect && !h) h = *w / *optics.aspect;
    if (optics.aspect && !w) w = *h * *optics.aspect;
    const bool keep_height = !w || (h && picture_aspect > *w / *h);
    out.half_width = keep_height ? *h * picture_aspect : *w;
    out.half_height = keep_height ? *h : *w / picture_aspect;
}

// Looks along -z. The view direction is kept, then up as far as it is square to it; a mirror is
// taken for scale and goes too.
bool orthonormal_axes(const dmat4& m, Camera& out) {
    dvec3 y{m[1]}, back{m[2]};
    double largest = std::max({length(dvec3{m[0]}), length(y), length(back)});
    if (!finite(dvec3{m[3]}) || !std::isfinite(largest) || !(length(back) > 0)) return false;
    back /= length(back);
    if (!(length(y) > 0)) return false;
    y /= length(y);
    dvec3 right = cross(y, back);
    if (!(length(right) > 1e-9)) return false;
    right /= length(right);
    out.right = right;
    out.up = cross(back, right);
    out.forward = -back;
    return true;
}

// docs/numerics.md#cameras: znear of 1e-6 of the scene where there is none, zfar beyond everything.
bool repair_clip_range(double scene_size, Camera& camera) {
    double size = scene_size > 0 && std::isfinite(scene_size) ? scene_size : 1;
    bool sound = camera.znear > 0 && camera.zfar > camera.znear && std::isfinite(camera.zfar);
    if (sound) return false;
    if (camera.znear > camera.zfar && camera.zfar > 0) std::swap(camera.znear, camera.zfar);
    if (!(camera.znear > 0)) camera.znear = 1e-6 * size;
    if (!(camera.zfar > camera.znear && std::isfinite(camera.zfar)))
        camera.zfar = std::max(1e3 * size + 2 * length(camera.eye), 2 * camera.znear);
    return true;
}

void set_matrices(dvec3 eye_world, Camera& c) {
    c.world_from_camera =
        dmat4(dvec4(c.right, 0), dvec4(c.up, 0), dvec4(c.forward, 0), dvec4(eye_world, 1));
    dmat4& m = c.camera_from_world;
    const dvec3 axes[3] = {c.right, c.up, c.forward};
    m = dmat4(1.0);
    for (int r = 0; r < 3; ++r) {
        for (int k = 0; k < 3; ++k) m[k][r] = axes[r][k];
        m[3][r] = -dot(axes[r], eye_world);
    }
}

// d(v / |v|) = (dv - n (n . dv)) / |v|, n = v / |v|.
vec3 unit_differential(dvec3 n, double inverse_length, dvec3 dv) {
    return vec3((dv - n * dot(n, dv)) * inverse_length);
}

}  // namespace

CameraStatus make_camera(const CameraOptics& optics, const dmat4& world_from_node, int width,
                         int height, dvec3 scene_origin, double scene_size, Camera& out) {
    if (width < 1 || height < 1) return CameraStatus::BadPicture;
    if (CameraStatus status = check_optics(optics); is_error(status)) return status;
    Camera camera;
    camera.orthographic = optics.orthographic;
    camera.width = width;
    camera.height = height;
    fit_window(optics, double(width) / height, camera);
    if (!orthonormal_axes(world_from_node, camera)) return CameraStatus::BadMatrix;
    const dvec3 eye_world{world_from_node[3]};
    camera.eye = eye_world - scene_origin;
    set_matrices(eye_world, camera);
    const double dx = camera.sign.x * (2 * camera.half_width / camera.width);
    const double dy = camera.sign.y * (-2 * camera.half_height / camera.height);  // y goes down
    camera.raster_dx = camera.right * dx;
    camera.raster_dy = camera.up * dy;
    camera.axis = {0.5 * camera.width - camera.middle.x / dx,
                   0.5 * camera.height - camera.middle.y / dy};
    camera.znear = optics.znear;
    camera.zfar = optics.zfar;
    bool repaired = repair_clip_range(scene_size, camera);
    out = camera;
    return repaired ? CameraStatus::ClipRangeRepaired : CameraStatus::Ok;
}

std::optional<double> picture_aspect(const CameraOptics& optics) {
    if (is_error(check_optics(optics))) return {};
    if (const auto& window = optics.window)
        return std::abs(((*window)[1] - (*window)[0]) / ((*window)[3] - (*window)[2]));
    if (optics.x && optics.y) return half_side(optics, *optics.x) / half_side(optics, *optics.y);
    return optics.aspect;
}

CameraRay camera_ray(const Camera& camera, double x, double y) {
    const dvec3& dx = camera.raster_dx;
    const dvec3& dy = camera.raster_dy;
    const dvec3 across = dx * (x - camera.axis.x) + dy * (y - camera.axis.y);
    CameraRay ray{};
    double per_depth = 1;  // length along the ray for one unit of depth
    if (camera.orthographic) {
        ray.org = vec3(camera.eye + across);
        ray.dir = vec3(camera.forward);
        ray.dorg_dx = vec3(dx);
        ray.dorg_dy = vec3(dy);
    } else {
        const dvec3 v = camera.forward + across;
        per_depth = length(v);
        const double inverse_length = 1 / per_depth;
        const dvec3 n = v * inverse_length;
        ray.org = vec3(camera.eye);
        ray.dir = vec3(n);
        ray.ddir_dx = unit_differential(n, inverse_length, dx);
        ray.ddir_dy = unit_differential(n, inverse_length, dy);
    }
    ray.tnear = camera.clip ? float(camera.znear * per_depth) : 0.0f;
    ray.tfar =
        camera.clip ? float(camera.zfar * per_depth) : std::numeric_limits<float>::infinity();
    return ray;
}

std::optional<dvec2> raster_position(const Camera& camera, const dvec3& point) {
    const dvec3 from_eye = point - camera.eye;
    const double depth = dot(from_eye, camera.forward);
    if (!(depth > 0)) return {};
    const double scale = camera.orthographic ? 1 : 1 / depth;
    auto along = [&](const dvec3& step) { return scale * dot(from_eye, step) / dot(step, step); };
    return camera.axis + dvec2(along(camera.raster_dx), along(camera.raster_dy));
}

}  // namespace kinora::raytrace
