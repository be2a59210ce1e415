// runtime/scene/tessellate/deviation.cpp: how far triangles are from their surface, by samples.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/tessellate/fineness_p.h"

namespace kinora::tessellation {

namespace {

constexpr uint32_t kOneCellOf = 8;     // in each direction
constexpr uint32_t kMostPatches = 64;  // with probes

// For some segments of each patch their ends and middles, three lines a segment.
std::vector<Line> probe_lines(const std::vector<uint32_t>& segments) {
    std::vector<Line> lines;
    const uint32_t step = uint32_t(segments.size() / kMostPatches) + 1;
    for (uint32_t patch = 0; patch < segments.size(); patch += step) {
        const uint32_t n = segments[patch], probes = (n + kOneCellOf - 1) / kOneCellOf;
        for (uint32_t k = 0; k < probes; ++k) {
            const uint32_t cell = uint32_t((k + 0.5) * n / probes);
            for (int half = 0; half < 3; ++half)
                lines.push_back({patch, (cell + 0.5 * half) / n, half == 0});
        }
    }
    return lines;
}

double from_line(dvec3 p, dvec3 a, dvec3 b) {
    dvec3 along = b - a, to = p - a;
    double square = glm::dot(along, along);
    if (square > 0) to -= glm::dot(to, along) / square * along;
    return glm::length(to);
}

// From the plane through a diagonal, along the other.
double from_plane(dvec3 p, dvec3 a, dvec3 b, dvec3 other) {
    dvec3 normal = glm::cross(b - a, other);
    double length = glm::length(normal);
    return length > 0 ? std::abs(glm::dot(p - a, normal)) / length : from_line(p, a, b);
}

void raise_to(double& most, double value) {
    if (value > most && std::isfinite(value)) most = value;
}

}  // namespace

double Deviation::most() const {
    double result = 0;
    for (double e : u) result = std::max(result, e);
    for (double e : v) result = std::max(result, e);
    return result;
}

Deviation measure_deviation(const Sheet& sheet, const PixelMeasure& measure,
                            const Fineness& fineness) {
    const std::vector<Line> lines_u = probe_lines(fineness.u), lines_v = probe_lines(fineness.v);
    const size_t width = lines_u.size();
    std::vector<dvec3> rows(3 * width);  // of one cell's height
    Deviation result{std::vector<double>(fineness.u.size(), 0.0),
                     std::vector<double>(fineness.v.size(), 0.0)};
    auto compare = [&](size_t row) {
        double& most_v = result.v[lines_v[row].patch];
        for (size_t i = 0; i < width; i += 3) {
            double& most_u = result.u[lines_u[i].patch];
            const dvec3 *low = &rows[i], *middle = low + width, *high = middle + width;
            const double pixels = measure.at(middle[1]);
            raise_to(most_u, pixels * from_line(low[1], low[0], low[2]));
            raise_to(most_u, pixels * from_line(high[1], high[0], high[2]));
            raise_to(most_v, pixels * from_line(middle[0], low[0], high[0]));
            raise_to(most_v, pixels * from_line(middle[2], low[2], high[2]));
            const dvec3 up = high[2] - low[0], down = high[0] - low[2];
            const double centre = std::max(from_plane(middle[1], low[0], high[2], down),
                                           from_plane(middle[1], low[2], high[0], up));
            raise_to(most_u, pixels * centre);
            raise_to(most_v, pixels * centre);
        }
    };
    sheet.sample(lines_u, lines_v, false, [&](size_t sample, const Jet& jet) {
        rows[sample % (3 * width)] = measure.place(jet.p);
        if (sample % (3 * width) == 3 * width - 1) compare(sample / width);
    });
    return result;
}

}  // namespace kinora::tessellation
