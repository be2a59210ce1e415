// runtime/scene/tessellate/fineness.cpp: numbers of segments, from second derivatives in pixels.
//
// Linear interpolation on a triangle with legs h_u, h_v along the parameters is off by at most
// (h_u^2 |P_uu| + 2 h_u h_v |P_uv| + h_v^2 |P_vv|) / 8 (Filip, Magedson, Markot: Surface algorithms
// using bounds on derivatives, CAGD 3, 1986).
#include "runtime/scene/tessellate/fineness_p.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace kinora::tessellation {

namespace {

constexpr double kSmoothTurn = radians(15);    // of normals along an edge that is to be seen
constexpr double kLargestTurn = radians(100);  // of any edge: closed surfaces stay bodies
constexpr double kSmallEdge = 2;               // pixels: shorter ones may turn more
constexpr double kPixelsWithoutPicture = 1000;
constexpr int kRounds = 3;
constexpr size_t kMostTriangles = 1u << 28;  // indices have 32 bits

std::vector<Line> lattice_lines(const Direction& direction) {
    std::vector<Line> lines;
    const uint32_t n = std::max(2u, direction.lattice);
    for (uint32_t patch = 0; patch < direction.spans.size(); ++patch)
        for (uint32_t k = 0; k < n; ++k) lines.push_back({patch, double(k) / (n - 1), k == 0});
    return lines;
}

// Pixels that patches bend, by the lattice.
struct PatchBend {
    float uu = 0, uv = 0, vv = 0;
};

void raise(float& most, double value) {
    if (value > most && value < 1e30) most = float(value);
}

dvec3 across(dvec3 v, dvec3 along) {
    double square = glm::dot(along, along);
    return square > 0 ? v - glm::dot(v, along) / square * along : v;
}

double angle_between(dvec3 a, dvec3 b) {
    double sine = glm::length(glm::cross(a, b)), cosine = glm::dot(a, b);
    double angle = std::atan2(sine, cosine);
    return std::isfinite(angle) ? angle : 0;
}

// What a line of samples does within a patch, in one direction.
struct Stretch {
    dvec3 p{0.0}, normal{0.0}, tangent{0.0};  // of the last sample
    double pixels = 0, normal_turn = 0, tangent_turn = 0;

    void add(dvec3 at, dvec3 n, dvec3 along, double scale, bool first) {
        if (first) {
            pixels = normal_turn = tangent_turn = 0;
        } else {
            pixels += scale * glm::length(at - p);
            normal_turn += angle_between(normal, n);
            tangent_turn += angle_between(tangent, along);
        }
        p = at, normal = n, tangent = along;
    }
    double segments() const {
        double seen = std::min(normal_turn / kSmoothTurn, pixels / kSmallEdge);
        double body = std::max(normal_turn, tangent_turn) / kLargestTurn;
        double n = std::max({1.0, seen, body});
        return std::isfinite(n) ? n : 1;
    }
};

// Segments wanted, before they are whole numbers.
struct Wanted {
    std::vector<double> u, v;
};

// The bends of all patches, and the segments that turning alone needs.
std::vector<PatchBend> survey(const Sheet& sheet, const PixelMeasure& measure, Wanted& wanted) {
    const std::vector<Line> lines_u = lattice_lines(sheet.u), lines_v = lattice_lines(sheet.v);
    const size_t width = lines_u.size(), columns = sheet.u.spans.size();
    std::vector<PatchBend> bends(columns * sheet.v.spans.size());
    std::vector<Stretch> up(width);
    Stretch along;
    wanted.u.assign(columns, 1.0);
    wanted.v.assign(sheet.v.spans.size(), 1.0);
    sheet.sample(lines_u, lines_v, true, [&](size_t sample, const Jet& jet) {
        const Line &a = lines_u[sample % width], &b = lines_v[sample / width];
        const dvec3 p = measure.place(jet.p), u = measure.vector(jet.u), v = measure.vector(jet.v);
        const double scale = measure.at(p);
        if (!std::isfinite(scale)) return;
        dvec3 n = glm::cross(u, v);
        double area = glm::length(n);
        n = area > 0 ? n / area : dvec3(0.0);
        PatchBend& bend = bends[b.patch * columns + a.patch];
        const dvec3 uu = measure.vector(jet.uu), uv = measure.vector(jet.uv),
                    vv = measure.vector(jet.vv);
        raise(bend.uu, scale * std::max(glm::length(across(uu, u)), glm::length(uu) / kSlide));
        raise(bend.vv, scale * std::max(glm::length(across(vv, v)), glm::length(vv) / kSlide));
        raise(bend.uv, scale * std::max(std::abs(glm::dot(uv, n)), glm::length(uv) / kSlide));
        along.add(p, n, u, scale, a.first);
        up[sample % width].add(p, n, v, scale, b.first);
        wanted.u[a.patch] = std::max(wanted.u[a.patch], along.segments());
        wanted.v[b.patch] = std::max(wanted.v[b.patch], up[sample % width].segments());
    });
    return bends;
}

// More segments, where they help most, until no patch is off by more than the error.
void subdivide(const std::vector<PatchBend>& bends, double error, Wanted& wanted) {
    constexpr int kSteps = 24;
    constexpr double kNearly = 1.001;
    const size_t columns = wanted.u.size();
    bool changed = true;
    for (int step = 0; step < kSteps && changed; ++step) {
        changed = false;
        for (size_t k = 0; k < bends.size(); ++k) {
            double &n = wanted.u[k % columns], &m = wanted.v[k / columns];
            const PatchBend& bend = bends[k];
            if (step == 0) {
                n = std::max(n, std::sqrt(bend.uu / (8 * error)));
                m = std::max(m, std::sqrt(bend.vv / (8 * error)));
            }
            const double along = bend.uu / (n * n), up = bend.vv / (m * m);
            const double off = (along + 2 * bend.uv / (n * m) + up) / 8;
            if (!(off > kNearly * error)) continue;
            const bool twisted = 2 * bend.uv / (n * m) > along + up;  // either does: none gets long
            const bool by_u = twisted ? n <= m : along >= up;
            (by_u ? n : m) *= std::sqrt(off / error);
            changed = true;
        }
    }
}

double sum(const std::vector<double>& values) {
    double result = 0;
    for (double value : values) result += value;
    return result;
}

double whole(double segments) {
    return std::max(1.0, std::ceil(segments - 1e-6));
}

double triangles_of(const Wanted& wanted) {
    double u = 0, v = 0;
    for (double n : wanted.u) u += whole(n);
    for (double n : wanted.v) v += whole(n);
    return 2 * u * v;
}

// Returns whether it was needed.
bool limit_triangles(size_t triangles, Wanted& wanted) {
    const double most = double(std::max<size_t>(triangles, 2));
    bool limited = false;
    while (triangles_of(wanted) > most) {
        const double ones = double(wanted.u.size() + wanted.v.size());
        if (sum(wanted.u) + sum(wanted.v) <= ones) break;
        const double less = std::min(0.97, std::sqrt(most / triangles_of(wanted)));
        for (auto* list : {&wanted.u, &wanted.v})
            for (double& n : *list) n = std::max(1.0, less * n);
        limited = true;
    }
    return limited;
}

std::vector<uint32_t> whole_numbers(const std::vector<double>& wanted) {
    std::vector<uint32_t> result;
    for (double n : wanted) result.push_back(uint32_t(whole(n)));
    return result;
}

// One segment for several patches where patches alone are too many.
uint32_t patches_to_merge(const Fineness& fineness, size_t triangles) {
    const double most = double(std::max<size_t>(triangles, 2));
    auto segments = [](size_t patches, uint32_t merged) {
        return double((patches + merged - 1) / merged);
    };
    uint32_t merged = 1;
    while (2 * segments(fineness.u.size(), merged) * segments(fineness.v.size(), merged) > most)
        ++merged;
    return merged;
}

}  // namespace

PixelMeasure::PixelMeasure(const PictureScale& scale, FunctionRef<double()> size) {
    if (scale.pixels > 0 && std::isfinite(scale.pixels)) {
        linear_ = dmat3(scale.to_camera);
        offset_ = dvec3(scale.to_camera[3]);
        orthographic_ = scale.orthographic;
        pixels_ = scale.pixels;
        near_ = scale.near > 0 ? scale.near : 1e-3;
        return;
    }
    const double largest = size();
    if (largest > 0) pixels_ = kPixelsWithoutPicture / largest;
}

double largest_extent(const Sheet& sheet) {
    dvec3 low(1e300), high(-1e300);
    sheet.sample(lattice_lines(sheet.u), lattice_lines(sheet.v), false,
                 [&](size_t, const Jet& jet) {
                     if (!is_finite(jet.p)) return;
                     low = glm::min(low, jet.p);
                     high = glm::max(high, jet.p);
                 });
    const dvec3 size = glm::max(high - low, dvec3(0.0));
    return std::max({size.x, size.y, size.z});
}

// Away from the axis, what moves outwards along the ray's slope moves more in the picture.
double PixelMeasure::at(dvec3 p) const {
    if (orthographic_) return pixels_;
    const double distance = std::max(glm::length(p), near_);
    const double least = distance / std::sqrt(1 + kWidestView * kWidestView);
    const double depth = std::max({p.z, least, near_});
    return pixels_ * std::max(distance, depth) / (depth * depth);
}

Fineness choose_fineness(const Sheet& sheet, const PixelMeasure& measure,
                         const TessellationLimits& limits) {
    const double error = limits.error > 0 ? limits.error : 0.25;
    const size_t triangles = std::min<size_t>(limits.triangles, kMostTriangles);
    Wanted wanted;
    subdivide(survey(sheet, measure, wanted), error, wanted);
    Fineness result;
    for (int round = 0; round < kRounds; ++round) {
        const bool limited = limit_triangles(triangles, wanted);
        result.u = whole_numbers(wanted.u);
        result.v = whole_numbers(wanted.v);
        const Deviation deviation = measure_deviation(sheet, measure, result);
        result.error = deviation.most();
        if (limited || !(result.error > error)) break;
        auto refine = [&](std::vector<double>& list, const std::vector<double>& off) {
            for (size_t k = 0; k < list.size(); ++k)
                if (off[k] > error) list[k] = whole(list[k]) * 1.05 * std::sqrt(off[k] / error);
        };
        refine(wanted.u, deviation.u);
        refine(wanted.v, deviation.v);
    }
    result.merged = patches_to_merge(result, triangles);
    return result;
}

std::vector<Line> make_lines(const std::vector<uint32_t>& segments, uint32_t merged) {
    std::vector<Line> lines;
    const uint32_t patches = uint32_t(segments.size());
    for (uint32_t patch = 0; patch < patches; patch += merged) {
        const uint32_t n = segments[patch];
        if (merged == 1) {
            for (uint32_t k = 0; k <= n; ++k) lines.push_back({patch, double(k) / n, k == 0});
            continue;
        }
        lines.push_back({patch, 0, true});
        lines.push_back({std::min(patches, patch + merged) - 1, 1, false});
    }
    return lines;
}

}  // namespace kinora::tessellation
