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
constexpr size_t kChunk = 4096;  // vertices, triangles or edges looked at by one task

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

bool all_in_range(std::span<const vec4> positions, float largest) {
    const float4 most = {largest, largest, largest, largest};
    int4 good = {-1, -1, -1, -1};
    for (const vec4& position : positions) {
        const float4 p = load(position);
        good &= (p <= most) & (p >= -most);
    }
    return (good[0] & good[1] & good[2]) != 0;
}

// A mesh, and where one looks in it.
struct Looks {
    std::span<const vec4> positions;
    std::span<const uint32_t> triangles, edges;
    Range range;

    // Pairs of triangles where edges are shared, else triangles.
    size_t count() const { return edges.empty() ? triangles.size() / 3 : edges.size() / 2; }
    bool all_traceable(size_t first, size_t last) const;
    bool all_edges_have_extent(size_t first, size_t last) const;
    bool all_triangles_have_extent(size_t first, size_t last) const;
    bool is_sound() const;
};

bool Looks::all_traceable(size_t first, size_t last) const {
    for (size_t i = first; i < last; ++i) {
        const uint32_t* corner = &triangles[3 * i];
        if (!is_traceable(positions[corner[0]], positions[corner[1]], positions[corner[2]], range))
            return false;
    }
    return true;
}

// One coordinate apart is enough, nearly always so of all edges.
bool Looks::all_edges_have_extent(size_t first, size_t last) const {
    auto is_short = [&](size_t i) {
        const float apart = positions[edges[2 * i]].x - positions[edges[2 * i + 1]].x;
        return !(std::abs(apart) > range.least_extent);
    };
    int any_short = 0;
    for (size_t i = first; i < last; ++i) any_short |= is_short(i);
    if (!any_short) return true;
    for (size_t i = first; i < last; ++i)
        if (is_short(i) && !all_traceable(2 * i, std::min(2 * i + 2, triangles.size() / 3)))
            return false;
    return true;
}

// As much, of the first two corners.
bool Looks::all_triangles_have_extent(size_t first, size_t last) const {
    for (size_t i = first; i < last; ++i) {
        const vec4 &a = positions[triangles[3 * i]], &b = positions[triangles[3 * i + 1]];
        if (std::abs(a.x - b.x) > range.least_extent) continue;
        if (!all_traceable(i, i + 1)) return false;
    }
    return true;
}

// Whether all vertices are in range and all triangles have an extent. Looks at both in turns, since
// triangles have vertices of about their own place in the mesh, which are in the cache then.
bool Looks::is_sound() const {
    const size_t vertices = positions.size();
    const size_t chunks = (std::max(count(), vertices) + kChunk - 1) / kChunk;
    std::atomic<bool> sound{true};
    parallel_for(0, chunks, 1, [&](size_t begin, size_t end) {
        for (size_t chunk = begin; chunk < end && sound.load(std::memory_order_relaxed); ++chunk) {
            const size_t from = vertices * chunk / chunks, to = vertices * (chunk + 1) / chunks;
            const size_t first = count() * chunk / chunks, last = count() * (chunk + 1) / chunks;
            if (!all_in_range(positions.subspan(from, to - from), range.largest) ||
                !(edges.empty() ? all_triangles_have_extent(first, last)
                                : all_edges_have_extent(first, last)))
                sound.store(false, std::memory_order_relaxed);
        }
    });
    return sound;
}

}  // namespace

bool is_traceable(const vec4& a, const vec4& b, const vec4& c, float scale) {
    return is_traceable(a, b, c, Range(scale));
}

std::vector<uint32_t> shared_edges(std::span<const uint32_t> triangles) {
    const size_t count = triangles.size() / 3;
    std::vector<uint32_t> edges;
    edges.reserve(count + 1);
    size_t shared = 0;
    for (size_t i = 0; i < count; i += 2) {
        const uint32_t* corner = &triangles[3 * i];
        const std::span<const uint32_t> next = triangles.subspan(3 * i + 3, i + 1 < count ? 3 : 0);
        auto has = [&](int k) { return std::ranges::count(next, corner[k]) > 0; };
        const int a = has(0) ? 0 : 1, b = has(2) ? 2 : 1;
        const bool both = a != b && has(a) && has(b);
        edges.insert(edges.end(), {corner[a], corner[both ? b : a]});
        shared += both;
    }
    if (shared * 4 < count) edges.clear();  // less than half of the pairs
    return edges;
}

std::vector<uint32_t> without_untraceable(std::span<const vec4> positions,
                                          std::span<const uint32_t> triangles, float scale,
                                          std::span<const uint32_t> edges) {
    const Range range(scale);
    if (Looks{positions, triangles, edges, range}.is_sound()) return {};
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
