// runtime/scene/tessellate/basis.cpp: linear, cubic and B-spline weights, and where patches lie.
#include "runtime/scene/tessellate/basis_p.h"

#include <algorithm>
#include <cmath>

namespace kinora::tessellation {

namespace {

constexpr uint32_t kCubicLattice = 3;  // second derivatives are linear along the parameter

void linear_weights(const Basis&, const Line& line, Weights& w) {
    w.value[0] = 1 - line.t, w.value[1] = line.t;
    w.first[0] = -1, w.first[1] = 1;
    w.second[0] = w.second[1] = 0;
}

void cubic_weights(const Basis& basis, const Line& line, Weights& w) {
    const double t = line.t;
    for (int k = 0; k < 4; ++k) {
        const dvec4& m = (*basis.matrix)[k];
        w.value[k] = ((m[0] * t + m[1]) * t + m[2]) * t + m[3];
        w.first[k] = (3 * m[0] * t + 2 * m[1]) * t + m[2];
        w.second[k] = 6 * m[0] * t + 2 * m[1];
    }
}

// What B-splines of one degree are made of those of the degree below, on the interval behind
// `knot`: w[r] belongs to the control point knot - degree + r. As values (de Boor, A Practical
// Guide to Splines, chapter IX) or as derivatives (chapter X).
void raise_value(const double* knot, uint32_t degree, double x, double* w) {
    double saved = 0;
    for (uint32_t r = 0; r < degree; ++r) {
        double right = knot[r + 1], left = knot[int(r) + 1 - int(degree)];
        double part = w[r] / (right - left);
        w[r] = saved + (right - x) * part;
        saved = (x - left) * part;
    }
    w[degree] = saved;
}

void raise_derivative(const double* knot, uint32_t degree, double* w) {
    double saved = 0;
    for (uint32_t r = 0; r < degree; ++r) {
        double right = knot[r + 1], left = knot[int(r) + 1 - int(degree)];
        double part = degree * w[r] / (right - left);
        w[r] = saved - part;
        saved = part;
    }
    w[degree] = saved;
}

void spline_weights(const Basis& basis, const Line& line, Weights& w) {
    const Span& span = basis.direction->spans[line.patch];
    const uint32_t degree = basis.direction->order - 1;
    const double* knot = basis.knots.data() + span.first + degree;
    const double x = (1 - line.t) * span.low + line.t * span.high, width = span.high - span.low;
    std::fill_n(w.first, degree + 1, 0.0);
    std::fill_n(w.second, degree + 1, 0.0);
    w.value[0] = 1;
    for (uint32_t q = 1; q <= degree; ++q) {
        if (q + 1 == degree) std::copy_n(w.value, q, w.second);
        if (q == degree) std::copy_n(w.value, q, w.first);
        raise_value(knot, q, x, w.value);
    }
    raise_derivative(knot, degree, w.first);
    if (degree > 1) {
        raise_derivative(knot, degree - 1, w.second);
        raise_derivative(knot, degree, w.second);
    }
    for (uint32_t k = 0; k <= degree; ++k) {
        w.first[k] *= width;
        w.second[k] *= width * width;
    }
}

struct MeshRow {
    uint32_t order;
    uint32_t lattice;
    void (*weights)(const Basis&, const Line&, Weights&);
};
constexpr MeshRow kLinear = {2, 2, linear_weights}, kCubic = {4, kCubicLattice, cubic_weights};

// RISpec 3.2, section 5.2 (Patches): RiPatchMesh.
bool cut_mesh(const MeshRow& row, const PatchDirection& from, uint32_t step, Direction& direction) {
    const uint32_t n = from.points;
    if (n < row.order || step == 0) return false;
    const uint32_t patches = from.periodic ? n / step : (n - row.order) / step + 1;
    if (patches == 0) return false;
    direction.order = row.order;
    direction.points = n;
    direction.lattice = row.lattice;
    direction.segments = patches;
    direction.wraps = from.periodic;
    direction.spans.clear();
    for (uint32_t k = 0; k < patches; ++k)
        direction.spans.push_back(
            {k * step, k, double(k) / patches, double(k + 1) / patches, 0, 1});
    return true;
}

// An order above the number of points is lowered to it; as many knots less are taken from both
// ends.
std::vector<double> fitting_knots(const PatchDirection& from, uint32_t order) {
    const size_t less = from.order - order, needed = size_t(from.points) + order;
    const size_t front = (less + 1) / 2;
    if (from.knots.size() < needed + less) return {};
    auto begin = from.knots.begin() + ptrdiff_t(front);
    std::vector<double> knots(begin, begin + ptrdiff_t(needed));
    bool sound = std::is_sorted(knots.begin(), knots.end()) &&
                 std::all_of(knots.begin(), knots.end(), [](double k) { return std::isfinite(k); });
    return sound ? knots : std::vector<double>();
}

// RISpec 3.2, section 5.2 (NURBS): the intervals of the knots that hold something of the range
// drawn.
bool cut_spline(const PatchDirection& from, Basis& basis, Direction& direction) {
    const uint32_t n = from.points, order = std::min(from.order, n);
    if (order < 2 || order > kLargestOrder) return false;
    basis.knots = fitting_knots(from, order);
    if (basis.knots.empty() || !(from.low < from.high)) return false;
    direction.order = order;
    direction.points = n;
    direction.lattice = std::max(kCubicLattice, order - 1);
    direction.segments = n - order + 1;
    direction.spans.clear();
    for (uint32_t k = order - 1; k < n; ++k) {
        const double begin = basis.knots[k], end = basis.knots[k + 1];
        const double low = std::max(begin, from.low), high = std::min(end, from.high);
        if (!(low < high) || !std::isfinite(end - begin)) continue;
        const uint32_t first = k + 1 - order;
        direction.spans.push_back({first, first, low, high, (low - begin) / (end - begin),
                                   (high - begin) / (end - begin)});
    }
    return !direction.spans.empty();
}

}  // namespace

std::optional<Basis> make_basis(CurvedKind kind, const PatchDirection& from, Direction& direction) {
    Basis basis;
    basis.direction = &direction;
    basis.matrix = &from.basis;
    const MeshRow& row = kind == CurvedKind::Bilinear ? kLinear : kCubic;
    basis.weights = kind == CurvedKind::Nurbs ? spline_weights : row.weights;
    const uint32_t step = kind == CurvedKind::Bilinear ? 1 : from.step;
    bool sound = kind == CurvedKind::Nurbs ? cut_spline(from, basis, direction)
                                           : cut_mesh(row, from, step, direction);
    if (!sound) return std::nullopt;
    return basis;
}

}  // namespace kinora::tessellation
