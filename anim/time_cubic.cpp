// anim/time_cubic.cpp: a bracketed Newton solver about the segment's flattest point.
//
// Plain Newton leaves vertical tangents by whole units (docs/numerics.md#keys). Two things cure it:
// the root stays in a bracket that halves when Newton does not help, and the cubic is written about
// the parameter where its slope is least (within the segment, or the nearer end), f(w) = d w +
// e w^2 + a w^3 - r. There, where a double or triple root makes the answer sensitive, f's terms are
// small and so are their roundings.
#include "anim/time_cubic.h"

#include <algorithm>
#include <cmath>

namespace kinora::anim {
namespace {

struct Cubic {
    double d, e, a;
    double at(double w) const { return ((a * w + e) * w + d) * w; }
    double slope(double w) const { return (3 * a * w + 2 * e) * w + d; }
};

// A first guess for f(w) = r: each term alone would reach r at its own root; the nearest counts.
double first_guess(const Cubic& f, double r) {
    double size = std::abs(r);
    double w = std::min({size / f.d, std::sqrt(size / std::abs(f.e)),
                         std::cbrt(size / std::abs(f.a))});  // an absent term gives infinity
    return std::copysign(w, r);
}

// The root of f(w) = r in [low, high], f growing there.
double bracketed_root(const Cubic& f, double r, double low, double high) {
    if (r == 0) return std::clamp(0.0, low, high);
    (r > 0 ? low : high) = std::clamp(0.0, low, high);  // f(0) = 0
    double w = first_guess(f, r);
    if (!(w > low && w < high)) w = 0.5 * (low + high);
    for (int i = 0; i < 100; ++i) {
        double miss = f.at(w) - r;
        if (miss == 0) return w;
        (miss < 0 ? low : high) = w;
        double next = w - miss / f.slope(w);
        // also catches a slope of zero; a step that leaves the bracket halves it instead
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        if (std::abs(next - w) <= 1e-16 * std::abs(next)) return next;
        w = next;
    }
    return w;
}

}  // namespace

double solve_time_cubic(const double time[2], double duration, double offset) {
    if (!(offset > 0)) return 0;
    if (offset >= duration) return 1;
    double x0 = time[0], x1 = time[1];
    bool mirrored = offset > 0.5 * duration;  // seen from the nearer end; both may be flat
    if (mirrored) {
        double swapped = duration - x1;
        x1 = duration - x0;
        x0 = swapped;
        offset = duration - offset;
    }
    // X(s) = c1 s + c2 s^2 + c3 s^3
    double c1 = 3 * x0, c2 = 3 * (x1 - 2 * x0), c3 = duration + 3 * (x0 - x1);
    double centre = c3 > 0 ? std::clamp(-c2 / (3 * c3), 0.0, 1.0) : 0.0;
    bool inside = centre > 0 && centre < 1;
    if (!inside) centre = 0;
    Cubic about;
    about.d = std::max(0.0, c1 + centre * (2 * c2 + 3 * c3 * centre));
    about.e = inside ? 0 : c2;  // the slope's minimum has no second derivative
    about.a = c3;
    double reached = ((c3 * centre + c2) * centre + c1) * centre;
    double s = centre + bracketed_root(about, offset - reached, -centre, 1 - centre);
    s = std::clamp(s, 0.0, 1.0);
    return mirrored ? 1 - s : s;
}

}  // namespace kinora::anim
