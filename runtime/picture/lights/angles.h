// runtime/picture/lights/angles.h: angles in double with the same bits on all machines: only what
// IEEE 754 rounds exactly is used.
#pragma once

namespace kinora {

// The angle of (x, y) from the x axis, in radians, 0 to pi; y >= 0. Within 1e-15 of its size.
double angle_of(double y, double x);

}  // namespace kinora
