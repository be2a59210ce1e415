// runtime/picture/shading/volumes.cpp: volume shaders, run on the way of each ray between two
// surfaces.
//
// The kernels run after the surface at the far end of the way, on its Ci and Oi
// (docs/decisions.md#joined-layers): P is that end, I leads there from the last surface (or the
// eye), so that layers seen through each other are fogged once each and add up front to back like
// one way. Which volume it is follows from the side of the surface that the ray meets: from outside
// (dir . Ng < 0) its exterior, from inside its interior; a surface that has none leaves the ray in
// what it had entered (runtime/scene/medium.h), and that is at first the atmosphere: for camera
// rays to a surface with one of its own, that. This is right
// for closed meshes; a camera inside an object sees its interior on what encloses it, not on other
// things within.
#include "runtime/picture/shading/volumes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "runtime/picture/shading/light_layers.h"
#include "runtime/scene/medium.h"

namespace kinora {

namespace {

uint32_t medium_before(const raytrace::HitBatch& hits, size_t k) {
    return hits.rays ? hits.rays->medium[hits.ray[k]] : 0;
}

bool from_outside(const raytrace::HitBatch& hits, size_t k) {
    return glm::dot(triple(hits.dir, k), triple(hits.Ng, k)) < 0;
}

// The look of the volume that hit k was seen through, kNone if none.
uint32_t volume_before(const ShadingFrame& frame, const raytrace::HitBatch& hits, const RayTag& ray,
                       size_t k) {
    uint32_t within = innermost(medium_before(hits, k));
    uint32_t around = within ? frame.shaders.volumes[within - 1] : frame.shaders.atmosphere;
    uint32_t row = hits.instance[k];
    if (row == kNone) {  // nothing was met: an object that was never left has a hole
        bool inside =
            around != kNone && within && !frame.shaders.shader_instances[around]->exterior;
        return inside ? frame.shaders.atmosphere : around;
    }
    const Surface& surface = frame.shapes.surfaces[row];
    uint32_t own = from_outside(hits, k) ? surface.exterior : surface.interior;
    if (own != kNone) return own;
    const bool from_eye = !within && ray.type == RayType::Camera;
    return from_eye && surface.atmosphere != kNone ? surface.atmosphere : around;
}

}  // namespace

uint32_t medium_behind(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k) {
    uint32_t medium = medium_before(hits, k);
    if (frame.shaders.volumes.empty()) return medium;
    const Surface& surface = frame.shapes.surfaces[hits.instance[k]];
    uint32_t left = surface.exterior, entered = surface.interior;
    if (!from_outside(hits, k)) std::swap(left, entered);
    if (left != kNone) medium = leave_volume(medium, frame.shaders.shader_instances[left]->volume);
    if (entered != kNone)
        medium = enter_volume(medium, frame.shaders.shader_instances[entered]->volume);
    return medium;
}

uint32_t nested_medium(const ShadingFrame& frame, const raytrace::HitBatch& hits, size_t k,
                       vec3 dir) {
    if (hits.instance[k] == kNone) return medium_before(hits, k);
    vec3 Ng = triple(hits.Ng, k);
    bool through = glm::dot(triple(hits.dir, k), Ng) * glm::dot(dir, Ng) > 0;
    return through ? medium_behind(frame, hits, k) : medium_before(hits, k);
}

// Hits in the order of the volumes before them, and where those of each begin.
struct Volumes::Order {
    std::span<uint32_t> points;  // hits that were seen through a volume
    std::span<uint32_t> begin;   // by look; one more than there are
};

Volumes::Order Volumes::sort(const raytrace::HitBatch& hits, const RayTag& ray, Arena& arena,
                             bool fills_only) const {
    const SceneShaders& shaders = frame_.shaders;
    size_t looks = shaders.shader_instances.size();
    std::span<uint32_t> volume = arena.allocate_span<uint32_t>(hits.count);
    Order order;
    order.begin = arena.allocate_span<uint32_t>(looks + 1);
    std::fill(order.begin.begin(), order.begin.end(), 0u);
    for (size_t k = 0; k < hits.count; ++k) {
        volume[k] = volume_before(frame_, hits, ray, k);
        // A shadow ray that meets nothing has reached its light, perhaps within an object.
        uint32_t within = innermost(medium_before(hits, k));
        if (fills_only && hits.instance[k] == kNone && within &&
            std::isfinite(hits.rays->tfar[hits.ray[k]]))
            volume[k] = shaders.volumes[within - 1];
        if (fills_only && volume[k] != kNone && !shaders.shader_instances[volume[k]]->opacity)
            volume[k] = kNone;
        if (volume[k] != kNone) ++order.begin[volume[k] + 1];
    }
    for (size_t l = 0; l < looks; ++l) order.begin[l + 1] += order.begin[l];
    order.points = arena.allocate_span<uint32_t>(order.begin[looks]);
    std::span<uint32_t> next = arena.allocate_span<uint32_t>(looks);
    std::copy_n(order.begin.begin(), looks, next.begin());
    for (uint32_t k = 0; k < hits.count; ++k)
        if (volume[k] != kNone) order.points[next[volume[k]]++] = k;
    return order;
}

// Calls f(look, grid's hits) for dense parts of the hits of each volume.
template <class F>
void Volumes::for_each_grid(const Order& order, F&& f) const {
    for (size_t l = 0; l + 1 < order.begin.size(); ++l)
        for (size_t at = order.begin[l]; at < order.begin[l + 1]; at += kGridPoints)
            f(*frame_.shaders.shader_instances[l],
              order.points.subspan(at, std::min(kGridPoints, order.begin[l + 1] - at)));
}

void Volumes::shade(Grid& grid, const BoundKernel& bound, const RayTag& ray, LightShadows* shadows,
                    raytrace::ShadeResult& result) {
    std::span<const uint32_t> points = grid.points;
    Arena::Mark mark = grid.memory.arena.mark();
    kernels_.prepare(grid, ray);
    grid.shadows = shadows;
    want_columns(grid, bound.columns);
    if (grid.look->lowered.uses_lights) lights_.want_columns(grid);
    gather(grid);
    auto load = [&](uint16_t column, float* const from[3]) {
        for (size_t k = 0; k < 3; ++k)
            if (float* to = grid.columns[column + k])
                for (size_t i = 0; i < padded(points.size()); ++i)
                    to[i] = from[k][points[std::min(i, points.size() - 1)]];
    };
    load(kColCi, result.Ci);
    load(kColOi, result.Oi);
    if (grid.look->lowered.uses_lights) lights_.run(grid);
    const bool layered = shadows && start_tape(grid, result);
    std::span<float*> out = kernels_.run(bound, grid);
    if (layered) pass_light_layers(grid, bound, kernels_, result);
    auto store = [&](rsl::Global id, float* const to[3]) {
        float* from[3];
        find_color(bound.kernel(), out, id, from);
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 0; from[k] && i < points.size(); ++i) to[k][points[i]] = from[k][i];
    };
    store(rsl::Global::Ci, result.Ci);
    store(rsl::Global::Oi, result.Oi);
    grid.memory.arena.release(mark);
}

void Volumes::apply(const raytrace::HitBatch& hits, const RayTag& ray, LightShadows& shadows,
                    ThreadMemory& memory, raytrace::ShadeResult& result) {
    const SceneShaders& shaders = frame_.shaders;
    if (shaders.atmosphere == kNone && shaders.volumes.empty() && !shaders.own_atmospheres) return;
    Arena::Mark mark = memory.arena.mark();
    for_each_grid(sort(hits, ray, memory.arena, false),
                  [&](const ShaderInstance& look, std::span<const uint32_t> points) {
                      Grid grid(frame_, memory, hits, points, &look);
                      shade(grid, look.full, ray, &shadows, result);
                      memory.counters.points += points.size();
                  });
    memory.arena.release(mark);
}

void Volumes::pass(const raytrace::HitBatch& hits, const RayTag& ray, ThreadMemory& memory,
                   vec3* Oi) {
    Arena::Mark mark = memory.arena.mark();
    Order order = sort(hits, ray, memory.arena, true);
    raytrace::ShadeResult result = take_colors(memory.arena, hits.count);
    for (size_t k = 0; k < 3; ++k) {
        std::fill_n(result.Ci[k], padded(hits.count), 0.0f);
        std::fill_n(result.Oi[k], padded(hits.count), 0.0f);
    }
    for_each_grid(order, [&](const ShaderInstance& look, std::span<const uint32_t> points) {
        Grid grid(frame_, memory, hits, points, &look);
        shade(grid, *look.opacity, ray, nullptr, result);
        memory.counters.opacity_points += points.size();
    });
    for (uint32_t h : order.points)
        Oi[h] = vec3(1.0f) - (vec3(1.0f) - Oi[h]) * (vec3(1.0f) - stopped_by(triple(result.Oi, h)));
    memory.arena.release(mark);
}

}  // namespace kinora
