// anim/sampler.h: a curve through keys: n numbers as a function of time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "anim/decompose.h"

namespace kinora::anim {

// How a segment runs from its left key to the next (docs/format.md#transforms-and-animation):
//   BEZIER   2-D tangents are absolute (time, value) control points, the time being a cubic of its
//            own; 1-D ones are relative, C0 = P0 + OUT, C1 = P1 - IN, with times at the thirds.
//   HERMITE  1-D tangents are derivatives over the segment's 0..1; 2-D ones are absolute points
//            like BEZIER's, T0 = 3 (C0 - P0), T1 = 3 (P1 - C1) (COLLADA 1.4.1, curve equivalence).
//   CARDINAL, BSPLINE  uniform Catmull-Rom and cubic B-spline over the keys' values, time linear in
//            the segment; beyond the ends the first (last) two keys continue in a line.
enum class Interpolation : uint8_t { Step, Linear, Bezier, Hermite, Cardinal, Bspline, Count };

// What holds before the first and after the last key (COLLADA 1.5 sampler).
enum class Behaviour : uint8_t {
    Constant,       // the end key's value
    Linear,         // the line through the two keys at that end
    Cycle,          // the curve again
    CycleRelative,  // the curve again, each time on from where it ended
    Oscillate,      // the curve to and fro
    Count
};

// Numbers: every component by itself. Matrix: 16 numbers in document (row-major) order; LINEAR
// segments interpolate translation, rotation (slerp) and stretch apart, others work on the numbers.
// Quaternion: a rotation as x y z w (glTF's order); LINEAR segments slerp the shorter way, others
// work on the numbers; what comes out is unit (identity where the numbers vanish).
enum class SampleKind : uint8_t { Numbers, Matrix, Quaternion };

// The arrays of a <sampler> as they stand in the file; only viewed.
struct SamplerSource {
    std::span<const double> times = {};                  // n keys, seconds
    std::span<const double> values = {};                 // n * stride
    uint32_t stride = 1;                                 // numbers per key
    std::span<const Interpolation> interpolations = {};  // n, or 1 for all, or none (LINEAR)
    std::span<const double> in_tangents = {};            // n * in_stride, or none
    std::span<const double> out_tangents = {};           // n * out_stride, or none
    // Numbers per key in the tangent arrays. stride: 1-D. 2 * stride: a (time, value) pair for each
    // component. stride + 1 (stride > 1): one time, then the values. Others count as missing.
    uint32_t in_stride = 1;
    uint32_t out_stride = 1;
    Behaviour pre = Behaviour::Constant;
    Behaviour post = Behaviour::Constant;
    SampleKind kind = SampleKind::Numbers;
};

// What make_sampler had to put right; all counts, for the caller to report.
struct SamplerRepairs {
    uint32_t missing_values = 0;    // keys without their values (array too short): dropped
    uint32_t non_finite_keys = 0;   // NaN or infinite time or value: dropped
    uint32_t unsorted_keys = 0;     // keys earlier than the one before: sorted, stably
    uint32_t duplicate_times = 0;   // keys at the time of the one before: kept, the right one wins
    uint32_t missing_tangents = 0;  // segments that need tangents and have none: straight
    uint32_t bad_tangents = 0;      // tangent numbers that are not finite: straight
    uint32_t clamped_tangents = 0;  // control times outside their segment: moved to its end
    uint32_t bad_stride = 0;        // 1: a tangent stride that fits no layout, a matrix without 16
                                    // numbers or a quaternion without 4 (then treated as numbers)
    bool any() const {
        return missing_values | non_finite_keys | unsorted_keys | duplicate_times |
               missing_tangents | bad_tangents | clamped_tangents | bad_stride;
    }
};
// "2 keys out of order sorted, 1 unfitting stride"; "" where nothing was lost or moved.
std::string to_text(const SamplerRepairs& repairs);

// One component of one curved segment as a cubic Bezier; times are offsets from the left key.
struct CurveSegment {
    double value[4];
    double time[2];    // inner control times, both within the segment
    bool linear_time;  // time[] lies at the thirds: no cubic to solve
};

// Keys made ready to evaluate. Made by make_sampler only; immutable afterwards.
struct Sampler {
    std::vector<double> times;  // ascending
    std::vector<double> values;
    uint32_t stride = 1;
    std::vector<Interpolation> interpolations;  // per key: the segment to its right
    std::vector<CurveSegment> curves;  // segment * stride + component; empty if none is curved
    std::vector<RigidStretch> rigid;   // per key; empty unless kind is Matrix
    Behaviour pre = Behaviour::Constant;
    Behaviour post = Behaviour::Constant;
    SampleKind kind = SampleKind::Numbers;
    RotationPath rotation = RotationPath::Slerp;  // of matrices and quaternions

    bool empty() const { return times.empty(); }
    double first_time() const { return times.front(); }
    double last_time() const { return times.back(); }
};

// Sorts, drops and clamps as SamplerRepairs says. Never fails; a source without a usable key gives
// an empty sampler. O(n), O(n log n) where keys are unsorted.
Sampler make_sampler(const SamplerSource& source, SamplerRepairs* repairs = nullptr);

// Components [first, first + out.size()) at `time` (seconds; NaN counts as the first key's time).
// The sampler must not be empty and the range must lie within its stride. O(log n) in the keys, no
// allocation.
void evaluate(const Sampler& sampler, double time, uint32_t first, std::span<double> out);

}  // namespace kinora::anim
