// anim/decompose.h: a matrix as translation, rotation and stretch, and the way between two.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/base/math.h"

namespace kinora::anim {

struct Quaternion {
    double w = 1, x = 0, y = 0, z = 0;
};

// The unit quaternion along q; identity for zero or not finite.
Quaternion normalized(const Quaternion& q);
Quaternion quaternion_from_rotation(const dmat3& rotation);  // a proper rotation
dmat3 rotation_from_quaternion(const Quaternion& q);         // unit q

// How a rotation goes from one key to the next.
enum class RotationPath : uint8_t {
    Nlerp,  // the straight line between the quaternions, made unit: by 15 degrees off by 0.004 at
            // most, by 90 by 0.9, by 179 by 8
    Slerp   // at constant speed
};

// From a (s = 0) to b (s = 1) at constant speed by the shorter way; q and -q are one rotation. At
// exactly 180 degrees apart the turn is positive about the axis whose first non-zero component is
// positive. a and b need not be unit.
Quaternion slerp(const Quaternion& a, const Quaternion& b, double s);

// Likewise along the straight line between them, the shorter way.
Quaternion nlerp(const Quaternion& a, const Quaternion& b, double s);
Quaternion between(const Quaternion& a, const Quaternion& b, double s, RotationPath path);

// M = [rotation * stretch, translation; last_row]. The polar decomposition: rotation is proper,
// stretch symmetric (negative definite if M mirrors), so shear is kept. Singular matrices have one.
struct RigidStretch {
    dvec3 translation{0.0};
    Quaternion rotation;
    dmat3 stretch{1.0};
    dvec4 last_row{0.0, 0.0, 0.0, 1.0};
};

using Matrix16 = std::array<double, 16>;  // row-major, as in a document

RigidStretch decompose(const Matrix16& m);
Matrix16 compose(const RigidStretch& r);
// The rotation by its path, all else linearly; s = 0 is a, s = 1 is b.
RigidStretch interpolate(const RigidStretch& a, const RigidStretch& b, double s,
                         RotationPath path = RotationPath::Slerp);

}  // namespace kinora::anim
