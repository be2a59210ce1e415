// raytrace/placement_p.h: an instance's matrix as the ray tracer uses it, with its error terms.
#pragma once

#include "raytrace/accel.h"

namespace kinora::raytrace {

struct Placement {
    float m[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};       // accel from local, columns
    float traced[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};  // the same between Embree's spaces
    float normal[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // rows; local to accel normals, any scale
    float there_and_back[9] = {};                   // rows; |M| |M^-1|
    float largest_origin = 0;  // rays from farther off would leave Embree's range in local space
};

// `accel_scale`, `local_scale`: what Embree's two spaces are scaled by (scale_p.h). False if the
// matrix between them has no inverse or scales by more than 1e10 or less than 1e-10: rays would
// leave the range in which floats (and Embree, which aborts) can follow them.
bool make_placement(const dmat4& accel_from_local, float accel_scale, float local_scale,
                    Placement& out);

// Takes a local point and its error bound to accel space.
void place_point(const Placement& placement, vec3& p, vec3& p_error);
vec3 place_normal(const Placement& placement, vec3 n);

// gamma(n) of Pharr, Jakob, Humphreys, 6.8.1: bound of the relative error of n float operations.
constexpr float gamma(int n) {
    constexpr double half_ulp = 0x1p-24;
    return float(n * half_ulp / (1 - n * half_ulp));
}

}  // namespace kinora::raytrace
