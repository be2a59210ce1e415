// anim/curve_p.h: the kinds of interpolation, a row each, and how a row shapes a segment.
#pragma once

#include "anim/sampler.h"

namespace kinora::anim {

// A tangent of one component at one end of a segment.
struct Tangent {
    enum Form : uint8_t { Missing, OneD, TwoD };
    Form form = Missing;
    double time = 0;  // TwoD: absolute, seconds
    double value = 0;
};

// What a segment's shape may depend on, for one component.
struct SegmentKeys {
    double before, left, right, after;  // values of four keys in a row
    double start, duration;             // seconds; duration > 0
    Tangent out;                        // of the left key
    Tangent in;                         // of the right key
};

struct InterpolationRow {
    bool uses_tangents;  // without them the segment runs straight
    // Fills value and, by 2-D tangents, time; null where the segment is no cubic.
    void (*shape)(const SegmentKeys& keys, CurveSegment& curve);
    // Components [first, first + out.size()) at `offset` seconds after key `segment`.
    void (*evaluate)(const Sampler& sampler, size_t segment, double offset, uint32_t first,
                     std::span<double> out);
};
extern const InterpolationRow kInterpolations[];

inline const InterpolationRow& row(Interpolation i) {
    return kInterpolations[static_cast<int>(i)];
}

// The cubic of one component; clamps control times into the segment.
CurveSegment make_curve(const InterpolationRow& interpolation, const SegmentKeys& keys,
                        SamplerRepairs& repairs);

}  // namespace kinora::anim
