// runtime/picture/lights/solid_angle.h: the directions in which a point sees a lamp.
#pragma once

#include "runtime/picture/lights/angle_kernels.h"
#include "runtime/picture/lights/lamp_shape.h"

namespace kinora {

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
    void see_rectangle(const LampShape& shape, dvec3 P);
    void see_sphere(const LampShape& shape, dvec3 P);

    double density_ = 0;
    // Of a rectangle, as in RectangleLanes.
    double x_[2], y_[2], z_, first_, last_, angle_, start_;
    // Of a sphere, as in SphereLanes.
    dvec3 axis_[3];
    double opening_, near_ = 0, far_ = 0, sure_ = 0;
};

}  // namespace kinora
