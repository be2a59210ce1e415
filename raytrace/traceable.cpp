// raytrace/traceable.cpp: looks for triangles and boxes without extent.
#include "raytrace/traceable_p.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "raytrace/mesh_watch_p.h"
#include "runtime/base/parallel.h"

namespace kinora::raytrace {

namespace {

typedef float float4 __attribute__((vector_size(16)));  // GCC and Clang, on every CPU
typedef int int4 __attribute__((vector_size(16)));

// Embree flushes denormal numbers to 0, corners and differences alike. A difference of more than
// twice FLT_MIN stays one.
constexpr float kLeastExtent = 0x1p-124f;
constexpr size_t kChunk = 16384;  // vertices or triangles looked at by one task

float4 load(const vec4& p) {
    float4 v;
    std::memcpy(&v, &p, sizeof v);
    return v;
}

// What of the caller's numbers Embree takes at a scale.
struct Range {
    explicit Range(float scale)
        : largest(kLargest / std::max(scale, 1.0f)), least_extent(kLeastExtent / scale) {}
    float largest, least_extent;
};

bool longer(float4 extent, float least) {
    return (extent[0] > least) | (extent[1] > least) | (extent[2] > least);
}

float4 absolute(float4 v) {
    return v < 0 ? -v : v;
}

// False for NaN, too.
bool in_range(float4 p, float largest) {
    const float4 size = absolute(p);
    return (size[0] <= largest) & (size[1] <= largest) & (size[2] <= largest);
}

bool is_traceable(const vec4& a, const vec4& b, const vec4& c, const Range& range) {
    const float4 p = load(a), q = load(b), r = load(c);
    return in_range(p, range.largest) && in_range(q, range.largest) && in_range(r, range.largest) &&
           (longer(absolute(p - q), range.least_extent) ||
            longer(absolute(p - r), range.least_extent));
}

// Whether look(first, last) holds for all chunks of so many things.
template <class Look>
bool all_chunks(size_t count, const Look& look) {
    std::atomic<bool> all{true};
    parallel_for(0, (count + kChunk - 1) / kChunk, 1, [&](size_t first, size_t last) {
        if (!all.load(std::memory_order_relaxed)) return;
        if (!look(first * kChunk, std::min(count, last * kChunk)))
            all.store(false, std::memory_order_relaxed);
    });
    return all;
}

bool all_in_range(std::span<const vec4> positions, float largest) {
    return all_chunks(positions.size(), [&](size_t first, size_t last) {
        const float4 most = {largest, largest, largest, largest};
        int4 bad = {0, 0, 0, 0};
        for (size_t i = first; i < last; ++i) bad |= ~(absolute(load(positions[i])) <= most);
        return (bad[0] | bad[1] | bad[2]) == 0;
    });
}

// One coordinate apart is enough, nearly always so of the first two corners.
bool all_have_extent(std::span<const vec4> positions, std::span<const uint32_t> triangles,
                     const Range& range) {
    return all_chunks(triangles.size() / 3, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const uint32_t* corner = &triangles[3 * i];
            const vec4 &a = positions[corner[0]], &b = positions[corner[1]];
            if (std::abs(a.x - b.x) > range.least_extent) continue;
            if (!is_traceable(a, b, positions[corner[2]], range)) return false;
        }
        return true;
    });
}

}  // namespace

bool is_traceable(const vec4& a, const vec4& b, const vec4& c, float scale) {
    return is_traceable(a, b, c, Range(scale));
}

std::vector<uint32_t> without_untraceable(std::span<const vec4> positions,
                                          std::span<const uint32_t> triangles, float scale) {
    const Range range(scale);
    if (all_in_range(positions, range.largest) && all_have_extent(positions, triangles, range))
        return {};
    std::vector<uint32_t> kept(triangles.begin(), triangles.end());
    bool all = true;
    for (size_t i = 0; i + 2 < kept.size(); i += 3) {
        uint32_t* corner = &kept[i];
        if (is_traceable(positions[corner[0]], positions[corner[1]], positions[corner[2]], range))
            continue;
        std::fill_n(corner, 3, kNone);
        all = false;
    }
    if (all) kept.clear();  // a vertex that no triangle has is out of range
    return kept;
}

bool any_traceable(std::span<const uint32_t> triangles) {
    for (size_t i = 0; i + 2 < triangles.size(); i += 3)
        if (triangles[i] != kNone) return true;
    return false;
}

bool has_extent(vec3 low, vec3 high) {
    return high.x - low.x > kLeastExtent || high.y - low.y > kLeastExtent ||
           high.z - low.z > kLeastExtent;
}

bool surely_has_extent(const Placement& placement, vec3 low, vec3 high) {
    constexpr double kRoundings = 16 * 0x1p-24;  // more than a product with a matrix has
    for (int r = 0; r < 3; ++r) {
        double extent = 0, size = std::abs(double(placement.traced[9 + r]));
        for (int c = 0; c < 3; ++c) {
            const double m = std::abs(double(placement.traced[3 * c + r]));
            extent += m * (double(high[c]) - double(low[c]));
            size += m * std::max(std::abs(double(low[c])), std::abs(double(high[c])));
        }
        if (extent > kRoundings * size && extent > double(kLeastExtent)) return true;
    }
    return false;
}

}  // namespace kinora::raytrace
