// runtime/base/transform_matrix.h: the matrices of COLLADA's transforms (1.4.1, chapter 5). Angles
// in degrees; `v` starts at the values in their order.
#pragma once

#include "runtime/base/math.h"

namespace kinora {

dmat4 translation_matrix(const double* v);  // x y z
dmat4 rotation_matrix(const double* v);     // axis x y z, angle; a zero axis: the identity
dmat4 scale_matrix(const double* v);        // x y z
dmat4 rows_matrix(const double* v);         // 16 numbers row by row; the last row is ignored
// Eye, interest, up. Where up lies along the view a fixed axis is right; an eye at the interest is
// only moved.
dmat4 lookat_matrix(const double* v);
// Angle, rotated axis d1, translated axis d2, made unit: p + tan(angle) (p . d2) d1. A zero axis or
// an angle without a tangent: the identity.
dmat4 skew_matrix(const double* v);
// x y z w of any length (glTF 2.0, 3.5.3); zero or not finite: the identity.
dmat4 quaternion_matrix(const double* v);

// Whether the linear part makes a solid flat: its volume, as a share of that of a box with edges of
// the columns' lengths, is next to 0 or no number.
bool is_singular(const dmat4& m);

}  // namespace kinora
