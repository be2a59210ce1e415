// anim/curve.cpp: every interpolation's shape and evaluation (COLLADA 1.4.1, curve interpolation).
#include <algorithm>
#include <cstring>
#include <iterator>

#include "anim/curve_p.h"
#include "anim/time_cubic.h"

namespace kinora::anim {
namespace {

// p + (q - p) s rather than (1 - s) p + s q: a curve at rest stays bit for bit.
double mix(double p, double q, double s) {
    return p + (q - p) * s;
}

void shape_bezier(const SegmentKeys& k, CurveSegment& c) {
    c.value[1] = k.out.form == Tangent::OneD ? k.left + k.out.value : k.out.value;
    c.value[2] = k.in.form == Tangent::OneD ? k.right - k.in.value : k.in.value;
}

// Hermite to Bezier: C0 = P0 + T0 / 3, C1 = P1 - T1 / 3. A 2-D tangent is the control point.
void shape_hermite(const SegmentKeys& k, CurveSegment& c) {
    c.value[1] = k.out.form == Tangent::OneD ? k.left + k.out.value / 3 : k.out.value;
    c.value[2] = k.in.form == Tangent::OneD ? k.right - k.in.value / 3 : k.in.value;
}

// T = half the way from the key before to the key after.
void shape_cardinal(const SegmentKeys& k, CurveSegment& c) {
    c.value[1] = k.left + (k.right - k.before) / 6;
    c.value[2] = k.right - (k.after - k.left) / 6;
}

// The uniform cubic B-spline's Bezier points; written as steps from a key for curves at rest.
void shape_bspline(const SegmentKeys& k, CurveSegment& c) {
    c.value[0] = k.left + ((k.before - k.left) + (k.right - k.left)) / 6;
    c.value[1] = k.left + (k.right - k.left) / 3;
    c.value[2] = k.right - (k.right - k.left) / 3;
    c.value[3] = k.right + ((k.left - k.right) + (k.after - k.right)) / 6;
}

void shape_straight(const SegmentKeys& k, CurveSegment& c) {
    c.value[1] = k.left + (k.right - k.left) / 3;
    c.value[2] = k.right - (k.right - k.left) / 3;
}

void evaluate_step(const Sampler& sampler, size_t segment, double, uint32_t first,
                   std::span<double> out) {
    const double* value = &sampler.values[segment * sampler.stride + first];
    std::copy_n(value, out.size(), out.data());
}

void evaluate_matrix(const Sampler& sampler, size_t segment, double s, uint32_t first,
                     std::span<double> out) {
    Matrix16 m = compose(
        interpolate(sampler.rigid[segment], sampler.rigid[segment + 1], s, sampler.rotation));
    std::copy_n(m.begin() + first, out.size(), out.data());
}

Quaternion quaternion_at(const double* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

void evaluate_rotation(const double* left, const double* right, double s, RotationPath path,
                       uint32_t first, std::span<double> out) {
    Quaternion q = between(quaternion_at(left), quaternion_at(right), s, path);
    const double xyzw[4] = {q.x, q.y, q.z, q.w};
    std::copy_n(xyzw + first, out.size(), out.data());
}

void evaluate_linear(const Sampler& sampler, size_t segment, double offset, uint32_t first,
                     std::span<double> out) {
    double s = offset / (sampler.times[segment + 1] - sampler.times[segment]);
    const double* left = &sampler.values[segment * sampler.stride];
    const double* right = left + sampler.stride;
    // equal keys and the key itself give the document's own numbers
    bool moves = s > 0 && std::memcmp(left, right, sampler.stride * sizeof(double)) != 0;
    if (moves && !sampler.rigid.empty()) return evaluate_matrix(sampler, segment, s, first, out);
    if (moves && sampler.kind == SampleKind::Quaternion)
        return evaluate_rotation(left, right, s, sampler.rotation, first, out);
    for (size_t i = 0; i < out.size(); ++i) out[i] = mix(left[first + i], right[first + i], s);
}

double casteljau(const double p[4], double s) {
    double a = mix(p[0], p[1], s), b = mix(p[1], p[2], s), c = mix(p[2], p[3], s);
    return mix(mix(a, b, s), mix(b, c, s), s);
}

void evaluate_curve(const Sampler& sampler, size_t segment, double offset, uint32_t first,
                    std::span<double> out) {
    double duration = sampler.times[segment + 1] - sampler.times[segment];
    const CurveSegment* curve = &sampler.curves[segment * sampler.stride + first];
    const double* solved = nullptr;  // the control times that s belongs to
    double s = 0;
    for (size_t i = 0; i < out.size(); ++i, ++curve) {
        if (curve->linear_time) {
            out[i] = casteljau(curve->value, offset / duration);
            continue;
        }
        if (!solved || solved[0] != curve->time[0] || solved[1] != curve->time[1])
            s = solve_time_cubic(curve->time, duration, offset);
        solved = curve->time;
        out[i] = casteljau(curve->value, s);
    }
}

void set_times(const SegmentKeys& k, CurveSegment& c, SamplerRepairs& repairs) {
    c.linear_time = k.out.form != Tangent::TwoD && k.in.form != Tangent::TwoD;
    c.time[0] = k.out.form == Tangent::TwoD ? k.out.time - k.start : k.duration / 3;
    c.time[1] = k.in.form == Tangent::TwoD ? k.in.time - k.start : k.duration * 2 / 3;
    for (double& time : c.time) {
        double inside = std::clamp(time, 0.0, k.duration);
        // exporters print few digits: a tangent on its key may fall short of it by a rounding
        if (std::abs(time - inside) > 1e-5 * k.duration) ++repairs.clamped_tangents;
        time = inside;
    }
}

}  // namespace

const InterpolationRow kInterpolations[] = {
    {false, nullptr, evaluate_step},          // Step
    {false, nullptr, evaluate_linear},        // Linear
    {true, shape_bezier, evaluate_curve},     // Bezier
    {true, shape_hermite, evaluate_curve},    // Hermite
    {false, shape_cardinal, evaluate_curve},  // Cardinal
    {false, shape_bspline, evaluate_curve},   // Bspline
};
static_assert(std::size(kInterpolations) == static_cast<size_t>(Interpolation::Count));

CurveSegment make_curve(const InterpolationRow& interpolation, const SegmentKeys& keys,
                        SamplerRepairs& repairs) {
    CurveSegment curve{{keys.left, 0, 0, keys.right}, {0, 0}, true};
    bool straight = !interpolation.shape ||
                    (interpolation.uses_tangents &&
                     (keys.out.form == Tangent::Missing || keys.in.form == Tangent::Missing));
    if (straight) {
        shape_straight(keys, curve);
        return curve;
    }
    interpolation.shape(keys, curve);
    if (interpolation.uses_tangents) set_times(keys, curve, repairs);
    return curve;
}

}  // namespace kinora::anim
