// runtime/scene/dae/export_keys.cpp: samplers as the arrays of COLLADA's <sampler>.
#include "runtime/scene/dae/export_keys_p.h"

#include <cmath>

#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr double kHalfTurn = 1e-12;  // |cos| of half the turn that counts as one (anim::slerp)

const char* straight(anim::Interpolation i) {
    return i == anim::Interpolation::Step ? "STEP" : "LINEAR";
}

// The times at which a rotation is written: curves in straight pieces.
template <class F>
Keys rotation_keys(const anim::Sampler& s, F&& add) {
    Keys keys;
    auto at = [&](double time, const char* interpolation) {
        double q[4];
        anim::evaluate(s, time, 0, q);
        keys.add(time, interpolation);
        add(keys.values, q);
    };
    for (size_t k = 0; k < s.times.size(); ++k) {
        at(s.times[k], straight(s.interpolations[k]));
        if (k + 1 == s.times.size() || !is_curve(s.interpolations[k])) continue;
        keys.curved = true;
        for (int i = 1; i < kPiecesOfCurve; ++i)
            at(s.times[k] + (s.times[k + 1] - s.times[k]) * i / kPiecesOfCurve, "LINEAR");
    }
    return keys;
}

}  // namespace

bool is_curve(anim::Interpolation i) {
    return i != anim::Interpolation::Step && i != anim::Interpolation::Linear;
}

double angle_about(const dvec3& axis, const double* q) {
    double along = q[0] * axis.x + q[1] * axis.y + q[2] * axis.z;
    return 2 * std::atan2(along, q[3]) * (180 / kPi);
}

void add_matrix(const double* q, std::vector<double>& numbers) {
    dmat4 m = transform_matrix(TransformKind::Quaternion, q);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) numbers.push_back(float(m[c][r]));
}

Keys component_keys(const anim::Sampler& s, uint32_t component) {
    Keys keys;
    size_t count = s.times.size();
    for (size_t k = 0; k < count; ++k) {
        double value = s.values[k * s.stride + component];
        keys.add(s.times[k], straight(s.interpolations[k]));
        keys.values.push_back(value);
        keys.in.insert(keys.in.end(), {s.times[k], value});
        keys.out.insert(keys.out.end(), {s.times[k], value});
    }
    for (size_t k = 0; k + 1 < count; ++k) {
        if (!is_curve(s.interpolations[k])) continue;
        const anim::CurveSegment& c = s.curves[k * s.stride + component];
        keys.curved = true;
        keys.interpolations[k] = "BEZIER";
        keys.out[2 * k] = s.times[k] + c.time[0];
        keys.out[2 * k + 1] = c.value[1];
        keys.in[2 * k + 2] = s.times[k] + c.time[1];
        keys.in[2 * k + 3] = c.value[2];
    }
    return keys;
}

Keys whole_keys(const anim::Sampler& s, uint32_t component, uint32_t count) {
    Keys keys;
    keys.stride = count;
    for (size_t k = 0; k < s.times.size(); ++k) {
        keys.add(s.times[k], straight(s.interpolations[k]));
        auto first = s.values.begin() + std::ptrdiff_t(k * s.stride + component);
        keys.values.insert(keys.values.end(), first, first + count);
    }
    return keys;
}

Keys matrix_keys(const anim::Sampler& s) {
    Keys keys = rotation_keys(
        s, [](std::vector<double>& values, const double* q) { add_matrix(q, values); });
    keys.stride = 16;
    return keys;
}

Keys angle_keys(const anim::Sampler& s, const dvec3& axis) {
    Keys keys = rotation_keys(s, [&](std::vector<double>& values, const double* q) {
        double angle = angle_about(axis, q);
        if (!values.empty()) {
            double turn = std::remainder(angle - values.back(), 360.0);
            if (std::abs(std::cos(radians(0.5 * turn))) <= kHalfTurn) turn = 180;
            angle = values.back() + turn;
        }
        values.push_back(angle);
    });
    for (double& angle : keys.values) angle = float(angle);
    return keys;
}

std::vector<double> written_rotations(const anim::Sampler& s) {
    std::vector<double> turns;
    rotation_keys(s, [&](auto&, const double* q) { turns.insert(turns.end(), q, q + 4); });
    return turns;
}

}  // namespace kinora
