// raytrace/mesh_watch.cpp: index checks and the summed areas of triangle boxes.
#include "raytrace/mesh_watch_p.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/base/parallel.h"

namespace kinora::raytrace {

namespace {

typedef float float4 __attribute__((vector_size(16)));  // GCC and Clang, on every CPU

constexpr size_t kChunk = 4096;           // triangles looked at per partial sum
constexpr size_t kSampleAllBelow = 8192;  // triangles
constexpr size_t kSampleStride = 4;       // beyond: this share of the refit budget is too much

float4 load(const vec4& p) {
    float4 v;
    std::memcpy(&v, &p, sizeof v);
    return v;
}

float4 min4(float4 a, float4 b) {
    return a < b ? a : b;
}
float4 max4(float4 a, float4 b) {
    return a > b ? a : b;
}

void add_triangle(const vec4* positions, const uint32_t* corner, float largest, BoxAreas& areas) {
    float4 a = load(positions[corner[0]]), b = load(positions[corner[1]]),
           c = load(positions[corner[2]]);
    float4 low = min4(min4(a, b), c), high = max4(max4(a, b), c);
    // A NaN may be lost by min and max but not by the sum.
    float4 e = (high - low) + 0.0f * (a + b + c);
    float4 far = max4(high, -low);
    float area = e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
    bool near = (far[0] <= largest) & (far[1] <= largest) & (far[2] <= largest);
    if (near & (area >= 0))
        areas.sum += double(area);
    else
        ++areas.bad_triangles;
}

}  // namespace

uint32_t count_bad_indices(size_t vertices, std::span<const uint32_t> triangles) {
    return uint32_t(std::count_if(triangles.begin(), triangles.end(),
                                  [&](uint32_t i) { return i >= vertices; }));
}

BoxAreas box_areas(std::span<const vec4> positions, std::span<const uint32_t> triangles,
                   float largest, std::vector<BoxAreas>& partial) {
    const size_t count = triangles.size() / 3;
    const size_t stride = count < kSampleAllBelow ? 1 : kSampleStride;
    const size_t looks = (count + stride - 1) / stride;
    const size_t chunks = (looks + kChunk - 1) / kChunk;
    partial.assign(chunks, {});
    parallel_for(0, chunks, 2, [&](size_t first, size_t last) {
        for (size_t chunk = first; chunk < last; ++chunk) {
            BoxAreas areas;
            size_t end = std::min(looks, (chunk + 1) * kChunk);
            for (size_t look = chunk * kChunk; look < end; ++look)
                add_triangle(positions.data(), &triangles[3 * look * stride], largest, areas);
            partial[chunk] = areas;
        }
    });
    BoxAreas total;
    for (const BoxAreas& p : partial) {
        total.sum += p.sum;
        total.bad_triangles += p.bad_triangles;
    }
    return total;
}

}  // namespace kinora::raytrace
