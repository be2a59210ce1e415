// runtime/picture/lights/solid_angle.h: the directions in which a point sees a lamp.
#pragma once

#include <span>

#include "runtime/picture/lights/angle_kernels.h"
#include "runtime/picture/lights/lamp_shape.h"

namespace kinora {

// A rectangle as up to sixteen points see it; lanes behind the last point are as its. The density
// of samples that are even in its solid angle is 0 where the angle is too small, or the point too
// near.
void see_rectangles(const LampShape& shape, std::span<const dvec3> points, RectangleLanes& lanes,
                    double (&density)[kAngleLanes]);

// As one point sees a shape.
//
// Numbers are found by operations that IEEE 754 rounds exactly, so all machines have the same bits.
class SolidAngle {
  public:
    // Of the shape as it is seen from P, in its space.
    SolidAngle(const LampShape& shape, dvec3 P);
    // Of samples that are even in it, in each direction; 0 where the angle is too small, or P too
    // near, for such samples: those by area serve there.
    double density() const { return density_; }
    // Becomes a lane of what samples are drawn from. The shape is of that kind, the density not 0.
    void put(RectangleLanes& lanes, size_t lane) const;
    void put(SphereLanes& lanes, size_t lane) const;
    // Of a sphere: unit vectors in the directions of samples meet it between these distances.
    double near() const { return near_; }
    double far() const { return far_; }
    // Samples with a u below this are sure to meet the triangles, those above may miss them.
    double sure() const { return sure_; }

  private:
    void see_sphere(const LampShape& shape, dvec3 P);

    double density_ = 0;
    RectangleLanes rectangle_;  // its first lane
    // Of a sphere, as in SphereLanes.
    dvec3 axis_[3];
    double opening_, near_ = 0, far_ = 0, sure_ = 0;
};

}  // namespace kinora
