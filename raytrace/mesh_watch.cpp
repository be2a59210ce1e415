// raytrace/mesh_watch.cpp: index checks and the summed areas of triangle boxes.
#include "raytrace/mesh_watch_p.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/base/parallel.h"

namespace kinora::raytrace {

namespace {

typedef float float4 __attribute__((vector_size(16)));  // GCC and Clang, on every CPU
typedef int int4 __attribute__((vector_size(16)));

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

struct Box {
    float4 a, b, c, low, high;
};

Box box_of(const vec4* positions, const uint32_t* corner) {
    const float4 a = load(positions[corner[0]]), b = load(positions[corner[1]]),
                 c = load(positions[corner[2]]);
    return {a, b, c, min4(min4(a, b), c), max4(max4(a, b), c)};
}

// The triangles that are looked at: each `stride`-th.
struct Samples {
    const vec4* positions;
    const uint32_t* triangles;
    size_t stride;
    float largest;

    Box box(size_t look) const { return box_of(positions, &triangles[3 * look * stride]); }
};

void add_triangle(const Box& box, float largest, BoxAreas& areas) {
    // A NaN may be lost by min and max but not by the sum.
    float4 e = (box.high - box.low) + 0.0f * (box.a + box.b + box.c);
    float4 far = max4(box.high, -box.low);
    float area = e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
    bool near = (far[0] <= largest) & (far[1] <= largest) & (far[2] <= largest);
    if (near & (area >= 0))
        areas.sum += double(area);
    else
        ++areas.bad_triangles;
}

constexpr size_t kSummedBoxes = 16;  // areas whose sum is a finite float where no triangle is bad

// False, and nothing added, where one of the block's triangles is bad.
bool add_block(const Samples& samples, size_t first, BoxAreas& areas) {
    const float l = samples.largest;
    const float4 most = {l, l, l, l};
    float4 sum = {0, 0, 0, 0};
    int4 good = {-1, -1, -1, -1};
    for (size_t look = first; look < first + kSummedBoxes; ++look) {
        const Box box = samples.box(look);
        good &= (box.a <= most) & (box.b <= most) & (box.c <= most) & (box.low >= -most);
        const float4 e = box.high - box.low;
        sum += e * float4{e[1], e[2], e[0], 0};
    }
    if ((good[0] & good[1] & good[2]) == 0) return false;
    areas.sum += double(sum[0]) + double(sum[1]) + double(sum[2]);
    return true;
}

BoxAreas areas_of(const Samples& samples, size_t first, size_t end) {
    BoxAreas areas;
    for (; first < end; first += kSummedBoxes) {
        const size_t last = std::min(end, first + kSummedBoxes);
        if (last - first == kSummedBoxes && add_block(samples, first, areas)) continue;
        for (size_t look = first; look < last; ++look)
            add_triangle(samples.box(look), samples.largest, areas);
    }
    return areas;
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
    const Samples samples{positions.data(), triangles.data(), stride, largest};
    partial.assign(chunks, {});
    parallel_for(0, chunks, 2, [&](size_t first, size_t last) {
        for (size_t chunk = first; chunk < last; ++chunk)
            partial[chunk] =
                areas_of(samples, chunk * kChunk, std::min(looks, (chunk + 1) * kChunk));
    });
    BoxAreas total;
    for (const BoxAreas& p : partial) {
        total.sum += p.sum;
        total.bad_triangles += p.bad_triangles;
    }
    return total;
}

}  // namespace kinora::raytrace
