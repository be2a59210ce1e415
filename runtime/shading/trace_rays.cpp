// runtime/shading/trace_rays.cpp: the services trace, transmission, occlusion and indirectdiffuse:
// the samples of a lane group go in dense batches, each lane sums its own in their order, so that
// no result depends on its neighbours.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/sampling.h"
#include "runtime/images/texture.h"
#include "runtime/scene/scene.h"
#include "runtime/shading/hits_p.h"
#include "runtime/shading/nested_rays.h"
#include "runtime/shading/ray_services.h"
#include "runtime/shading/transmission.h"

namespace kinora {

namespace {

constexpr int kLanes = jit::kMaxLanes;

// Fills batches with the samples of all lanes and hands each full one to flush(first sample of the
// batch). add(lane, k) adds one ray with slot = its index in the batch.
template <class Count, class Add, class Flush>
void in_batches(const Lanes& lanes, raytrace::RayBatch& rays, Count&& count, Add&& add,
                Flush&& flush) {
    uint8_t lane_of[kGridPoints];
    uint32_t filled = 0;
    rays.reserve(kGridPoints);
    rays.count = 0;
    auto empty = [&] {
        if (filled > 0) flush(std::span<const uint8_t>(lane_of, filled));
        rays.count = 0;
        filled = 0;
    };
    for (int lane = 0; lane < kLanes; ++lane) {
        if (!lanes.asks(lane)) continue;
        int n = count(lane);
        for (int k = 0; k < n; ++k) {
            lane_of[filled] = uint8_t(lane);
            add(lane, uint32_t(k), filled);
            if (++filled == kGridPoints) empty();
        }
    }
    empty();
}

bool has_direction(vec3 d) {
    float length = glm::length(d);
    return length > 0 && length < kMiss;
}

// Each sample stands for its share of the hemisphere.
float sample_width(int samples) {
    return std::sqrt(2 * float(kPi) / float(samples));
}

// body(begin, end, map) for each run of rays of one lane that has a map.
template <class Body>
void for_each_map(const Lanes& lanes, int argument, std::span<const uint8_t> lane_of, Body&& body) {
    for (size_t begin = 0, end; begin < lane_of.size(); begin = end) {
        end = begin + 1;
        while (end < lane_of.size() && lane_of[end] == lane_of[begin]) ++end;
        if (int32_t map = lanes.integer(argument, lane_of[begin])) body(begin, end, map);
    }
}

// What occlusion and indirectdiffuse are asked: samples in a cone about N, denser along it.
enum ConeArgs { kP = 2, kN = 5, kSamples = 8, kAngle, kMaxdist, kBias, kMoreArgs };

class ConeRays {
  public:
    ConeRays(const Grid& grid, const Lanes& lanes, const mat3& accel_from_camera)
        : grid_(grid), lanes_(lanes), accel_from_camera_(accel_from_camera) {}

    int count(int lane) const {
        bool asks = grid_.shadows && has_direction(lanes_.triple(kN, lane));
        return asks ? lanes_.samples(kSamples, lane) : 0;
    }
    vec3 direction(int lane, uint32_t k) const {
        vec3 axis = accel_from_camera_ * lanes_.triple(kN, lane);
        return Cone(axis, lanes_.number(kAngle, lane), true).direction(k, lanes_.seed(lane));
    }
    void add(raytrace::RayBatch& rays, int lane, uint32_t k, uint32_t slot, vec3 dir,
             float share = 1) const {
        RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(kP, lane));
        add_ray(rays, grid_, start, dir, lanes_.number(kMaxdist, lane), lanes_.number(kBias, lane),
                raytrace::hash(lanes_.seed(lane), k), slot, share);
        spread_ray(rays, grid_.hits, start.hit);
    }

  private:
    const Grid& grid_;
    const Lanes& lanes_;
    mat3 accel_from_camera_;
};

// Of the nearest surface along each ray, kMiss without one.
void find_distances(const raytrace::Accel& accel, const raytrace::RayBatch& rays,
                    ThreadMemory& memory, std::span<float> out) {
    std::fill(out.begin(), out.end(), kMiss);
    NestedWavefront nested(memory);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& hits =
        raytrace::trace(accel, rays, raytrace::kMaskAll, 1, nested->hits, memory.counters.trace);
    for (size_t h = 0; h < hits.count; ++h) out[rays.slot[hits.ray[h]]] = hits.t[h];
}

}  // namespace

void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, float width,
                  vec3* light) {
    alignas(64) float args[13 * kLanes] = {}, results[4 * kLanes];
    for (size_t begin = 0; begin < directions.size(); begin += kLanes) {
        size_t count = std::min(directions.size() - begin, size_t(kLanes));
        for (size_t i = 0; i < count; ++i) {
            vec3 d = directions[begin + i];
            // Any two directions across d span the footprint.
            vec3 side = std::abs(d.x) > 0.5f ? vec3(-d.y, d.x, 0) : vec3(0, -d.z, d.y);
            side *= width / glm::length(side);
            vec3 up = glm::cross(d, side);
            args[i] = jit::float_of(map);
            for (int k = 0; k < 3; ++k) {
                args[(2 + k) * kLanes + int(i)] = d[k];
                args[(5 + k) * kLanes + int(i)] = side[k];
                args[(8 + k) * kLanes + int(i)] = up[k];
            }
        }
        lookup_environment({nullptr, args, results, (1u << count) - 1, 0, kLanes}, store);
        for (size_t i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k) light[begin + i][k] = results[k * kLanes + int(i)];
    }
}

void RayServices::trace(Grid& grid, const jit::ServiceCall& call) {
    enum { P = 2, R = 5, Maxdist = 8, Bias, Samples, Spread, Label };
    Lanes lanes(call);
    vec3 color[kLanes] = {};
    float distance[kLanes], share[kLanes] = {};
    std::fill_n(distance, kLanes, kMiss);
    if (grid.shadows && grid.depth < frame_.ray_depth && !frame_.stopped()) {
        ThreadMemory& memory = grid.memory;
        Arena::Mark mark = memory.arena.mark();
        std::span<SeenByRay> seen = memory.arena.allocate_span<SeenByRay>(kGridPoints);
        mat3 accel_from_camera = glm::transpose(frame_.camera_from_accel);
        NestedWavefront nested(memory);
        lanes.for_each_text(Label, [&](const Lanes& alike) {
            in_batches(
                alike, nested->rays,
                [&](int lane) {
                    if (!has_direction(lanes.triple(R, lane))) return 0;
                    int n = lanes.number(Spread, lane) > 0 ? lanes.samples(Samples, lane) : 1;
                    share[lane] = ray_share(grid, lanes.point(lane), n);
                    return share[lane] > 0 ? n : 0;
                },
                [&](int lane, uint32_t k, uint32_t slot) {
                    uint32_t seed = lanes.seed(lane);
                    vec3 dir = glm::normalize(accel_from_camera * lanes.triple(R, lane));
                    if (float spread = lanes.number(Spread, lane); spread > 0)
                        dir = Cone(dir, spread, false).direction(k, seed);
                    RayStart start = ray_start(grid, lanes.point(lane), lanes.triple(P, lane));
                    add_ray(nested->rays, grid, start, dir, lanes.number(Maxdist, lane),
                            lanes.number(Bias, lane), raytrace::hash(seed, k), slot, share[lane]);
                    spread_ray(nested->rays, grid.hits, start.hit);
                },
                [&](std::span<const uint8_t> lane_of) {
                    RayTag tag = deeper(grid, RayKind::Specular, lanes.integer(Label, lane_of[0]));
                    nested_.see(nested->rays, grid.depth + 1, tag, memory, seen);
                    for (size_t i = 0; i < lane_of.size(); ++i) {
                        color[lane_of[i]] += seen[i].color;
                        distance[lane_of[i]] = std::min(distance[lane_of[i]], seen[i].distance);
                    }
                });
        });
        memory.arena.release(mark);
    }
    for (int lane = 0; lane < kLanes; ++lane) {
        bool many = lanes.asks(lane) && lanes.number(Spread, lane) > 0;
        lanes.set(0, lane, many ? color[lane] / float(lanes.samples(Samples, lane)) : color[lane]);
        lanes.set(3, lane, distance[lane]);
    }
}

void RayServices::transmission(Grid& grid, const jit::ServiceCall& call) {
    enum { From = 2, To = 5, Samples = 8, Spread, Bias };
    Lanes lanes(call);
    vec3 sum[kLanes];
    auto count = [&](int lane) {
        return lanes.number(Spread, lane) > 0 ? lanes.samples(Samples, lane) : 1;
    };
    for (int lane = 0; lane < kLanes; ++lane) sum[lane] = vec3(0.0f);
    ThreadMemory& memory = grid.memory;
    Arena::Mark mark = memory.arena.mark();
    std::span<vec3> through = memory.arena.allocate_span<vec3>(kGridPoints);
    NestedWavefront nested(memory);
    auto open = [&](int lane) {  // nothing can lie between two points that are the same
        return !grid.shadows || frame_.stopped() ||
               !has_direction(lanes.triple(To, lane) - lanes.triple(From, lane));
    };
    in_batches(
        lanes, nested->rays, [&](int lane) { return open(lane) ? 0 : count(lane); },
        [&](int lane, uint32_t k, uint32_t slot) {
            // The end keeps clear of the surface it may lie on, as the beginning does.
            RayStart start = ray_start(grid, lanes.point(lane), lanes.triple(From, lane));
            RayStart end = ray_start(grid, lanes.point(lane), lanes.triple(To, lane));
            vec3 way = end.P - start.P;
            if (float spread = lanes.number(Spread, lane); spread > 0)
                way = Cone(way, spread, false).direction(k, lanes.seed(lane)) * glm::length(way);
            vec3 target = start.P + way;
            if (end.Ng != vec3(0.0f)) {
                target = raytrace::offset_ray_origin(target, end.error, end.Ng, -way);
            } else {
                float clear = 2 * std::max(end.error.x, std::max(end.error.y, end.error.z));
                target -= way * (clear / glm::length(way));
            }
            vec3 org = start.P;
            if (start.Ng != vec3(0.0f))
                org = raytrace::offset_ray_origin(org, start.error, start.Ng, way);
            vec3 dir = target - org;
            if (!has_direction(dir) || glm::dot(dir, way) <= 0) dir = way * 1e-6f;
            add_ray(nested->rays, grid, start, dir, 1.0f,
                    lanes.number(Bias, lane) / glm::length(dir),
                    raytrace::hash(lanes.seed(lane), k), slot);
        },
        [&](std::span<const uint8_t> lane_of) {
            transmission_.pass(nested->rays, grid.ray, memory, through.first(lane_of.size()));
            for (size_t i = 0; i < lane_of.size(); ++i) sum[lane_of[i]] += through[i];
        });
    memory.arena.release(mark);
    for (int lane = 0; lane < kLanes; ++lane)
        lanes.set(0, lane,
                  !lanes.asks(lane) || open(lane) ? vec3(1.0f) : sum[lane] / float(count(lane)));
}

void RayServices::occlusion(Grid& grid, const jit::ServiceCall& call) {
    enum { Falloff = kMoreArgs, Mode, Map };
    Lanes lanes(call);
    ThreadMemory& memory = grid.memory;
    float blocked[kLanes] = {};
    vec3 open[kLanes] = {}, sky[kLanes] = {};
    Arena::Mark mark = memory.arena.mark();
    std::span<vec3> through = memory.arena.allocate_span<vec3>(kGridPoints);
    std::span<vec3> dirs = memory.arena.allocate_span<vec3>(kGridPoints);
    std::span<vec3> light = memory.arena.allocate_span<vec3>(kGridPoints);
    NestedWavefront nested(memory);
    ConeRays cone(grid, lanes, glm::transpose(frame_.camera_from_accel));
    in_batches(
        lanes, nested->rays, [&](int lane) { return frame_.stopped() ? 0 : cone.count(lane); },
        [&](int lane, uint32_t k, uint32_t slot) {
            dirs[slot] = cone.direction(lane, k);
            cone.add(nested->rays, lane, k, slot, dirs[slot]);
        },
        [&](std::span<const uint8_t> lane_of) {
            bool by_distance = false;
            for (uint8_t lane : lane_of) by_distance |= lanes.number(Falloff, lane) > 0;
            std::span<float> weight =
                memory.arena.allocate_span<float>(by_distance ? kGridPoints : 0);
            if (by_distance) find_distances(frame_.scene.accel, nested->rays, memory, weight);
            transmission_.pass(nested->rays, grid.ray, memory, through.first(lane_of.size()));
            for (size_t i = 0; i < lane_of.size(); ++i) {
                int lane = lane_of[i];
                float hidden = 1 - (through[i].x + through[i].y + through[i].z) / 3;
                float falloff = lanes.number(Falloff, lane);
                // "falloffmode" 0: exponential, 1: a power of the share of maxdist left.
                float fade = 1;
                if (falloff > 0 && hidden > 0)
                    fade =
                        lanes.number(Mode, lane) > 0
                            ? std::pow(std::max(0.0f, 1 - weight[i] / lanes.number(kMaxdist, lane)),
                                       falloff)
                            : std::exp(-falloff * weight[i]);
                hidden *= fade;
                blocked[lane] += hidden;
                open[lane] += (1 - hidden) * dirs[i];
                if (falloff > 0 && hidden > 0)
                    through[i] = vec3(1.0f) - (vec3(1.0f) - through[i]) * fade;
            }
            for_each_map(lanes, Map, lane_of, [&](size_t begin, size_t end, int32_t map) {
                light_of_map(*frame_.scene.textures, map, dirs.subspan(begin, end - begin),
                             sample_width(cone.count(lane_of[begin])), light.data());
                for (size_t i = begin; i < end; ++i)
                    sky[lane_of[i]] += through[i] * light[i - begin];
            });
        });
    memory.arena.release(mark);
    for (int lane = 0; lane < kLanes; ++lane) {
        int n = lanes.asks(lane) ? cone.count(lane) : 0;
        lanes.set(0, lane, n ? blocked[lane] / float(n) : 0.0f);
        float length = glm::length(open[lane]);
        vec3 mean = length > 0 ? frame_.camera_from_accel * open[lane] / length : vec3(0.0f);
        lanes.set(1, lane, n ? mean : lanes.triple(kN, lane));
        lanes.set(4, lane, n ? sky[lane] / float(n) : vec3(0.0f));
    }
}

void RayServices::indirect_diffuse(Grid& grid, const jit::ServiceCall& call) {
    enum { Map = kMoreArgs };
    Lanes lanes(call);
    ThreadMemory& memory = grid.memory;
    vec3 sum[kLanes] = {}, sky[kLanes] = {};
    float blocked[kLanes] = {};
    // What lies beyond the last bounce is black; a map alone costs no ray.
    bool bounces = grid.depth < frame_.ray_depth && grid.ray.diffuse < frame_.diffuse_depth &&
                   !frame_.stopped();
    // The bounces are counted: all are followed, the later ones with fewer rays.
    float share[kLanes] = {};
    int samples[kLanes] = {};
    for (int lane = 0; lane < kLanes; ++lane) {
        if (!lanes.asks(lane)) continue;
        samples[lane] = lanes.samples(kSamples, lane);
        if (bounces) share[lane] = fit_samples(grid, lanes.point(lane), samples[lane]);
    }
    Arena::Mark mark = memory.arena.mark();
    std::span<SeenByRay> seen = memory.arena.allocate_span<SeenByRay>(kGridPoints);
    std::span<vec3> dirs = memory.arena.allocate_span<vec3>(kGridPoints);
    std::span<vec3> light = memory.arena.allocate_span<vec3>(kGridPoints);
    NestedWavefront nested(memory);
    ConeRays cone(grid, lanes, glm::transpose(frame_.camera_from_accel));
    auto count = [&](int lane) {
        bool shoots = bounces || lanes.integer(Map, lane) != 0;
        return shoots && cone.count(lane) > 0 ? samples[lane] : 0;
    };
    in_batches(
        lanes, nested->rays, count,
        [&](int lane, uint32_t k, uint32_t slot) {
            dirs[slot] = cone.direction(lane, k);
            seen[slot] = {};
            if (bounces && lanes.number(kMaxdist, lane) > 0)
                cone.add(nested->rays, lane, k, slot, dirs[slot], share[lane]);
        },
        [&](std::span<const uint8_t> lane_of) {
            nested_.see(nested->rays, grid.depth + 1, deeper(grid, RayKind::Diffuse, 0), memory,
                        seen);
            for_each_map(lanes, Map, lane_of, [&](size_t begin, size_t end, int32_t map) {
                light_of_map(*frame_.scene.textures, map, dirs.subspan(begin, end - begin),
                             sample_width(samples[lane_of[begin]]), light.data());
                for (size_t i = begin; i < end; ++i)
                    sky[lane_of[i]] += seen[i].open * light[i - begin];
            });
            for (size_t i = 0; i < lane_of.size(); ++i) {
                vec3 open = seen[i].open;
                sum[lane_of[i]] += seen[i].color;
                blocked[lane_of[i]] += 1 - (open.x + open.y + open.z) / 3;
            }
        });
    memory.arena.release(mark);
    for (int lane = 0; lane < kLanes; ++lane) {
        int n = lanes.asks(lane) ? count(lane) : 0;
        lanes.set(0, lane, n ? (sum[lane] + sky[lane]) / float(n) : vec3(0.0f));
        lanes.set(3, lane, n ? sky[lane] / float(n) : vec3(0.0f));
        lanes.set(6, lane, n ? blocked[lane] / float(n) : 0.0f);
    }
}

}  // namespace kinora
