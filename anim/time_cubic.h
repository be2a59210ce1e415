// anim/time_cubic.h: where on a BEZIER segment a time lies.
#pragma once

namespace kinora::anim {

// The parameter s in 0..1 at which the cubic Bezier with controls 0, time[0], time[1], duration
// reaches `offset` (all seconds since the segment's start). Both inner controls must lie in
// 0..duration, which makes the cubic monotone, however steep.
double solve_time_cubic(const double time[2], double duration, double offset);

}  // namespace kinora::anim
