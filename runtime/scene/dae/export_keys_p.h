// runtime/scene/dae/export_keys_p.h: samplers as the arrays of COLLADA's <sampler>.
#pragma once

#include <string>
#include <vector>

#include "anim/sampler.h"
#include "runtime/base/math.h"

namespace kinora {

inline constexpr int kPiecesOfCurve = 16;  // of a curved rotation: straight pieces a segment

// The arrays of a <sampler>.
struct Keys {
    std::vector<double> times, values, in, out;  // tangents as (time, value) pairs
    std::vector<const char*> interpolations;
    size_t stride = 1;
    bool curved = false;

    void add(double time, const char* interpolation) {
        times.push_back(time);
        interpolations.push_back(interpolation);
    }
};

bool is_curve(anim::Interpolation i);

// One component: any cubic is a BEZIER with absolute control points.
Keys component_keys(const anim::Sampler& s, uint32_t component);
// Keys without curves, of several numbers each.
Keys whole_keys(const anim::Sampler& s, uint32_t component, uint32_t count);
// Of a quaternion. LINEAR matrices turn at constant speed, as slerp does.
Keys matrix_keys(const anim::Sampler& s);
// Angles on one axis, each from the one before by the way that slerp goes.
Keys angle_keys(const anim::Sampler& s, const dvec3& axis);
// The quaternions, four numbers each, at the times at which a rotation is written.
std::vector<double> written_rotations(const anim::Sampler& s);

// Degrees about a unit axis, of a rotation about it.
double angle_about(const dvec3& axis, const double* quaternion);
// The numbers of a <matrix> that is this rotation: floats, as good as their source.
void add_matrix(const double* quaternion, std::vector<double>& numbers);

}  // namespace kinora
