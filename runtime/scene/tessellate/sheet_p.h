// runtime/scene/tessellate/sheet_p.h: a surface as rows and columns of patches, seen on lines.
//
// Patches have parameters of their own, from 0 to 1. A line is a place in one direction: a patch
// and its parameter. Samples are where a line of u and one of v meet, u fastest.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/description/curved_surface.h"

namespace kinora::tessellation {

// A place and its derivatives by the patch's parameters.
struct Jet {
    dvec3 p{0.0}, u{0.0}, v{0.0};
    dvec3 uu{0.0}, uv{0.0}, vv{0.0};
};

struct Line {
    uint32_t patch = 0;
    double t = 0;
    bool first = false;  // no cell lies between it and the line before
};

// A patch in one direction.
struct Span {
    uint32_t first = 0;           // of the control points that it blends
    uint32_t segment = 0;         // counts values of uniform variables
    double low = 0, high = 1;     // the surface's parameter
    double enter = 0, leave = 1;  // the part of the segment that is drawn
};

struct Direction {
    std::vector<Span> spans = std::vector<Span>(1);
    uint32_t segments = 1;
    bool wraps = false;  // the last segment ends where the first begins
    uint32_t order = 2;  // control points that a patch blends
    uint32_t points = 2;
    uint32_t lattice = 2;  // samples that show how a patch bends
    // t of a patch and its parameter are in proportion, or, below 1, as the height and the radius
    // of a paraboloid whose radius begins at this part of the last one.
    double bow = 1;

    uint32_t corners() const { return wraps ? segments : segments + 1; }
    double part(double t) const;          // of the patch's parameters that lie below t
    double part_rate(double t) const;     // its derivative
    double from_part(double part) const;  // the inverse
    double parameter(const Line& line) const;
    double parameter_rate(const Line& line) const;
    Line locate(double parameter) const;
};

// Which two of the corners that varying variables have, and where between them.
struct CornerBlend {
    uint32_t from = 0, to = 0;
    double t = 0;
};
CornerBlend corner_blend(const Direction& direction, const Line& line);

using JetSink = FunctionRef<void(size_t sample, const Jet& jet)>;

class Sheet {
  public:
    virtual ~Sheet() = default;
    // In the order of samples; without `second`, second derivatives are left as they are.
    virtual void sample(std::span<const Line> u, std::span<const Line> v, bool second,
                        JetSink sink) const = 0;
    // Values of the control points (u fastest), blended as places are, for each sample.
    virtual std::vector<float> blend(std::span<const float> values, uint32_t components,
                                     std::span<const Line> u, std::span<const Line> v) const = 0;
    Jet jet(Line u, Line v) const;

    Direction u, v;
};

// Null where the surface's numbers give none.
std::unique_ptr<Sheet> make_sheet(const CurvedSurface& surface);
std::unique_ptr<Sheet> make_quadric(const CurvedSurface& surface);
std::unique_ptr<Sheet> make_net(const CurvedSurface& surface);

// The unit normal along dP/du x dP/dv; where that is none, its limit from inside the patch; zero
// where it has no limit.
dvec3 unit_normal(const Sheet& sheet, Line u, Line v);

// Four values at the corners (low, low), (high, low), (low, high), (high, high).
template <class T>
T bilinear(const T& p00, const T& p10, const T& p01, const T& p11, double u, double v) {
    return (1 - v) * ((1 - u) * p00 + u * p10) + v * ((1 - u) * p01 + u * p11);
}

inline bool is_finite(dvec3 p) {
    return p.x - p.x == 0 && p.y - p.y == 0 && p.z - p.z == 0;
}

}  // namespace kinora::tessellation
