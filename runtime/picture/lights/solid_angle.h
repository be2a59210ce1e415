// runtime/picture/lights/solid_angle.h: the directions in which a point sees a lamp, and samples of
// them that are even in solid angle.
#pragma once

#include "runtime/picture/lights/lamp_shape.h"

namespace kinora {

// Numbers are found by operations that IEEE 754 rounds exactly, so all machines have the same bits.
class SolidAngle {
  public:
    // A sample: it leaves the point, and meets the shape between `near` and `far` times its length.
    struct Way {
        dvec3 direction;
        double near, far;
    };

    // Of the shape as it is seen from P, in its space.
    SolidAngle(const LampShape& shape, dvec3 P);
    // Of each direction; 0 where the angle is too small, or P too near, for such samples: those by
    // area serve there.
    double density() const { return density_; }
    // For u, v in [0, 1). The density is not 0.
    Way sample(double u, double v) const;

  private:
    void see_rectangle(const LampShape& shape, dvec3 P);
    void see_sphere(const LampShape& shape, dvec3 P);
    Way to_rectangle(double u, double v) const;
    Way to_sphere(double u, double v) const;

    bool sphere_ = false;
    double density_ = 0;
    dvec3 axis_[3];  // of a rectangle: z from the point to its plane; of a sphere: to its center
    // Of a rectangle: where its sides are, and the distance of its plane.
    double x_[2], y_[2], z_;
    double first_, last_;   // z of the normals of the planes through the point and the sides y_
    double angle_, start_;  // the solid angle; what is added to a part of it
    // Of a sphere: 1 - the cosine between axis and side; the distances of center and side.
    double opening_, distance_, radius_;
};

}  // namespace kinora
