// runtime/scene/tessellate/sheet.cpp: lines of a surface, and its normals.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/tessellate/sheet_p.h"

namespace kinora::tessellation {

namespace {

constexpr double kFirstStep = 1e-5;  // inwards, of a patch
constexpr double kLastStep = 0.3;

double step_inside(double t, double step) {
    return t + 2 * step * (0.5 - t);
}

dvec3 unit_or_none(dvec3 v) {
    double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : dvec3(0.0);
}

dvec3 inner_normal(const Sheet& sheet, Line u, Line v, double step) {
    u.t = step_inside(u.t, step);
    v.t = step_inside(v.t, step);
    Jet jet = sheet.jet(u, v);
    return unit_or_none(glm::cross(jet.u, jet.v));
}

}  // namespace

// With s the radius over the last one, s = bow + (1 - bow) t, heights are as s^2.
double Direction::part(double t) const {
    if (bow >= 1) return t;
    return t * (2 * bow + (1 - bow) * t) / (1 + bow);
}

double Direction::part_rate(double t) const {
    constexpr double kLeast = 1e-6;  // dP/dv of a paraboloid grows without limit towards its tip
    return bow >= 1 ? 1 : std::max(kLeast, 2 * (bow + (1 - bow) * t) / (1 + bow));
}

double Direction::from_part(double part) const {
    if (bow >= 1) return part;
    double s = std::sqrt(std::max(0.0, bow * bow + part * (1 - bow * bow)));
    return (s - bow) / (1 - bow);
}

double Direction::parameter(const Line& line) const {
    const Span& span = spans[line.patch];
    double k = part(line.t);
    return (1 - k) * span.low + k * span.high;
}

double Direction::parameter_rate(const Line& line) const {
    const Span& span = spans[line.patch];
    return (span.high - span.low) * part_rate(line.t);
}

Line Direction::locate(double parameter) const {
    auto after = std::upper_bound(spans.begin() + 1, spans.end(), parameter,
                                  [](double value, const Span& span) { return value < span.low; });
    const Span& span = *(after - 1);
    double k = (parameter - span.low) / (span.high - span.low);
    return {uint32_t(&span - spans.data()),
            from_part(std::isfinite(k) ? std::clamp(k, 0.0, 1.0) : 0)};
}

CornerBlend corner_blend(const Direction& direction, const Line& line) {
    const Span& span = direction.spans[line.patch];
    double k = direction.part(line.t);
    return {span.segment, (span.segment + 1) % std::max(1u, direction.corners()),
            (1 - k) * span.enter + k * span.leave};
}

Jet Sheet::jet(Line line_u, Line line_v) const {
    Jet result;
    sample({&line_u, 1}, {&line_v, 1}, true, [&](size_t, const Jet& jet) { result = jet; });
    return result;
}

dvec3 unit_normal(const Sheet& sheet, Line u, Line v) {
    constexpr double kNothing = 1e-9;
    const Jet jet = sheet.jet(u, v);
    const double mixed = glm::length(jet.uv);
    const double size_u = std::max({glm::length(jet.u), glm::length(jet.uu), mixed});
    const double size_v = std::max({glm::length(jet.v), glm::length(jet.vv), mixed});
    dvec3 cross = glm::cross(jet.u, jet.v);
    double length = glm::length(cross);
    if (length > kNothing * size_u * size_v && std::isfinite(length)) return cross / length;
    // Two steps of different length: what is in proportion to the step cancels.
    for (double step = kFirstStep; step <= kLastStep; step *= 30) {
        dvec3 near = inner_normal(sheet, u, v, step), far = inner_normal(sheet, u, v, 2 * step);
        dvec3 n = unit_or_none(2.0 * near - far);
        if (n != dvec3(0.0)) return n;
    }
    return dvec3(0.0);
}

}  // namespace kinora::tessellation
