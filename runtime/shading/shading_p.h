// runtime/shading/shading_p.h: what the parts of Shading share; for shading*.cpp,
// light_records.cpp, transmission.cpp and services.cpp only.
#pragma once

#include <algorithm>

#include "raytrace/sampling.h"
#include "runtime/images/point_file.h"
#include "runtime/scene/scene.h"
#include "runtime/shading/shading.h"

namespace kinora {

// A point of bake3d: P, N, radius, then its channels' numbers.
struct BakedPoint {
    int32_t file = 0, channels = 0;  // interned
    uint32_t pixel_y = 0, pixel_x = 0, layer = 0, order = 0;
    float numbers[kPointHead + rsl::kPointFloats];
};

// The records of one gather statement at one depth; kept from frame to frame.
struct Shading::GatherMemory {
    std::vector<float> values;
    std::vector<const float*> columns;
    std::vector<jit::Record> records;
};

// What a ray saw.
struct Shading::Seen {
    vec3 color{0.0f};
    vec3 open{1.0f};         // share of what lies behind that is let through
    float distance = 1e30f;  // of the nearest surface
};

inline constexpr size_t kRecordSets = 256;  // handles a grid may hold at once
inline constexpr size_t kGatherSets = kRecordSets - rsl::kGatherLevels;  // the last ones

// One thread's memory. Nested shading (reflections, opacity of shadow rays) takes its rays and hits
// by depth, so that an outer wavefront is never overwritten.
struct Shading::Thread {
    Arena arena{1 << 20};
    ShadingCounters counters;
    std::vector<std::vector<uint8_t>> faults;  // per look and kernel: one byte a site
    struct Level {
        raytrace::RayBatch rays;
        raytrace::HitStore hits;
    };
    struct Print {
        uint32_t pixel_y, pixel_x, sample, order;
        std::string text;
    };
    std::vector<Print> prints;
    std::vector<BakedPoint> bakes;
    std::vector<std::unique_ptr<Level>> levels;
    size_t level = 0;                     // levels in use
    RayTag ray;                           // of the hits that shade() is given
    const HitOutputs* outputs = nullptr;  // wanted of those beside Ci and Oi
    std::vector<std::unique_ptr<GatherMemory>> gathers;
    GatherMemory& gather_memory(uint32_t depth, int nesting) {
        size_t index = size_t(depth) * rsl::kGatherLevels + size_t(nesting);
        while (gathers.size() <= index) gathers.push_back(std::make_unique<GatherMemory>());
        return *gathers[index];
    }
};

// What gather wants of each hit: columns of all components, in the order of the results.
struct Shading::HitOutputs {
    std::span<const rsl::LoweredShader::GatherResult> wanted;
    std::span<float* const> columns;  // by hit
};

// Takes the next level of nested wavefronts for its scope.
class NestedWavefront {
  public:
    explicit NestedWavefront(Shading::Thread& thread) : thread_(thread) {
        if (thread.level == thread.levels.size())
            thread.levels.push_back(std::make_unique<Shading::Thread::Level>());
        level_ = thread.levels[thread.level++].get();
    }
    ~NestedWavefront() { --thread_.level; }
    NestedWavefront(const NestedWavefront&) = delete;
    Shading::Thread::Level* operator->() { return level_; }

  private:
    Shading::Thread& thread_;
    Shading::Thread::Level* level_;
};

// Where light is wanted: points in current space, and in accel space with their error bounds.
struct Shading::LightPoints {
    size_t count = 0;
    const float* P[3];
    const float* N[3];
    const float* accel[3];
    const float* error[3];
    const float* Ng[3];  // accel space
    const float* rng = nullptr;
    const uint32_t* surface = nullptr;  // the surface that is lit, kNone: none
    size_t first = 0;  // grid point of element 0: what record columns are relative to
};

// A light on geometry: its triangles by area.
struct Shading::AreaLight {
    uint32_t surface = kNone;
    uint32_t samples = 1;
    std::vector<float> below;  // area of the triangles up to each, summed
    bool known = false;
};

// One sample of an area light for each of a number of lit points.
struct Shading::LightSamples {
    raytrace::HitBatch hits;
    std::span<uint32_t> instance, primitive;
    float *u, *v;
    raytrace::Accel::SurfacePoints place;
};

// The share of light that something of opacity Oi stops, as the camera has it; NaN stays NaN.
inline vec3 stopped_by(vec3 Oi) {
    for (int k = 0; k < 3; ++k) Oi[k] = std::clamp(Oi[k], 0.0f, 1.0f);
    return Oi;
}

inline vec3 triple(const float* const columns[3], size_t i) {
    return {columns[0][i], columns[1][i], columns[2][i]};
}
inline void set_triple(float* const columns[3], size_t i, vec3 value) {
    columns[0][i] = value.x;
    columns[1][i] = value.y;
    columns[2][i] = value.z;
}

// A hit's random number (docs/decisions.md#random-numbers-without-state).
inline uint32_t random_of(const raytrace::HitBatch& hits, size_t h) {
    uint32_t pixel = raytrace::hash(hits.pixel_x[h], hits.pixel_y[h]);
    uint32_t layer = hits.layer[h] % 64 + 64 * hits.depth + (hits.layer[h] / 64 << 16);
    return raytrace::hash(pixel, hits.sample[h], layer);
}

// The way of a hit's ray since its last surface, or since it began; accel space.
inline vec3 segment(const raytrace::HitBatch& hits, size_t h) {
    float passed = hits.rays ? hits.rays->t_passed[hits.ray[h]] : 0.0f;
    if (passed == 0) return triple(hits.P, h) - triple(hits.org, h);
    return triple(hits.dir, h) * (hits.t[h] - passed);
}

// Sets one ray of a packet or batch; both have the same columns.
template <class Rays>
void set_ray(Rays& rays, size_t i, vec3 org, vec3 dir, float tfar) {
    set_triple(rays.org, i, org);
    set_triple(rays.dir, i, dir);
    rays.tnear[i] = 0;
    rays.tfar[i] = tfar;
    rays.time[i] = 0;
}

// The three outputs "name.r" ... of a kernel, null where it has none.
void find_color(const jit::Kernel& kernel, std::span<float* const> out, std::string_view name,
                float* color[3]);

// A nested ray without footprint of its own.
void set_nested_ray(raytrace::RayBatch& rays, size_t i, vec3 org, vec3 dir, float tfar,
                    const raytrace::HitBatch& from, uint32_t hit);

}  // namespace kinora
