// runtime/picture/shading/trace_rays.cpp: the services trace, transmission, occlusion and
// indirectdiffuse: the samples of a lane group go in dense batches, each lane sums its own in their
// order, so that no result depends on its neighbours.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "runtime/picture/shading/nested_rays.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/picture/shading/transmission.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

constexpr int kLanes = jit::kMaxLanes;

// Fills batches with the samples of all lanes: add(samples) adds the rays of one batch, whose slots
// count up from 0, and flush(lane of each) consumes them.
template <class Add, class Flush>
void in_batches(const Lanes& lanes, const int (&count)[kLanes], raytrace::RayBatch& rays, Add&& add,
                Flush&& flush) {
    uint8_t lane_of[kGridPoints];
    uint32_t number_of[kGridPoints];
    size_t filled = 0;
    rays.reserve(kGridPoints);
    rays.count = 0;
    auto empty = [&] {
        if (filled == 0) return;
        add(SampleSpan{{lane_of, filled}, {number_of, filled}});
        flush(std::span<const uint8_t>(lane_of, filled));
        rays.count = 0;
        filled = 0;
    };
    for (int lane = 0; lane < kLanes; ++lane)
        for (int k = 0; lanes.asks(lane) && k < count[lane]; ++k) {
            lane_of[filled] = uint8_t(lane);
            number_of[filled] = uint32_t(k);
            if (++filled == kGridPoints) empty();
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
    ConeRays(const Grid& grid, const Lanes& lanes) : grid_(grid), lanes_(lanes) {}

    int count(int lane) const {
        bool asks = grid_.shadows && has_direction(lanes_.triple(kN, lane));
        return asks ? lanes_.samples(kSamples, lane) : 0;
    }
    // Made when they are first asked for; `count` and `share` of each lane.
    LaneRays& rays(const int (&count)[kLanes], const float (&share)[kLanes]) {
        if (rays_) return *rays_;
        rays_.emplace(grid_, lanes_, kP, kN, true);
        for (int lane = 0; lane < kLanes; ++lane) {
            if (!lanes_.asks(lane)) continue;
            rays_->set_cone(lane, lanes_.number(kAngle, lane), count[lane]);
            rays_->set_reach(lane, lanes_.number(kMaxdist, lane), lanes_.number(kBias, lane),
                             share[lane]);
        }
        return *rays_;
    }

  private:
    const Grid& grid_;
    const Lanes& lanes_;
    std::optional<LaneRays> rays_;
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
    enum { P = 2, R = 5, Maxdist = 8, Bias, Samples, Spread, Label, Weight, Through, Rows };
    Lanes lanes(call);
    vec3 color[kLanes] = {};
    float distance[kLanes];
    std::fill_n(distance, kLanes, kMiss);
    auto count = [&](int lane) {
        return lanes.number(Spread, lane) > 0 ? lanes.samples(Samples, lane) : 1;
    };
    RayPlan plan;
    // How many of them are shot.
    auto shoot = [&](int lane) {
        if (!has_direction(lanes.triple(R, lane))) return 0;
        size_t point = lanes.point(lane);
        int n = count(lane);
        plan.share[lane] = ray_share(grid, point, n);
        if (plan.share[lane] == 0) {
            refuse_rays(grid, point, n);
            return 0;
        }
        plan.way[lane] =
            choose_way(grid, point, lanes.number(Weight, lane), lanes.number(Through, lane));
        return plan.way[lane].factor > 0 && spend_rays(grid, point, n) ? n : 0;
    };
    bool deep = grid.depth >= frame_.quality.ray_depth;
    bool shoots = grid.shadows && !deep && !frame_.stopped();
    for (int lane = 0; lane < kLanes; ++lane) {
        if (!lanes.asks(lane)) continue;
        if (deep) refuse_rays(grid, lanes.point(lane), count(lane));
        if (shoots) plan.count[lane] = shoot(lane);
    }
    std::optional<LaneRays> made;
    auto make = [&] {
        made.emplace(grid, lanes, P, R, false);
        for (int lane = 0; lane < kLanes; ++lane) {
            if (plan.count[lane] == 0) continue;
            made->set_straight(lane, glm::normalize(made->way(lane)));
            if (lanes.number(Spread, lane) > 0)
                made->set_cone(lane, lanes.number(Spread, lane), count(lane));
            made->set_reach(lane, lanes.number(Maxdist, lane), lanes.number(Bias, lane),
                            plan.share[lane]);
            made->set_weight(lane, plan.way[lane].weight);
        }
    };
    auto add = [&](raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
        if (!made) make();
        made->add(rays, samples, slot);
    };
    auto sum = [&](const SampleSpan& samples, std::span<const SeenByRay> seen) {
        for (size_t i = 0; i < seen.size(); ++i) {
            int lane = samples.lane[i];
            color[lane] += seen[i].color;
            distance[lane] = std::min(distance[lane], seen[i].distance);
        }
    };
    if (plan.any())
        lanes.for_each_text(Label, [&](const Lanes& alike) {
            RayTag tag = deeper(grid, RayKind::Specular, lanes.integer(Label, alike.first()));
            see_samples(grid, alike, Rows, plan, tag, nested_, add, sum);
        });
    for (int lane = 0; lane < kLanes; ++lane) {
        int n = lanes.asks(lane) ? count(lane) : 1;
        if (n > 1) color[lane] /= float(n);
        float factor = plan.way[lane].factor;
        lanes.set(0, lane, factor == 1 ? color[lane] : color[lane] * factor);
        lanes.set(3, lane, distance[lane]);
    }
}

// The samples of one call of transmission. Where an end is a hit of a smooth surface, rays leave
// from that surface, unless something stands between it and the facet.
class RayServices::Passing {
  public:
    Passing(const ShadingFrame& frame, Grid& grid, const Lanes& lanes, Transmission& transmission)
        : frame_(frame),
          grid_(grid),
          lanes_(lanes),
          transmission_(transmission),
          smooth_(frame.scene, frame.pose),
          ways_(grid.memory.arena.allocate_span<Way>(kGridPoints)),
          through_(grid.memory.arena.allocate_span<vec3>(kGridPoints)) {}

    void add(raytrace::RayBatch& rays, int lane, uint32_t k, uint32_t slot) {
        Way& way = ways_[slot];
        way = {ray_start(grid_, lanes_.point(lane), lanes_.triple(kFrom, lane)),
               ray_start(grid_, lanes_.point(lane), lanes_.triple(kTo, lane)), lane, k};
        vec3 straight = way.to.P - way.from.P;
        way.up_from = way_up(way.from, straight);
        way.up_to = way_up(way.to, -straight);
        add_ray_of(rays, way, slot);
    }
    // What passes each of the rays added; consumes them.
    std::span<const vec3> pass(raytrace::RayBatch& rays) {
        std::span<vec3> through = through_.first(rays.count);
        transmission_.pass(rays, grid_.ray, grid_.memory, through);
        NestedWavefront nested(grid_.memory);
        raytrace::RayBatch& again = nested->rays;
        again.reserve(kGridPoints);
        again.count = 0;
        uint32_t slots[kGridPoints];
        for (uint32_t slot = 0; slot < through.size(); ++slot) {
            Way& way = ways_[slot];
            bool lifted = way.up_from != vec3(0.0f) || way.up_to != vec3(0.0f);
            if (!lifted || through[slot] == vec3(0.0f)) continue;
            if (is_free(way.from, way.up_from) && is_free(way.to, way.up_to)) continue;
            way.up_from = way.up_to = vec3(0.0f);
            slots[again.count] = slot;
            add_ray_of(again, way, uint32_t(again.count));
        }
        if (again.count > 0) {
            std::span<vec3> found = grid_.memory.arena.allocate_span<vec3>(again.count);
            transmission_.pass(again, grid_.ray, grid_.memory, found);
            for (size_t i = 0; i < found.size(); ++i) through[slots[i]] = found[i];
        }
        return through;
    }

  private:
    struct Way {
        RayStart from, to;
        int lane;
        uint32_t sample;
        vec3 up_from{0.0f}, up_to{0.0f};  // from the facets of the ends
    };

    vec3 way_up(const RayStart& end, vec3 dir) {
        const raytrace::HitBatch& lit = grid_.lit ? grid_.lit->hits : grid_.hits;
        bool hit = end.Ng != vec3(0.0f) && on_surface(grid_) && end.hits == &lit;
        if (!hit) return vec3(0.0f);
        return smooth_.way_from(lit, end.hit, dir);
    }
    bool is_free(const RayStart& end, vec3 up) const {
        return up == vec3(0.0f) || is_way_free(frame_.pose.accel, end.P, end.error, end.Ng, up,
                                               grid_.memory.counters.trace);
    }
    void add_ray_of(raytrace::RayBatch& rays, const Way& w, uint32_t slot) {
        int lane = w.lane;
        const RayStart& start = w.from;
        // The end keeps clear of the surface it may lie on, as the beginning does.
        vec3 way = (w.to.P + w.up_to) - (start.P + w.up_from);
        if (float spread = lanes_.number(kSpread, lane); spread > 0) {
            grid_.note_random();
            const raytrace::SampleSeries series =
                series_of(grid_, lanes_, lane, *start.hits, start.hit);
            const uint32_t number =
                series.part * uint32_t(lanes_.samples(kSamples, lane)) + w.sample;
            way = Cone(way, spread, false).direction(number, series.seed) * glm::length(way);
        }
        vec3 target = start.P + w.up_from + way;
        if (w.to.Ng != vec3(0.0f)) {
            vec3 off = w.up_to == vec3(0.0f) ? -way : w.up_to;
            vec3 error = w.to.error + vec3(end_error(start.P, w.to.P));
            target = raytrace::offset_ray_origin(target, error, w.to.Ng, off);
        } else {
            float clear = 2 * std::max(w.to.error.x, std::max(w.to.error.y, w.to.error.z));
            target -= way * (clear / glm::length(way));
        }
        vec3 org = start.P + w.up_from;
        vec3 off = w.up_from == vec3(0.0f) ? way : w.up_from;
        if (start.Ng != vec3(0.0f)) {
            org = raytrace::offset_ray_origin(org, start.error, start.Ng, off);
        } else {
            float clear = 2 * std::max(start.error.x, std::max(start.error.y, start.error.z));
            org += way * (clear / glm::length(way));
        }
        vec3 dir = target - org;
        if (!has_direction(dir) || glm::dot(dir, way) <= 0) dir = way * 1e-6f;
        add_ray(rays, grid_, start, dir, 1.0f, lanes_.number(kBias, lane) / glm::length(dir),
                raytrace::hash(lanes_.seed(lane), w.sample), slot);
        // It leaves from there, on the side where the surface is.
        size_t i = rays.count - 1;
        set_triple(rays.org, i, org);
        set_triple(rays.first_org, i, org);
        if (!frame_.scene.volumes.empty())
            rays.medium[i] = nested_medium(frame_.scene, *start.hits, start.hit, off);
    }

    const ShadingFrame& frame_;
    Grid& grid_;
    const Lanes& lanes_;
    Transmission& transmission_;
    SmoothSurface smooth_;
    std::span<Way> ways_;
    std::span<vec3> through_;

  public:
    enum { kFrom = 2, kTo = 5, kSamples = 8, kSpread, kBias };
};

void RayServices::transmission(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    vec3 sum[kLanes];
    int count[kLanes] = {};
    for (int lane = 0; lane < kLanes; ++lane) {
        sum[lane] = vec3(0.0f);
        // Nothing can lie between two points that are the same.
        bool open =
            !lanes.asks(lane) || !grid.shadows || frame_.stopped() ||
            !has_direction(lanes.triple(Passing::kTo, lane) - lanes.triple(Passing::kFrom, lane));
        if (open) continue;
        int n =
            lanes.number(Passing::kSpread, lane) > 0 ? lanes.samples(Passing::kSamples, lane) : 1;
        count[lane] = spend_samples(grid, lanes.point(lane), n);
    }
    if (is_noting(grid)) {
        for (int lane = 0; lane < kLanes; ++lane) lanes.set(0, lane, vec3(1.0f));
        return;
    }
    ThreadMemory& memory = grid.memory;
    Arena::Mark mark = memory.arena.mark();
    Passing passing(frame_, grid, lanes, transmission_);
    NestedWavefront nested(memory);
    in_batches(
        lanes, count, nested->rays,
        [&](const SampleSpan& samples) {
            for (uint32_t i = 0; i < samples.size(); ++i)
                passing.add(nested->rays, samples.lane[i], samples.number[i], i);
        },
        [&](std::span<const uint8_t> lane_of) {
            std::span<const vec3> through = passing.pass(nested->rays);
            for (size_t i = 0; i < lane_of.size(); ++i) sum[lane_of[i]] += through[i];
        });
    memory.arena.release(mark);
    for (int lane = 0; lane < kLanes; ++lane)
        lanes.set(0, lane, count[lane] ? sum[lane] / float(count[lane]) : vec3(1.0f));
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
    ConeRays cone(grid, lanes);
    int count[kLanes] = {};
    float share[kLanes];
    std::fill_n(share, kLanes, 1.0f);
    for (int lane = 0; lane < kLanes; ++lane) {
        int wanted = lanes.asks(lane) && !frame_.stopped() ? cone.count(lane) : 0;
        if (wanted > 0) count[lane] = spend_samples(grid, lanes.point(lane), wanted);
        if (is_noting(grid)) count[lane] = 0;
    }
    in_batches(
        lanes, count, nested->rays,
        [&](const SampleSpan& samples) {
            cone.rays(count, share).add(nested->rays, samples, 0);
            for (size_t i = 0; i < samples.size(); ++i) dirs[i] = triple(nested->rays.dir, i);
        },
        [&](std::span<const uint8_t> lane_of) {
            bool by_distance = false;
            for (uint8_t lane : lane_of) by_distance |= lanes.number(Falloff, lane) > 0;
            std::span<float> weight =
                memory.arena.allocate_span<float>(by_distance ? kGridPoints : 0);
            if (by_distance) find_distances(frame_.pose.accel, nested->rays, memory, weight);
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
                             sample_width(count[lane_of[begin]]), light.data());
                for (size_t i = begin; i < end; ++i)
                    sky[lane_of[i]] += through[i] * light[i - begin];
            });
        });
    memory.arena.release(mark);
    for (int lane = 0; lane < kLanes; ++lane) {
        int n = count[lane];
        lanes.set(0, lane, n ? blocked[lane] / float(n) : 0.0f);
        float length = glm::length(open[lane]);
        vec3 mean = length > 0 ? frame_.camera_from_accel * open[lane] / length : vec3(0.0f);
        lanes.set(1, lane, n ? mean : lanes.triple(kN, lane));
        lanes.set(4, lane, n ? sky[lane] / float(n) : vec3(0.0f));
    }
}

void RayServices::indirect_diffuse(Grid& grid, const jit::ServiceCall& call) {
    enum { Map = kMoreArgs, Rows };
    constexpr int kResults = 7;  // the color, what of it is sky, how much is blocked
    Lanes lanes(call);
    ThreadMemory& memory = grid.memory;
    vec3 sum[kLanes] = {}, sky[kLanes] = {};
    float blocked[kLanes] = {};
    // What lies beyond the last bounce is black; a map alone costs no ray.
    bool bounces = grid.depth < frame_.quality.ray_depth &&
                   grid.ray.diffuse < frame_.quality.diffuse_depth && !frame_.stopped();
    ConeRays cone(grid, lanes);
    // The bounces are counted: all are followed, the later ones with fewer rays.
    float share[kLanes] = {};
    int samples[kLanes] = {};
    for (int lane = 0; lane < kLanes; ++lane) {
        if (!lanes.asks(lane)) continue;
        samples[lane] = lanes.samples(kSamples, lane);
        size_t point = lanes.point(lane);
        bool shoots = lanes.number(kMaxdist, lane) > 0 && cone.count(lane) > 0;
        if (!bounces && shoots) refuse_rays(grid, point, samples[lane]);
        if (!bounces) continue;
        share[lane] = fit_samples(grid, point, samples[lane]);
        if (shoots && !spend_rays(grid, point, samples[lane])) samples[lane] = 0;
    }
    RayPlan plan;
    for (int lane = 0; lane < kLanes; ++lane) {
        bool shoots = lanes.asks(lane) && (bounces || lanes.integer(Map, lane) != 0);
        plan.count[lane] = shoots && cone.count(lane) > 0 ? samples[lane] : 0;
        plan.share[lane] = share[lane];
    }
    if (!plan.any()) {  // as beyond the last bounce
        std::fill_n(call.results, kResults * kLanes, 0.0f);
        return;
    }
    Arena::Mark mark = memory.arena.mark();
    size_t most = is_noting(grid) ? 0 : kGridPoints;
    std::span<vec3> dirs = memory.arena.allocate_span<vec3>(most);
    std::span<vec3> light = memory.arena.allocate_span<vec3>(most);
    see_samples(
        grid, lanes, Rows, plan, deeper(grid, RayKind::Diffuse, 0), nested_,
        [&](raytrace::RayBatch& rays, const SampleSpan& planned, uint32_t slot) {
            auto shoots = [&](size_t at) {
                return bounces && lanes.number(kMaxdist, planned.lane[at]) > 0;
            };
            for (size_t i = 0, n; i < planned.size(); i += n) {  // runs that are shot or not
                for (n = 1; i + n < planned.size() && shoots(i + n) == shoots(i);) ++n;
                if (shoots(i))
                    cone.rays(plan.count, plan.share)
                        .add(rays, planned.subspan(i, n), slot + uint32_t(i));
            }
        },
        [&](const SampleSpan& all, std::span<const SeenByRay> seen) {
            for_each_map(lanes, Map, all.lane, [&](size_t begin, size_t end, int32_t map) {
                int lane = all.lane[begin];
                for (size_t i = begin; i < end; ++i)
                    dirs[i - begin] =
                        cone.rays(plan.count, plan.share).direction(lane, all.number[i]);
                light_of_map(*frame_.scene.textures, map, dirs.first(end - begin),
                             sample_width(samples[lane]), light.data());
                for (size_t i = begin; i < end; ++i) sky[lane] += seen[i].open * light[i - begin];
            });
            for (size_t i = 0; i < seen.size(); ++i) {
                vec3 open = seen[i].open;
                sum[all.lane[i]] += seen[i].color;
                blocked[all.lane[i]] += 1 - (open.x + open.y + open.z) / 3;
            }
        });
    if (!is_noting(grid)) memory.arena.release(mark);
    for (int lane = 0; lane < kLanes; ++lane) {
        int n = plan.count[lane];
        lanes.set(0, lane, n ? (sum[lane] + sky[lane]) / float(n) : vec3(0.0f));
        lanes.set(3, lane, n ? sky[lane] / float(n) : vec3(0.0f));
        lanes.set(6, lane, n ? blocked[lane] / float(n) : 0.0f);
    }
}

}  // namespace kinora
