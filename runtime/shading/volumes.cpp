// runtime/shading/volumes.cpp: volume shaders, run on the way of each ray between two surfaces.
//
// The kernels run after the surface at the far end of the way, on its Ci and Oi
// (docs/decisions.md#joined-layers): P is that end, I leads there from the last surface (or the
// eye), so that layers seen through each other are fogged once each and add up front to back like
// one way. Which volume it is follows from the side of the surface that the ray meets: from outside
// (dir . Ng < 0) its exterior, from inside its interior; a surface that has none leaves the ray in
// what it had entered (runtime/scene/medium.h), and that is at first the atmosphere. This is right
// for closed meshes; a camera inside an object sees its interior on what encloses it, not on other
// things within.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/medium.h"
#include "runtime/shading/shading_p.h"

namespace kinora {

namespace {

uint32_t medium_before(const raytrace::HitBatch& hits, size_t k) {
    return hits.rays ? hits.rays->medium[hits.ray[k]] : 0;
}

bool from_outside(const raytrace::HitBatch& hits, size_t k) {
    return glm::dot(triple(hits.dir, k), triple(hits.Ng, k)) < 0;
}

}  // namespace

// The look of the volume that hit k was seen through, kNone if none.
uint32_t Shading::volume_before(const raytrace::HitBatch& hits, size_t k) const {
    uint32_t within = innermost(medium_before(hits, k));
    uint32_t around = within ? scene_.volumes[within - 1] : scene_.atmosphere;
    uint32_t row = hits.instance[k];
    if (row == kNone) {  // nothing was met: an object that was never left has a hole
        bool inside = around != kNone && within && !scene_.looks[around]->exterior;
        return inside ? scene_.atmosphere : around;
    }
    const Surface& surface = scene_.surfaces[row];
    uint32_t own = from_outside(hits, k) ? surface.exterior : surface.interior;
    return own != kNone ? own : around;
}

uint32_t Shading::medium_behind(const raytrace::HitBatch& hits, size_t k) const {
    uint32_t medium = medium_before(hits, k);
    if (scene_.volumes.empty()) return medium;
    const Surface& surface = scene_.surfaces[hits.instance[k]];
    uint32_t left = surface.exterior, entered = surface.interior;
    if (!from_outside(hits, k)) std::swap(left, entered);
    if (left != kNone) medium = leave_volume(medium, scene_.looks[left]->volume);
    if (entered != kNone) medium = enter_volume(medium, scene_.looks[entered]->volume);
    return medium;
}

// Of a ray that a shader sends from hit k: through the surface, or back into where it came from.
uint32_t Shading::nested_medium(const raytrace::HitBatch& hits, size_t k, vec3 dir) const {
    if (hits.instance[k] == kNone) return medium_before(hits, k);
    vec3 Ng = triple(hits.Ng, k);
    bool through = glm::dot(triple(hits.dir, k), Ng) * glm::dot(dir, Ng) > 0;
    return through ? medium_behind(hits, k) : medium_before(hits, k);
}

float Shading::miss_distance() const {
    return scene_.atmosphere == kNone && !has_exteriors_ ? 0.0f : miss_distance_;
}

// Hits in the order of the volumes before them, and where those of each begin.
struct Shading::VolumeOrder {
    std::span<uint32_t> points;  // hits that were seen through a volume
    std::span<uint32_t> begin;   // by look; one more than there are
};

Shading::VolumeOrder Shading::sort_by_volume(const raytrace::HitBatch& hits, Arena& arena,
                                             bool fills_only) const {
    size_t looks = scene_.looks.size();
    std::span<uint32_t> volume = arena.allocate_span<uint32_t>(hits.count);
    VolumeOrder order;
    order.begin = arena.allocate_span<uint32_t>(looks + 1);
    std::fill(order.begin.begin(), order.begin.end(), 0u);
    for (size_t k = 0; k < hits.count; ++k) {
        volume[k] = volume_before(hits, k);
        // A shadow ray that meets nothing has reached its light, perhaps within an object.
        uint32_t within = innermost(medium_before(hits, k));
        if (fills_only && hits.instance[k] == kNone && within &&
            std::isfinite(hits.rays->tfar[hits.ray[k]]))
            volume[k] = scene_.volumes[within - 1];
        if (fills_only && volume[k] != kNone && !scene_.looks[volume[k]]->opacity)
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
void Shading::for_each_volume_grid(const VolumeOrder& order, F&& f) const {
    for (size_t l = 0; l + 1 < order.begin.size(); ++l)
        for (size_t at = order.begin[l]; at < order.begin[l + 1]; at += kGridPoints)
            f(*scene_.looks[l],
              order.points.subspan(at, std::min(kGridPoints, order.begin[l + 1] - at)));
}

void Shading::shade_volume(const raytrace::HitBatch& hits, std::span<const uint32_t> points,
                           const ShaderInstance& look, const BoundKernel& bound, int thread_id,
                           bool shadows, raytrace::ShadeResult& result) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    Grid grid(scene_, hits, points, &look);
    prepare_grid(grid, thread_id);
    grid.shadows = shadows;
    want_columns(grid, bound.columns);
    if (look.lowered.uses_lights) want_lights(grid);
    gather(grid);
    auto load = [&](uint16_t column, float* const from[3]) {
        for (size_t k = 0; k < 3; ++k)
            if (float* to = grid.columns[column + k])
                for (size_t i = 0; i < padded(points.size()); ++i)
                    to[i] = from[k][points[std::min(i, points.size() - 1)]];
    };
    load(kColCi, result.Ci);
    load(kColOi, result.Oi);
    if (look.lowered.uses_lights) run_lights(grid);
    std::span<float*> out = run_for_colors(bound, grid);
    auto store = [&](std::string_view name, float* const to[3]) {
        float* from[3];
        find_color(bound.kernel(), out, name, from);
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 0; from[k] && i < points.size(); ++i) to[k][points[i]] = from[k][i];
    };
    store("Ci", result.Ci);
    store("Oi", result.Oi);
    own.arena.release(mark);
}

void Shading::apply_volumes(const raytrace::HitBatch& hits, int thread_id,
                            raytrace::ShadeResult& result) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    for_each_volume_grid(sort_by_volume(hits, own.arena, false),
                         [&](const ShaderInstance& look, std::span<const uint32_t> points) {
                             shade_volume(hits, points, look, look.full, thread_id, true, result);
                             own.counters.points += points.size();
                         });
    own.arena.release(mark);
}

// Nothing lies there, so a volume begins with Ci and Oi of 0; without one they stay so.
void Shading::shade_misses(const raytrace::HitBatch& ends, int thread_id,
                           raytrace::ShadeResult& result) {
    std::optional<raytrace::DenormalGuard> flush;
    if (scene_.options.math == jit::math::Tier::Fast) flush.emplace();
    for (size_t k = 0; k < 3; ++k) {
        std::fill_n(result.Ci[k], ends.count, 0.0f);
        std::fill_n(result.Oi[k], ends.count, 0.0f);
    }
    apply_volumes(ends, thread_id, result);
}

// What the insides of objects take from shadow rays on the way to each hit; the atmosphere and
// exteriors take nothing, for a sun would never reach the ground through an endless fog.
void Shading::pass_volumes(const raytrace::HitBatch& hits, int thread_id, vec3* Oi) {
    Thread& own = thread(thread_id);
    Arena::Mark mark = own.arena.mark();
    VolumeOrder order = sort_by_volume(hits, own.arena, true);
    raytrace::ShadeResult result;
    for (size_t k = 0; k < 3; ++k) {
        result.Ci[k] = own.arena.allocate_span<float>(padded(hits.count)).data();
        result.Oi[k] = own.arena.allocate_span<float>(padded(hits.count)).data();
        std::fill_n(result.Ci[k], padded(hits.count), 0.0f);
        std::fill_n(result.Oi[k], padded(hits.count), 0.0f);
    }
    for_each_volume_grid(order, [&](const ShaderInstance& look, std::span<const uint32_t> points) {
        shade_volume(hits, points, look, *look.opacity, thread_id, false, result);
        own.counters.opacity_points += points.size();
    });
    for (uint32_t h : order.points)
        Oi[h] = vec3(1.0f) - (vec3(1.0f) - Oi[h]) * (vec3(1.0f) - stopped_by(triple(result.Oi, h)));
    own.arena.release(mark);
}

}  // namespace kinora
