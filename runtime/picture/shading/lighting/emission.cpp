// runtime/picture/shading/lighting/emission.cpp: kernels of surfaces without lights and rays. What
// rays see of a surface is less by the same numbers where its light counts already (lamps.cpp).
#include "runtime/picture/shading/lighting/emission.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "runtime/picture/lights/solid_angle.h"
#include "runtime/picture/shading/kernel_runner.h"

namespace kinora {

namespace {

constexpr float kOfMean = 0.1f;  // a triangle gets at least so much of the mean power

// Columns of a batch of hits that are filled here: each seen from its origin.
struct Seen {
    Seen(Arena& arena, size_t rows) {
        for (int k = 0; k < 3; ++k) {
            org[k] = arena.allocate_span<float>(rows).data();
            dir[k] = arena.allocate_span<float>(rows).data();
        }
        t = arena.allocate_span<float>(rows).data();
    }
    void set(size_t i, vec3 from, vec3 to) const {
        const vec3 way = to - from;
        const float length = glm::length(way);
        set_triple(org, i, from);
        set_triple(dir, i, length > 0 ? way / length : vec3(0, 0, 1));
        t[i] = length;
    }
    void lend(raytrace::HitBatch& hits) const {
        for (int k = 0; k < 3; ++k) {
            hits.org[k] = org[k];
            hits.dir[k] = dir[k];
        }
        hits.t = t;
    }
    float *org[3], *dir[3], *t;
};

// Of the hits of one look.
void run_look(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
              const RayTag& ray, const LookRun& run, const raytrace::HitBatch& hits,
              std::span<vec3> emission) {
    Grid dark(frame, memory, hits, run.hits, run.look);
    kernels.prepare(dark, ray);
    want_columns(dark, run.look->full.columns);
    gather(dark);
    const std::span<float*> out = kernels.run_in_the_dark(dark);
    memory.counters.light_points += dark.count();
    float* Ci[3];
    find_color(run.look->full.kernel(), out, rsl::Global::Ci, Ci);
    for (size_t i = 0; i < dark.count(); ++i)
        for (int k = 0; k < 3; ++k) {
            const float shown = Ci[k] ? Ci[k][i] : 0.0f;
            emission[run.hits[i]][k] = std::isfinite(shown) ? std::max(shown, 0.0f) : 0.0f;
        }
}

void run_looks(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
               const RayTag& ray, const raytrace::HitBatch& hits, std::span<vec3> emission) {
    for (const LookRun& run : runs_by_look(frame, hits, memory.arena))
        run_look(frame, kernels, memory, ray, run, hits, emission);
}

// The emission of a part of the light's triangles at their middles, before their fronts.
struct Middles {
    Middles(const ShadingFrame& frame, Arena& arena, const AreaLight& light, uint32_t first,
            size_t count)
        : samples(arena, count, light.surfaces[0]) {
        uint32_t part = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t t = first + i;
            while (t >= light.first[part + 1]) ++part;
            samples.instance[i] = light.surfaces[part];
            samples.primitive[i] = t - light.first[part];
            samples.u[i] = samples.v[i] = 1.0f / 3;
        }
        samples.find_points(frame.pose.accel);
        const Seen seen(arena, padded(count));
        for (size_t i = 0; i < count; ++i) {
            const vec3 P = triple(samples.hits.P, i);
            seen.set(i, P + triple(samples.hits.Ng, i), P);
        }
        seen.lend(samples.hits);
    }
    LightSamples samples;
};

}  // namespace

float density_by_area(vec3 L, vec3 Ng, float area) {
    constexpr float kMost = 1e30f;
    const float square = glm::dot(L, L), across = std::abs(glm::dot(Ng, L)) * area;
    return across > 0 ? std::min(square * std::sqrt(square) / across, kMost) : kMost;
}

float share_of_samples(float density) {
    constexpr float kFew = 0.2f;
    const float ratio = 1 / (float(kPi) * density);  // of the rays' density to that of samples
    return ratio < kFew ? 1 : 1 / (1 + ratio * ratio);
}

float share_of_samples(const AreaLight& light, vec3 from, const raytrace::HitBatch& hits,
                       uint32_t hit) {
    if (light.by_angle && SolidAngle(light.shape, dvec3(from)).density() > 0) return 1;
    const float area = light.area_at(hits.instance[hit], hits.primitive[hit]);
    return share_of_samples(
        density_by_area(triple(hits.P, hit) - from, triple(hits.Ng, hit), area));
}

void find_emission(const ShadingFrame& frame, const KernelRunner& kernels, const Grid& lit,
                   const LightSamples& samples, const LightPoints& at, std::span<vec3> emission) {
    Arena& arena = lit.memory.arena;
    const Arena::Mark mark = arena.mark();
    const Seen seen(arena, padded(at.count));
    for (size_t i = 0; i < at.count; ++i)
        seen.set(i, triple(at.accel, i), triple(samples.hits.P, i));
    raytrace::HitBatch hits = samples.hits;
    seen.lend(hits);
    run_looks(frame, kernels, lit.memory, lit.ray, hits, emission);
    arena.release(mark);
}

void find_powers(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
                 const AreaLight& light, std::vector<float>& powers) {
    powers.resize(light.areas.size());
    for (size_t first = 0, count; first < powers.size(); first += count) {
        count = std::min(powers.size() - first, kGridPoints);
        const Arena::Mark mark = memory.arena.mark();
        const Middles middles(frame, memory.arena, light, uint32_t(first), count);
        std::span<vec3> emission = memory.arena.allocate_span<vec3>(count);
        run_looks(frame, kernels, memory, {}, middles.samples.hits, emission);
        for (size_t i = 0; i < count; ++i)
            powers[first + i] = std::max({emission[i].x, emission[i].y, emission[i].z});
        memory.arena.release(mark);
    }
    double sum = 0, area = 0;
    for (size_t t = 0; t < powers.size(); ++t) {
        sum += light.areas[t] * double(powers[t]);
        area += light.areas[t];
    }
    const float mean = float(sum / area);
    if (!(mean > 0) || std::ranges::all_of(powers, [&](float p) { return p == powers[0]; }))
        return powers.clear();
    for (float& power : powers) power = power / mean + kOfMean;
}

}  // namespace kinora
