// runtime/picture/shading/trace_rays.cpp: the services trace, transmission, occlusion and
// indirectdiffuse: what their arguments mean, and how what their rays find is summed. The queue
// does the rest.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/picture/shading/rays/map_directions.h"
#include "runtime/picture/shading/rays/map_tables.h"
#include "runtime/picture/shading/rays/smooth_surface.h"
#include "runtime/picture/shading/volumes.h"
#include "runtime/scene/images/map_light.h"

namespace kinora {

namespace {

constexpr int kLanes = jit::kMaxLanes;

bool has_direction(vec3 d) {
    float length = glm::length(d);
    return length > 0 && length < kMiss;
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

}  // namespace

// ---- trace --------------------------------------------------------------------------------------

namespace {

// Rays along R, or in a cone about it.
class TraceRays {
  public:
    enum {
        P = 2,
        R = 5,
        Maxdist = 8,
        Bias,
        Samples,
        Spread,
        Label,
        Weight,
        Through,
        Counted,
        Rows
    };

    TraceRays(const Grid& grid, const Lanes& lanes) : grid_(grid), lanes_(lanes) {}

    int count(int lane) const {
        return lanes_.number(Spread, lane) > 0 ? lanes_.samples(Samples, lane) : 1;
    }
    // Lanes whose rays are some of many: in a cone, or calls of their own, which say how many.
    uint32_t scattered() const {
        uint32_t lanes = 0;
        for (int lane = 0; lane < kLanes; ++lane)
            if (lanes_.asks(lane))
                lanes |=
                    uint32_t(lanes_.number(Spread, lane) > 0 || lanes_.samples(Samples, lane) > 1)
                    << lane;
        return lanes;
    }
    RayWish wish(int lane) const {
        return {.samples = count(lane),
                .aims = has_direction(lanes_.triple(R, lane)),
                .weight = lanes_.number(Weight, lane),
                .through = lanes_.number(Through, lane)};
    }
    // Made when they are first asked for.
    LaneRays& rays(const RayPlan& plan) {
        if (rays_) return *rays_;
        rays_.emplace(grid_, lanes_, P, R, false);
        for (int lane = 0; lane < kLanes; ++lane) {
            if (plan.count[lane] == 0) continue;
            rays_->set_straight(lane, glm::normalize(rays_->way(lane)));
            if (lanes_.number(Spread, lane) > 0)
                rays_->set_cone(lane, lanes_.number(Spread, lane), plan.count[lane]);
            rays_->set_reach(lane, lanes_.number(Maxdist, lane), lanes_.number(Bias, lane));
            rays_->set_budget(lane, plan.share[lane], plan.allowance[lane]);
            rays_->set_weight(lane, plan.way[lane].weight);
        }
        return *rays_;
    }

  private:
    const Grid& grid_;
    const Lanes& lanes_;
    std::optional<LaneRays> rays_;
};

}  // namespace

void RayServices::trace(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    TraceRays along(grid, lanes);
    vec3 color[kLanes] = {};
    float distance[kLanes];
    std::fill_n(distance, kLanes, kMiss);
    const RayPlan plan =
        queue_.plan(RayKind::Trace, grid, lanes, [&](int lane) { return along.wish(lane); });
    auto add = [&](raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
        along.rays(plan).add(rays, samples, slot);
    };
    auto sum = [&](const SampleSpan& samples, std::span<const SeenByRay> seen) {
        for (size_t i = 0; i < seen.size(); ++i) {
            int lane = samples.lane[i];
            color[lane] += seen[i].color;
            distance[lane] = std::min(distance[lane], seen[i].distance);
        }
    };
    queue_.send({.kind = RayKind::Trace,
                 .grid = grid,
                 .lanes = lanes,
                 .plan = plan,
                 .rows = TraceRays::Rows,
                 .label = TraceRays::Label,
                 .scattered = along.scattered(),
                 // The same for all lanes.
                 .counted = lanes.integer(TraceRays::Counted, lanes.first()) != 0},
                add, SumSamples(sum));
    for (int lane = 0; lane < kLanes; ++lane) {
        const int n = plan.count[lane];
        if (n > 1) color[lane] /= float(n);
        float factor = plan.way[lane].factor;
        lanes.set(0, lane, factor == 1 ? color[lane] : color[lane] * factor);
        lanes.set(3, lane, distance[lane]);
    }
}

// ---- transmission -------------------------------------------------------------------------------

namespace {

// Rays from one point to another. Where an end is a hit of a smooth surface, they leave from that
// surface, unless something stands between it and the facet.
class RaysBetween {
  public:
    enum { From = 2, To = 5, Samples = 8, Spread, Bias };

    RaysBetween(Grid& grid, const Lanes& lanes)
        : grid_(grid), lanes_(lanes), smooth_(grid.frame.shapes, grid.pose) {}

    // Nothing can lie between two points that are the same.
    RayWish wish(int lane) const {
        return {.samples = lanes_.number(Spread, lane) > 0 ? lanes_.samples(Samples, lane) : 1,
                .aims = has_direction(lanes_.triple(To, lane) - lanes_.triple(From, lane))};
    }
    void add(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
        if (ways_.empty()) ways_ = grid_.memory.arena.allocate_span<Way>(kGridPoints);
        for (uint32_t i = 0; i < samples.size(); ++i) {
            const int lane = samples.lane[i];
            Way& way = ways_[i];
            way = {ray_start(grid_, lanes_.point(lane), lanes_.triple(From, lane)),
                   ray_start(grid_, lanes_.point(lane), lanes_.triple(To, lane)), lane,
                   samples.number[i]};
            vec3 straight = way.to.P - way.from.P;
            way.up_from = way_up(way.from, straight);
            way.up_to = way_up(way.to, -straight);
            add_ray_of(rays, way, slot + i);
        }
    }
    // Sends the rays added last that leave smooth surfaces in vain once more, from the facets:
    // what passes these, at their samples.
    void send_again(RayQueue& queue, std::span<const SeenByRay> seen, std::span<vec3> through);

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
        return up == vec3(0.0f) || is_way_free(grid_.pose.accel, end.P, end.error, end.Ng, up,
                                               grid_.memory.counters.trace);
    }
    // Whether what the ray passes is not what passes between the facets.
    bool is_in_vain(const Way& way) const {
        const bool lifted = way.up_from != vec3(0.0f) || way.up_to != vec3(0.0f);
        return lifted && !(is_free(way.from, way.up_from) && is_free(way.to, way.up_to));
    }
    void add_ray_of(raytrace::RayBatch& rays, const Way& way, uint32_t slot);
    vec3 direction(const Way& way) const;

    Grid& grid_;
    const Lanes& lanes_;
    SmoothSurface smooth_;
    std::span<Way> ways_;
};

void RaysBetween::send_again(RayQueue& queue, std::span<const SeenByRay> seen,
                             std::span<vec3> through) {
    NestedWavefront nested(grid_.memory);
    raytrace::RayBatch& again = nested->rays;
    again.reserve(kGridPoints);
    again.count = 0;
    uint32_t sample_of[kGridPoints];
    for (uint32_t i = 0; i < seen.size(); ++i) {
        Way& way = ways_[i];
        if (seen[i].open == vec3(0.0f) || !is_in_vain(way)) continue;
        way.up_from = way.up_to = vec3(0.0f);
        sample_of[again.count] = i;
        add_ray_of(again, way, uint32_t(again.count));
    }
    if (again.count == 0) return;
    set_kind(again, 0, RayKind::Transmission);
    std::span<SeenByRay> found = grid_.memory.arena.allocate_span<SeenByRay>(again.count);
    queue.pass(again, sent_tag(grid_.ray, row_of(RayKind::Transmission), 0), grid_.memory, false,
               found);
    for (size_t i = 0; i < found.size(); ++i) through[sample_of[i]] = found[i].open;
}

// From end to end; within the cone where there is one.
vec3 RaysBetween::direction(const Way& w) const {
    const vec3 way = (w.to.P + w.up_to) - (w.from.P + w.up_from);
    const float spread = lanes_.number(Spread, w.lane);
    if (!(spread > 0)) return way;
    grid_.note_random();
    const raytrace::SampleSeries series =
        series_of(grid_, lanes_, w.lane, *w.from.hits, w.from.hit);
    const uint32_t number = series.part * uint32_t(lanes_.samples(Samples, w.lane)) + w.sample;
    return Cone(way, spread, false).direction(number, series.seed) * glm::length(way);
}

// A point off its surface, or off the box of its error, towards `way`.
vec3 off_surface(vec3 at, vec3 error, const RayStart& end, vec3 up, vec3 way) {
    if (end.Ng != vec3(0.0f))
        return raytrace::offset_ray_origin(at, error, end.Ng, up == vec3(0.0f) ? way : up);
    float clear = 2 * std::max(end.error.x, std::max(end.error.y, end.error.z));
    return at + way * (clear / glm::length(way));
}

// The end keeps clear of the surface it may lie on, as the beginning does.
void RaysBetween::add_ray_of(raytrace::RayBatch& rays, const Way& w, uint32_t slot) {
    const RayStart& start = w.from;
    const vec3 way = direction(w);
    const vec3 target =
        off_surface(start.P + w.up_from + way, w.to.error + vec3(end_error(start.P, w.to.P)), w.to,
                    w.up_to, -way);
    const vec3 org = off_surface(start.P + w.up_from, start.error, start, w.up_from, way);
    vec3 dir = target - org;
    if (!has_direction(dir) || glm::dot(dir, way) <= 0) dir = way * 1e-6f;
    add_ray(rays, grid_, start, dir, 1.0f, lanes_.number(Bias, w.lane) / glm::length(dir),
            raytrace::hash(lanes_.seed(w.lane), w.sample), slot);
    // It leaves from there, on the side where the surface is.
    size_t i = rays.count - 1;
    set_triple(rays.org, i, org);
    set_triple(rays.first_org, i, org);
    if (!grid_.frame.shaders.volumes.empty())
        rays.medium[i] = nested_medium(grid_.frame, *start.hits, start.hit,
                                       w.up_from == vec3(0.0f) ? way : w.up_from);
}

}  // namespace

void RayServices::transmission(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    RaysBetween between(grid, lanes);
    vec3 through[kLanes] = {};
    const RayPlan plan = queue_.plan(RayKind::Transmission, grid, lanes,
                                     [&](int lane) { return between.wish(lane); });
    auto add = [&](raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
        between.add(rays, samples, slot);
    };
    auto sum = [&](const SampleSpan& samples, std::span<const SeenByRay> seen) {
        vec3 open[kGridPoints];
        for (size_t i = 0; i < seen.size(); ++i) open[i] = seen[i].open;
        between.send_again(queue_, seen, open);
        for (size_t i = 0; i < seen.size(); ++i) through[samples.lane[i]] += open[i];
    };
    queue_.send({RayKind::Transmission, grid, lanes, plan}, add, SumSamples(sum));
    for (int lane = 0; lane < kLanes; ++lane) {
        const int n = plan.count[lane];
        lanes.set(0, lane, n ? through[lane] / float(n) : vec3(1.0f));
    }
}

// ---- occlusion and indirectdiffuse --------------------------------------------------------------

namespace {

// Rays in a cone about N, denser along it. Lanes with a map whose light comes from a small part of
// it send half of them there.
class ConeRays {
  public:
    enum { P = 2, N = 5, Samples = 8, Angle, Maxdist, Bias, More };

    // `map`: a row of the arguments.
    ConeRays(const Grid& grid, const Lanes& lanes, int map, MapTables& maps)
        : grid_(grid), lanes_(lanes), map_(map), maps_(maps) {}

    int count(int lane) const { return lanes_.samples(Samples, lane); }
    bool aims(int lane) const { return grid_.shadows && has_direction(lanes_.triple(N, lane)); }
    void add(raytrace::RayBatch& rays, const RayPlan& plan, const SampleSpan& samples,
             uint32_t slot);
    vec3 direction(const RayPlan& plan, int lane, uint32_t k) {
        LaneRays& made = made_rays(plan);
        return to_map_[lane] ? over_[lane].direction(first_[lane] + k) : made.direction(lane, k);
    }
    bool counts(const RayPlan& plan, int lane, uint32_t k) {
        made_rays(plan);
        return !to_map_[lane] || weight(lane, direction(plan, lane, k)) > 0;
    }
    // What a sample counts, on the average 1.
    float weight(int lane, vec3 direction) const {
        return to_map_[lane] ? over_[lane].weight(direction) : 1.0f;
    }

  private:
    LaneRays& made_rays(const RayPlan& plan);
    void aim_at_map(const RayPlan& plan, int lane);
    void add_to_map(raytrace::RayBatch& rays, const RayPlan& plan, int lane, uint32_t k,
                    uint32_t slot);

    const Grid& grid_;
    const Lanes& lanes_;
    const int map_;
    MapTables& maps_;
    std::optional<LaneRays> rays_;
    bool to_map_[kLanes] = {};  // lanes that send rays to their map
    MapDirections over_[kLanes];
    uint32_t first_[kLanes] = {};  // sample of such a lane
};

// Made when they are first asked for.
LaneRays& ConeRays::made_rays(const RayPlan& plan) {
    if (rays_) return *rays_;
    rays_.emplace(grid_, lanes_, P, N, true);
    for (int lane = 0; lane < kLanes; ++lane) {
        if (!lanes_.asks(lane)) continue;
        rays_->set_cone(lane, lanes_.number(Angle, lane), plan.count[lane]);
        rays_->set_reach(lane, lanes_.number(Maxdist, lane), lanes_.number(Bias, lane));
        rays_->set_budget(lane, plan.share[lane], plan.allowance[lane]);
    }
    for (int lane = 0; lane < kLanes; ++lane)
        if (plan.count[lane] > 0 && lanes_.integer(map_, lane)) aim_at_map(plan, lane);
    return *rays_;
}

void ConeRays::aim_at_map(const RayPlan& plan, int lane) {
    const EnvironmentTable* table = maps_.find(lanes_.integer(map_, lane));
    if (!table) return;
    const RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(P, lane));
    const raytrace::SampleSeries series = series_of(grid_, lanes_, lane, *start.hits, start.hit);
    to_map_[lane] = true;
    over_[lane] = MapDirections(rays_->cone(lane), table, series.seed);
    first_[lane] = series.part * uint32_t(plan.count[lane]);
}

void ConeRays::add(raytrace::RayBatch& rays, const RayPlan& plan, const SampleSpan& samples,
                   uint32_t slot) {
    LaneRays& made = made_rays(plan);
    for (size_t i = 0, n; i < samples.size(); i += n) {
        const bool to_map = to_map_[samples.lane[i]];
        for (n = 1; i + n < samples.size() && to_map_[samples.lane[i + n]] == to_map;) ++n;
        if (!to_map) made.add(rays, samples.subspan(i, n), slot + uint32_t(i));
        for (size_t j = i; to_map && j < i + n; ++j)
            add_to_map(rays, plan, samples.lane[j], samples.number[j], slot + uint32_t(j));
    }
}

void ConeRays::add_to_map(raytrace::RayBatch& rays, const RayPlan& plan, int lane, uint32_t k,
                          uint32_t slot) {
    const RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(P, lane));
    add_ray(rays, grid_, start, direction(plan, lane, k), lanes_.number(Maxdist, lane),
            lanes_.number(Bias, lane), raytrace::hash(lanes_.seed(lane), first_[lane] + k), slot);
    spread_ray(rays, grid_, *start.hits, start.hit);
    rays.share[rays.count - 1] = plan.share[lane];
    rays.allowance[rays.count - 1] = plan.allowance[lane];
}

// What occlusion finds, lane by lane.
class OcclusionSum {
  public:
    enum { Falloff = ConeRays::More, Mode, Map };

    OcclusionSum(TextureStore& textures, const Lanes& lanes, const RayPlan& plan,
                 const ConeRays& cone)
        : textures_(textures), lanes_(lanes), plan_(plan), cone_(cone) {}

    bool by_distance(int lane) const { return lanes_.number(Falloff, lane) > 0; }
    // `direction`: of each sample.
    void add(const SampleSpan& samples, std::span<const SeenByRay> seen,
             std::span<const vec3> direction, Arena& arena);
    void put(const mat3& camera_from_accel) const {
        for (int lane = 0; lane < kLanes; ++lane) {
            const int n = plan_.count[lane];
            lanes_.set(0, lane, n ? blocked_[lane] / float(n) : 0.0f);
            float length = glm::length(open_[lane]);
            vec3 mean = length > 0 ? camera_from_accel * open_[lane] / length : vec3(0.0f);
            lanes_.set(1, lane, n ? mean : lanes_.triple(ConeRays::N, lane));
            lanes_.set(4, lane, n ? sky_[lane] / float(n) : vec3(0.0f));
        }
    }

  private:
    // What is left of a ray's occlusion by something at that distance. "falloffmode" 0:
    // exponential, 1: a power of the share of maxdist left.
    float fade(int lane, float distance) const {
        const float falloff = lanes_.number(Falloff, lane);
        if (!(lanes_.number(Mode, lane) > 0)) return std::exp(-falloff * distance);
        const float left = 1 - distance / lanes_.number(ConeRays::Maxdist, lane);
        return std::pow(std::max(0.0f, left), falloff);
    }

    TextureStore& textures_;
    const Lanes& lanes_;
    const RayPlan& plan_;
    const ConeRays& cone_;
    float blocked_[kLanes] = {};
    vec3 open_[kLanes] = {}, sky_[kLanes] = {};
};

void OcclusionSum::add(const SampleSpan& samples, std::span<const SeenByRay> seen,
                       std::span<const vec3> direction, Arena& arena) {
    Arena::Mark mark = arena.mark();
    std::span<vec3> through = arena.allocate_span<vec3>(seen.size());
    for (size_t i = 0; i < seen.size(); ++i) {
        const int lane = samples.lane[i];
        through[i] = seen[i].open;
        float hidden = 1 - (through[i].x + through[i].y + through[i].z) / 3;
        if (by_distance(lane) && hidden > 0) {
            const float left = fade(lane, seen[i].distance);
            hidden *= left;
            if (hidden > 0) through[i] = vec3(1.0f) - (vec3(1.0f) - through[i]) * left;
        }
        const float weight = cone_.weight(lane, direction[i]);
        through[i] *= weight;
        blocked_[lane] += hidden * weight;
        open_[lane] += (1 - hidden) * weight * direction[i];
    }
    std::span<vec3> light = arena.allocate_span<vec3>(seen.size());
    for_each_map(lanes_, Map, samples.lane, [&](size_t begin, size_t end, int32_t map) {
        const int lane = samples.lane[begin];
        light_of_map(textures_, map, direction.subspan(begin, end - begin), light.data());
        for (size_t i = begin; i < end; ++i) sky_[lane] += through[i] * light[i - begin];
    });
    arena.release(mark);
}

}  // namespace

void RayServices::occlusion(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    Arena& arena = grid.memory.arena;
    ConeRays cone(grid, lanes, OcclusionSum::Map, maps_);
    const RayPlan plan = queue_.plan(RayKind::Occlusion, grid, lanes, [&](int lane) {
        return RayWish{.samples = cone.count(lane), .aims = cone.aims(lane)};
    });
    OcclusionSum sum(*frame_.resources.textures, lanes, plan, cone);
    RayCall rays_of{RayKind::Occlusion, grid, lanes, plan};
    for (int lane = 0; lane < kLanes; ++lane)
        rays_of.distances |= plan.count[lane] > 0 && sum.by_distance(lane);
    Arena::Mark mark = arena.mark();
    std::span<vec3> directions = arena.allocate_span<vec3>(plan.any() ? kGridPoints : 0);
    queue_.send(
        rays_of,
        [&](raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
            cone.add(rays, plan, samples, slot);
            for (size_t i = 0; i < samples.size(); ++i) directions[i] = triple(rays.dir, i);
        },
        SumSamples([&](const SampleSpan& samples, std::span<const SeenByRay> seen) {
            sum.add(samples, seen, directions, arena);
        }));
    arena.release(mark);
    sum.put(frame_.camera_from_accel);
}

namespace {

// What indirectdiffuse finds, lane by lane: the color, what of it is sky, how much is blocked.
class IndirectSum {
  public:
    enum { Map = ConeRays::More, Rows };

    IndirectSum(TextureStore& textures, const Lanes& lanes, const RayPlan& plan)
        : textures_(textures), lanes_(lanes), plan_(plan) {}

    void add(const SampleSpan& samples, std::span<const SeenByRay> seen, ConeRays& cone,
             Arena& arena);
    void put() const {
        for (int lane = 0; lane < kLanes; ++lane) {
            const float n = float(plan_.count[lane]) / plan_.way[lane].factor;
            lanes_.set(0, lane, n > 0 ? (color_[lane] + sky_[lane]) / n : vec3(0.0f));
            lanes_.set(3, lane, n > 0 ? sky_[lane] / n : vec3(0.0f));
            lanes_.set(6, lane, n > 0 ? blocked_[lane] / n : 0.0f);
        }
    }

  private:
    TextureStore& textures_;
    const Lanes& lanes_;
    const RayPlan& plan_;
    vec3 color_[kLanes] = {}, sky_[kLanes] = {};
    float blocked_[kLanes] = {};
};

void IndirectSum::add(const SampleSpan& samples, std::span<const SeenByRay> seen, ConeRays& cone,
                      Arena& arena) {
    Arena::Mark mark = arena.mark();
    std::span<float> weight = arena.allocate_span<float>(seen.size());
    std::fill(weight.begin(), weight.end(), 1.0f);
    for_each_map(lanes_, Map, samples.lane, [&](size_t begin, size_t end, int32_t map) {
        const int lane = samples.lane[begin];
        std::span<vec3> directions = arena.allocate_span<vec3>(end - begin);
        std::span<vec3> light = arena.allocate_span<vec3>(end - begin);
        for (size_t i = begin; i < end; ++i) {
            directions[i - begin] = cone.direction(plan_, lane, samples.number[i]);
            weight[i] = cone.weight(lane, directions[i - begin]);
        }
        light_of_map(textures_, map, directions, light.data());
        for (size_t i = begin; i < end; ++i)
            sky_[lane] += weight[i] * seen[i].open * light[i - begin];
    });
    for (size_t i = 0; i < seen.size(); ++i) {
        const vec3 open = seen[i].open;
        color_[samples.lane[i]] += weight[i] * seen[i].color;
        blocked_[samples.lane[i]] += weight[i] * (1 - (open.x + open.y + open.z) / 3);
    }
    arena.release(mark);
}

}  // namespace

// What lies beyond the last bounce is black; a map alone costs no ray. The bounces are counted: all
// are followed, the later ones with fewer rays.
void RayServices::indirect_diffuse(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    ConeRays cone(grid, lanes, IndirectSum::Map, maps_);
    auto reaches = [&](int lane) { return lanes.number(ConeRays::Maxdist, lane) > 0; };
    const RayPlan plan = queue_.plan(RayKind::Indirect, grid, lanes, [&](int lane) {
        return RayWish{.samples = cone.count(lane),
                       .aims = cone.aims(lane),
                       .shoots = reaches(lane),
                       .unshot = lanes.integer(IndirectSum::Map, lane) != 0};
    });
    IndirectSum sum(*frame_.resources.textures, lanes, plan);
    queue_.send(
        {.kind = RayKind::Indirect,
         .grid = grid,
         .lanes = lanes,
         .plan = plan,
         .rows = IndirectSum::Rows,
         .scattered = lanes.mask()},
        [&](raytrace::RayBatch& rays, const SampleSpan& planned, uint32_t slot) {
            auto shoots = [&](size_t at) {
                const int lane = planned.lane[at];
                return plan.share[lane] > 0 && reaches(lane) &&
                       cone.counts(plan, lane, planned.number[at]);
            };
            for (size_t i = 0, n; i < planned.size(); i += n) {  // runs that are shot or not
                for (n = 1; i + n < planned.size() && shoots(i + n) == shoots(i);) ++n;
                if (shoots(i)) cone.add(rays, plan, planned.subspan(i, n), slot + uint32_t(i));
            }
        },
        SumSamples([&](const SampleSpan& samples, std::span<const SeenByRay> seen) {
            sum.add(samples, seen, cone, grid.memory.arena);
        }));
    sum.put();
}

}  // namespace kinora
