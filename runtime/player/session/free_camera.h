// runtime/player/session/free_camera.h: a camera that is moved by hand: it looks at a pivot.
#pragma once

#include <optional>
#include <string>

#include "raytrace/camera.h"
#include "runtime/base/math.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// World space. `axes`: right, up, back (towards the eye), of length 1.
struct FreeCamera {
    dvec3 pivot{0.0};
    double distance = 1;  // from the pivot to the eye
    dmat3 axes{1.0};
    bool parallel = false;
    double half_height =
        0.33;  // of the picture at distance 1 (in a parallel view times `distance`)
    double znear = 0, zfar = 0;

    dvec3 eye() const { return pivot + distance * axes[2]; }
    dmat4 world_from_camera() const;        // as a camera's node
    raytrace::CameraOptics optics() const;  // angles in radians
};

// As the scene's camera stands; it looks at a pivot `distance` away.
FreeCamera free_camera_of(const raytrace::Camera& view, dvec3 origin, double distance);

// About the scene's up axis (degrees to the right) and about the camera's right (degrees upwards).
// The eye never passes over the pole.
void orbit(FreeCamera& camera, dvec3 up, double right_degrees, double up_degrees);
// By shares of the picture's height, in the plane of the pivot.
void pan(FreeCamera& camera, double right, double up);
// Towards the pivot: the distance divided by `factor` (> 0).
void dolly(FreeCamera& camera, double factor);
// The eye and the pivot together, in units of the scene along right, up and into the picture.
void fly(FreeCamera& camera, dvec3 step);
// The eye stays; what is looked at turns.
void look(FreeCamera& camera, dvec3 up, double right_degrees, double up_degrees);
// The box fits the picture of that width / height.
void frame_box(FreeCamera& camera, dvec3 low, dvec3 high, double aspect);
// Where it is once the world around it has been moved, turned and scaled so. Nothing where shapes
// would be others: sheared, mirrored or flat.
std::optional<FreeCamera> moved(const FreeCamera& camera, const dmat4& moves);
// From the front, the right or above (1, 3, 7) or their opposites.
enum class AxisView : uint8_t { Front, Back, Right, Left, Top, Bottom };
void look_along(FreeCamera& camera, AxisView view, UpAxis up_axis);

dvec3 up_of(UpAxis axis);

// A camera as numbers: pivot, distance, right, up, back, half height, near, far, 1 where it is
// parallel; those behind `back` may be left out. Nothing where they are no camera.
std::string camera_text(const FreeCamera& camera);
std::optional<FreeCamera> camera_of(const std::string& text);

}  // namespace kinora
