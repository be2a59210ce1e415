// runtime/scene/build/framing.h: the nearest eye that has given points in its picture.
#pragma once

#include <array>
#include <optional>

#include "runtime/base/math.h"

namespace kinora {

// Unit vectors of a view: what is right, what is up, and from what is seen towards the eye.
struct ViewAxes {
    dvec3 right, up, back;
};

// The points may take this share of the picture's width and of its height.
inline constexpr double kFramedShare = 0.85;

// Frames points by their projections, exactly. A point (a, b, c) in the view's axes is inside a
// window that is t wide on either side at distance 1 where |a - eye.a| <= t (eye.c - c). So the
// largest a + t c and -a + t c over all points say how near the eye may be, and where it stands.
class Framing {
  public:
    // Half of the picture's sides at distance 1.
    Framing(const ViewAxes& axes, double half_width, double half_height);

    // The points are seen from all sides: each runs on a circle about `axis` (unit) through 0.
    void turn_about(dvec3 axis) { axis_ = axis; }
    // 0 is to be seen in the middle of the picture.
    void keep_centre() { centred_ = true; }

    void add(dvec3 p);
    bool empty() const { return nearest_ < farthest_; }

    dvec3 perspective_eye() const;
    // Of parallel rays: the eye, and half of the picture's height.
    struct Parallel {
        dvec3 eye;
        double half_height;
    };
    Parallel parallel_eye() const;

  private:
    // From parallel rays (0) to the picture's own window: where the points leave room in one
    // direction, a narrower window says how they come to its middle.
    static constexpr size_t kWindows = 8;
    struct Side {
        double window = 0;                                 // half, at distance 1
        std::array<double, kWindows + 1> plus{}, minus{};  // the largest a + t c and -a + t c

        double step(size_t k) const { return window * double(k) / kWindows; }  // t
        double extent(size_t k) const { return 0.5 * (plus[k] + minus[k]); }
        double middle(double distance) const;
    };
    double half_extent(const Side& side, size_t k) const;  // of a + t c, about the eye's axis
    dvec3 world_point(double across, double up, double depth) const;

    ViewAxes axes_;
    std::array<Side, 2> sides_;                   // across, up
    double nearest_ = -1e300, farthest_ = 1e300;  // along `back`; nearest < farthest: no point
    std::optional<dvec3> axis_;
    bool centred_ = false;
};

}  // namespace kinora
