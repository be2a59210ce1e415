// raytrace/tiles/tile_planes.cpp: a filter each for the film's planes.
#include "raytrace/tiles/tile_planes_p.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "raytrace/sampling.h"

namespace kinora::raytrace {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool any_nearest(std::span<const AovPlane> planes) {
    return std::ranges::count(planes, AovFilter::Nearest, &AovPlane::filter) > 0;
}

bool any_variance(std::span<const AovPlane> planes) {
    return std::ranges::count(planes, AovOrigin::Variance, &AovPlane::origin) > 0;
}

bool is_coverage(const AovPlane& plane) {
    return plane.origin == AovOrigin::Coverage;
}

// What a pixel begins with.
double first_value(const AovPlane& plane) {
    switch (plane.filter) {
        case AovFilter::Mean:
        case AovFilter::Average:
            return 0;
        case AovFilter::Nearest:
            return double(plane.background);
        case AovFilter::Least:
            return kInfinity;
        case AovFilter::Most:
            return -kInfinity;
    }
    return 0;
}

double along_axis(const FilterTable& filter, double u) {
    const double x = u * kFilterCells;
    const size_t cell = std::min<size_t>(size_t(x), kFilterCells - 1);
    const FilterTable::Cell& first = filter.cells[filter.linear ? 0 : cell];
    return first.value + first.step * (filter.linear ? x : x - double(cell));
}

}  // namespace

void PlaneMemory::reserve(std::span<const AovPlane> planes, size_t pixels) {
    sums.resize(planes.size());
    for (auto& sum : sums) sum.resize(std::max(sum.size(), pixels));
    if (!planes.empty()) hit.resize(std::max(hit.size(), pixels));
    if (any_nearest(planes)) nearest.resize(std::max(nearest.size(), pixels));
    covered.resize(planes.size());
    if (!any_variance(planes)) return;
    mean.resize(std::max(mean.size(), 3 * pixels));
    squares.resize(std::max(squares.size(), 3 * pixels));
    counted.resize(std::max(counted.size(), pixels));
}

TilePlanes::TilePlanes(const Film& film, const IntegratorSettings& settings,
                       const FilterTable* filter, PlaneMemory& memory)
    : film_(film),
      settings_(settings),
      filter_(filter),
      m_(memory),
      has_nearest_(any_nearest(film.aovs)),
      has_variance_(any_variance(film.aovs)),
      has_coverage_(std::ranges::any_of(film.aovs, is_coverage)),
      has_light_(std::ranges::count(film.aovs, AovOrigin::Light, &AovPlane::origin) > 0) {}

void TilePlanes::begin(const PixelSet& pixels) {
    if (film_.aovs.empty()) return;
    std::fill_n(m_.hit.begin(), pixels.count, 0u);
    for (size_t p = 0; p < film_.aovs.size(); ++p)
        std::fill_n(m_.sums[p].begin(), pixels.count, first_value(film_.aovs[p]));
    for (auto& of_plane : m_.covered) of_plane.clear();
    if (has_nearest_) find_nearest(pixels);
    if (!has_variance_) return;
    std::fill_n(m_.mean.begin(), 3 * pixels.count, 0.0);
    std::fill_n(m_.squares.begin(), 3 * pixels.count, 0.0);
    std::fill_n(m_.counted.begin(), pixels.count, 0u);
}

// Where a sample lies, pixels from its pixel's centre: as the rays do.
dvec2 TilePlanes::offset_of(uint32_t sample, uint32_t x, uint32_t y) const {
    const dvec2 u = stratified_sample(sample, hash(x, y, settings_.seed));
    if (settings_.filter_grid)
        return settings_.filter_grid->offset(int(sample), settings_.samples_per_pixel, u);
    return {along_axis(*filter_, u.x), along_axis(*filter_, u.y)};
}

// Of samples equally near the first one counts.
void TilePlanes::find_nearest(const PixelSet& pixels) {
    std::fill_n(m_.nearest.begin(), pixels.count, 0u);
    if (settings_.samples_per_pixel == 1) return;
    for (size_t p = 0; p < pixels.count; ++p) {
        double least = kInfinity;
        for (uint32_t s = 0; s < uint32_t(settings_.samples_per_pixel); ++s) {
            const dvec2 offset = offset_of(s, pixels.x0 + pixels.x[p], pixels.y0 + pixels.y[p]);
            const double square = glm::dot(offset, offset);
            if (square >= least) continue;
            least = square;
            m_.nearest[p] = s;
        }
    }
}

void TilePlanes::keep(const Hit& hit, std::span<float* const> shaded) {
    ++m_.hit[hit.pixel];
    for (size_t p = 0; p < film_.aovs.size(); ++p) {
        if (film_.aovs[p].origin != AovOrigin::Surface) continue;
        double& kept = m_.sums[p][hit.pixel];
        const double value = double(shaded[p][hit.at]);
        switch (film_.aovs[p].filter) {
            case AovFilter::Mean:
                kept += 1.0 / settings_.samples_per_pixel * value * hit.weight;
                break;
            case AovFilter::Average:
                kept += value;
                break;
            case AovFilter::Nearest:
                if (hit.sample == m_.nearest[hit.pixel]) kept = value;
                break;
            case AovFilter::Least:
                kept = std::min(kept, value);
                break;
            case AovFilter::Most:
                kept = std::max(kept, value);
                break;
        }
    }
}

void TilePlanes::lay(const Hit& hit, const float through[3], std::span<float* const> shaded) {
    for (size_t p = 0; p < film_.aovs.size(); ++p)
        if (film_.aovs[p].origin == AovOrigin::Light)
            m_.sums[p][hit.pixel] += double(through[film_.aovs[p].component]) *
                                     double(shaded[p][hit.at]) * hit.weight /
                                     settings_.samples_per_pixel;
}

void TilePlanes::cover(const Hit& hit, double part, std::span<float* const> shaded) {
    if (part == 0) return;
    for (size_t p = 0; p < film_.aovs.size(); ++p)
        if (is_coverage(film_.aovs[p]) && film_.aovs[p].component == 0)
            m_.covered[p].push_back({uint32_t(hit.pixel), shaded[p][hit.at],
                                     part * hit.weight / settings_.samples_per_pixel});
}

void TilePlanes::finish() {
    for (size_t p = 0; p < film_.aovs.size(); ++p)
        if (is_coverage(film_.aovs[p]) && film_.aovs[p].component == 0) rank(p);
}

// The ids that cover most of each pixel, in the order of what they cover: an id and its part.
void TilePlanes::rank(size_t first_plane) {
    constexpr size_t kRanks = 6;
    using Covered = PlaneMemory::Covered;
    std::vector<Covered>& all = m_.covered[first_plane];
    std::ranges::stable_sort(all, {}, [](const Covered& c) { return std::pair(c.pixel, c.id); });
    for (size_t first = 0, end; first < all.size(); first = end) {
        end = first;
        size_t ids = first;  // of the pixel, kept in place
        for (; end < all.size() && all[end].pixel == all[first].pixel; ++end) {
            if (end > first && all[end].id == all[ids].id)
                all[ids].part += all[end].part;
            else if (end > first)
                all[++ids] = all[end];
        }
        const std::span<Covered> found(&all[first], ids + 1 - first);
        std::ranges::stable_sort(found, std::greater<>(), &Covered::part);
        for (size_t r = 0; r < std::min(kRanks, found.size()) && found[r].part > 0; ++r) {
            m_.sums[first_plane + 2 * r][found[r].pixel] = double(found[r].id);
            m_.sums[first_plane + 2 * r + 1][found[r].pixel] = found[r].part;
        }
    }
}

void TilePlanes::count(size_t pixel, const vec3& color) {
    const double n = ++m_.counted[pixel];
    for (int c = 0; c < 3; ++c) {
        double& mean = m_.mean[3 * pixel + size_t(c)];
        const double before = double(color[c]) - mean;
        mean += before / n;
        m_.squares[3 * pixel + size_t(c)] += before * (double(color[c]) - mean);
    }
}

float TilePlanes::variance(size_t pixel, int component) const {
    const uint32_t n = m_.counted[pixel];
    return n < 2 ? 0.0f : float(m_.squares[3 * pixel + size_t(component)] / (n - 1));
}

float TilePlanes::value(size_t plane, size_t pixel) const {
    const AovPlane& of = film_.aovs[plane];
    switch (of.origin) {
        case AovOrigin::Surface:
        case AovOrigin::Light:
        case AovOrigin::Coverage:
            break;
        case AovOrigin::Samples:
            return float(settings_.samples_per_pixel);
        case AovOrigin::Variance:
            return variance(pixel, of.component);
        case AovOrigin::Other:
            return 0;
    }
    const bool over_hits = of.filter != AovFilter::Mean && of.filter != AovFilter::Nearest;
    if (over_hits && m_.hit[pixel] == 0) return of.background;
    const double kept = m_.sums[plane][pixel];
    return float(of.filter == AovFilter::Average ? kept / m_.hit[pixel] : kept);
}

}  // namespace kinora::raytrace
