// raytrace/camera.h: COLLADA cameras: from optics and a picture's size to rays.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "runtime/base/math.h"

namespace kinora::raytrace {

// What <optics> says, angles in radians. Perspective: xfov, yfov, aspect_ratio as given;
// orthographic: xmag, ymag (half widths, in world units).
struct CameraOptics {
    bool orthographic = false;
    std::optional<double> x;       // xfov or xmag
    std::optional<double> y;       // yfov or ymag
    std::optional<double> aspect;  // width / height
    // Instead of all three, what the whole picture spans: left, right, bottom, top, at distance 1
    // or in world units. Left above right, or bottom above top, is a mirrored picture.
    std::optional<std::array<double, 4>> window;
    double znear = 0;
    double zfar = 0;
};

enum class CameraStatus : uint8_t {
    Ok,
    FieldOfViewOutOfRange,     // error: not inside (0, 180) degrees, or neither x nor y given
    MagnificationNotPositive,  // error, orthographic
    AspectNotPositive,         // error
    BadMatrix,                 // error: not finite, or its axes do not span space
    BadPicture,                // error: width or height < 1
    BadWindow,                 // error: no area, or not finite
    ClipRangeRepaired,         // warning: znear <= 0 or znear >= zfar; see Camera::znear
};
constexpr bool is_error(CameraStatus s) {
    return s != CameraStatus::Ok && s != CameraStatus::ClipRangeRepaired;
}

inline constexpr size_t kMostCameraPlanes = 16;

// Camera space is RenderMan's: x right, y up, z into the picture (docs/decisions.md#spaces).
struct Camera {
    bool orthographic = false;
    int width = 0;  // pixels
    int height = 0;
    dvec3 eye{0.0};        // accel space: (world position - scene origin), taken in double
    dvec3 right{1, 0, 0};  // unit axes
    dvec3 up{0, 1, 0};
    dvec3 forward{0, 0, 1};
    double half_width = 1;  // of the picture: at distance 1 (perspective) or in world units
    double half_height = 1;
    dvec2 middle{0.0};  // of the picture, likewise: where the camera looks unless it has a window
    dvec2 axis{0.0};    // where the camera looks, pixels from the top left corner
    dvec2 sign{1.0};    // -1: the picture is mirrored along that axis
    dvec3 raster_dx{0.0};  // from one pixel to the next in that picture, and to the one below
    dvec3 raster_dy{0.0};
    double znear = 0;  // 0 < znear < zfar always; what the shaders see. Rays are not clipped
    double zfar = 0;   // unless `clip` is set.
    bool clip = false;
    // Rays see nothing on the sides that these planes' normals point to: n . p + w > 0. Accel
    // space.
    std::array<dvec4, kMostCameraPlanes> planes{};
    size_t plane_count = 0;
    dmat4 world_from_camera{1.0};  // rigid but for the mirror of z
    dmat4 camera_from_world{1.0};
};

// world_from_node: the camera node's matrix (COLLADA: looks along -z, y up); scale and shear are
// removed from its axes. The window given by the optics is fitted inside the picture where both of
// its sides are known; where only one is known, that side is kept. scene_size: the diagonal of the
// scene's bounds, for repairing the clip range. On an error `out` is not changed.
CameraStatus make_camera(const CameraOptics& optics, const dmat4& world_from_node, int width,
                         int height, dvec3 scene_origin, double scene_size, Camera& out);

// Width / height where the optics determine it, else nothing: for the default picture size.
std::optional<double> picture_aspect(const CameraOptics& optics);

// The ray through raster position (x, y): pixels from the top left corner, centres at .5. Direction
// has length 1. The differentials are per pixel in raster x and y.
struct CameraRay {
    vec3 org, dir;
    float tnear, tfar;
    vec3 dorg_dx, dorg_dy;
    vec3 ddir_dx, ddir_dy;
};
CameraRay camera_ray(const Camera& camera, double x, double y);

// The raster position at which a point is seen, accel space; nothing of a point that is not before
// the camera.
std::optional<dvec2> raster_position(const Camera& camera, const dvec3& point);

}  // namespace kinora::raytrace
