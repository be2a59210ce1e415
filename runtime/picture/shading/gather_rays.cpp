// runtime/picture/shading/gather_rays.cpp: the service gather: all rays of a statement at once,
// their hits shaded as grids, the results kept as records that the statement's loop replays
// (docs/decisions.md#lights-run-once).
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"
#include "runtime/picture/shading/dome.h"
#include "runtime/picture/shading/hit_shader.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/picture/shading/rays/map_directions.h"
#include "runtime/picture/shading/rays/map_tables.h"
#include "runtime/scene/images/map_light.h"

namespace kinora {

namespace {

constexpr uint32_t kMostDepth = 64;  // of --rays

// Columns of a grid that "primitive:" results show.
struct PrimitiveRow {
    std::string_view name;
    uint16_t column;
    int components;
};
constexpr PrimitiveRow kPrimitive[] = {
    {"primitive:P", kColP, 3}, {"primitive:N", kColN, 3}, {"primitive:Ng", kColNg, 3},
    {"primitive:u", kColU, 1}, {"primitive:v", kColV, 1}, {"primitive:s", kColS, 1},
    {"primitive:t", kColT, 1},
};

const PrimitiveRow* find_primitive(std::string_view name) {
    for (const PrimitiveRow& row : kPrimitive)
        if (row.name == name) return &row;
    return nullptr;
}

bool any_of_surface(std::span<const GatherResult> results) {
    for (const GatherResult& result : results)
        if (result.name.starts_with("surface:") && result.name != "surface:P") return true;
    return false;
}

bool wants_color(std::span<const GatherResult> results) {
    return std::ranges::any_of(results, [](const auto& r) { return r.name == "surface:Ci"; });
}

// Rows of the service's arguments (rsl/model/services.def).
struct Row {
    enum { Request = 2, Level, P, D = 7, Angle = 10, Samples, Maxdist, Bias, Label, Flags, Map };
};

int flags_of(const Lanes& lanes) {  // the same for all
    return lanes.integer(Row::Flags, lanes.first());
}

// Over the hemisphere: a gather that sums diffuse light. Narrower ones are mirrors.
bool is_diffuse(const Lanes& lanes) {
    constexpr float kWide = 1.5f;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        if (lanes.asks(lane) && !(lanes.number(Row::Angle, lane) >= kWide)) return false;
    return true;
}

void copy_colors(std::span<const GatherResult> results, std::span<float* const> columns,
                 const raytrace::ShadeResult& from, size_t count) {
    size_t c = 0;
    for (const GatherResult& result : results) {
        bool Ci = result.name == "surface:Ci", Oi = result.name == "surface:Oi";
        for (size_t k = 0; k < 3 && (Ci || Oi); ++k)
            std::copy_n(Ci ? from.Ci[k] : from.Oi[k], count, columns[c + k]);
        c += size_t(rsl::component_count(result.type));
    }
}

// --clamp-indirect.
void dim(const Quality& quality, const RayTag& tag, raytrace::ShadeResult& result, size_t count) {
    if (!tag.scattered || quality.clamp_indirect == 0) return;
    for (size_t i = 0; i < count; ++i) {
        const vec3 color = dimmed(triple(result.Ci, i), quality.clamp_indirect);
        for (int k = 0; k < 3; ++k) result.Ci[k][i] = color[k];
    }
}

// What is known of a hit without its shader.
void fill_geometry(std::span<const GatherResult> results, std::span<float* const> columns,
                   const raytrace::HitBatch& hits, const ShadingFrame& frame,
                   ThreadMemory& memory) {
    bool wanted = false;
    for (const GatherResult& result : results)
        wanted |= result.name == "surface:P" || find_primitive(result.name);
    if (!wanted) return;
    static const ShaderInstance plain;  // no parameters, so that hits of all looks go together
    for (size_t begin = 0; begin < hits.count; begin += kGridPoints) {
        Arena::Mark mark = memory.arena.mark();
        size_t n = std::min(kGridPoints, hits.count - begin);
        std::span<uint32_t> points = memory.arena.allocate_span<uint32_t>(n);
        for (size_t i = 0; i < n; ++i) points[i] = uint32_t(begin + i);
        Grid grid(frame, memory, hits, points, &plain);
        grid.columns = memory.arena.allocate_span<float*>(kColVarying);
        std::fill(grid.columns.begin(), grid.columns.end(), nullptr);
        auto row_of = [](const GatherResult& result) {
            return find_primitive(result.name == "surface:P" ? "primitive:P" : result.name);
        };
        for (const GatherResult& result : results)
            if (const PrimitiveRow* row = row_of(result))
                for (int k = 0; k < row->components; ++k) {
                    uint16_t column = uint16_t(row->column + k);
                    want_columns(grid, {&column, 1});
                }
        gather(grid);
        size_t c = 0;
        for (const GatherResult& result : results) {
            if (const PrimitiveRow* row = row_of(result))
                for (size_t k = 0; k < size_t(row->components); ++k)
                    std::copy_n(grid.columns[row->column + k], n, columns[c + k] + begin);
            c += size_t(rsl::component_count(result.type));
        }
        memory.arena.release(mark);
    }
}

}  // namespace

// One call of the service: what its rays meet goes into its records.
class GatherRays::Call {
  public:
    Call(GatherRays& all, Grid& grid, const Lanes& lanes, const RayPlan& plan,
         std::span<const GatherResult> results, GatherRecords& records);
    // Lanes whose rays go in many directions.
    uint32_t scattered() const;
    // Marks the records that a lane has no sample for.
    void mark_absent(int most);
    // Where a lane sent fewer rays than it has samples, these share them: sums and means over the
    // samples are what so few would give.
    void repeat_samples();
    void add(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot);
    void meet(const SampleSpan& samples, const raytrace::RayBatch& rays,
              const raytrace::HitBatch& hits, const RayTag& tag);

    // Rays that leave the scene meet what surrounds it where the statement takes a color.
    void meet_dome(const SampleSpan& samples, const raytrace::RayBatch& rays,
                   const raytrace::HitBatch& hits, const RayTag& tag);

  private:
    // A sample's ray: none, one of its lane's cone, or one with a direction of its own.
    enum class Sent : uint8_t { Not, InCone, Alone };
    void set_lanes();
    // Records of a lane; its rays are fewer where its budget is low.
    int samples(int lane) const {
        return plan_.count[lane] ? lanes_.samples(Row::Samples, lane) : 0;
    }
    void record(const SampleSpan& planned, std::span<Sent> sent, std::span<vec3> way);
    void add_along(raytrace::RayBatch& rays, int lane, uint32_t k, vec3 direction, uint32_t slot);
    // Of the hits: what the statement's results take from them.
    std::span<float*> columns_of(const raytrace::HitBatch& hits, const RayTag& tag, Arena& arena);

    GatherRays& all_;
    Grid& grid_;
    const Lanes& lanes_;
    const RayPlan& plan_;
    std::span<const GatherResult> results_;
    GatherRecords& records_;
    std::span<const RayColumn> of_ray_;
    bool weighs_;  // by solid angles; else all directions may count alike, and stay even
    LaneRays made_;
};

void GatherRays::begin_frame(size_t threads) {
    memories_.resize(std::max(memories_.size(), threads));
}

GatherMemory& GatherRays::records_of(const Grid& grid, int nesting) {
    // A light may run within a turn of the gather of the surface it lights.
    uint32_t room =
        grid.depth + (grid.look->kind == ShaderInstanceKind::Light ? kMostDepth + 1 : 0);
    auto& memories = memories_[grid.memory.number];
    size_t index = size_t(room) * rsl::kGatherLevels + size_t(nesting);
    while (memories.size() <= index) memories.push_back(std::make_unique<GatherMemory>());
    return *memories[index];
}

// Rays that cannot be shot meet nothing, and are left out where the statement has no use for that;
// where the budget is spent there are none.
int32_t GatherRays::gather(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    const int any = lanes.first(), level = lanes.integer(Row::Level, any), flags = flags_of(lanes);
    const auto& results = grid.look->lowered.gathers[size_t(lanes.integer(Row::Request, any))];
    const RayPlan plan = queue_.plan(RayKind::Gather, grid, lanes, [&](int lane) {
        const float length = glm::length(lanes.triple(Row::D, lane));
        const bool aims = length > 0 && length < kMiss;
        return RayWish{.samples = aims ? lanes.samples(Row::Samples, lane) : 0,
                       .shoots = !(flags & rsl::kGatherNoRays),
                       .unshot = !(flags & rsl::kGatherHitsOnly),
                       .turns = true};
    });
    int most = 0;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        if (plan.count[lane]) most = std::max(most, lanes.samples(Row::Samples, lane));
    const int32_t handle = int32_t(kGatherSets) + level;
    grid.record_sets[size_t(handle)] = {};
    if (most == 0) return handle;
    Arena::Mark mark = grid.memory.arena.mark();
    GatherMemory& memory = records_of(grid, level);
    GatherRecords records(memory, most, record_width(results), size_t(call.first));
    Call own(*this, grid, lanes, plan, results, records);
    own.mark_absent(most);
    queue_.send(
        {.kind = RayKind::Gather,
         .grid = grid,
         .lanes = lanes,
         .plan = plan,
         .label = Row::Label,
         .diffuse = is_diffuse(lanes),
         .scattered = own.scattered()},
        [&](raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
            own.add(rays, samples, slot);
        },
        MeetSamples([&](const SampleSpan& samples, const raytrace::RayBatch& rays,
                        const raytrace::HitBatch& hits, const RayTag& tag) {
            if (hits.count > 0) own.meet(samples, rays, hits, tag);
            own.meet_dome(samples, rays, hits, tag);
        }));
    own.repeat_samples();
    grid.memory.arena.release(mark);
    grid.record_sets[size_t(handle)] = {most, memory.records.data()};
    return handle;
}

GatherRays::Call::Call(GatherRays& all, Grid& grid, const Lanes& lanes, const RayPlan& plan,
                       std::span<const GatherResult> results, GatherRecords& records)
    : all_(all),
      grid_(grid),
      lanes_(lanes),
      plan_(plan),
      results_(results),
      records_(records),
      of_ray_(ray_columns(results, grid.memory.arena)),
      weighs_(std::ranges::any_of(
          of_ray_, [](const RayColumn& c) { return c.fact == RayFact::SolidAngle; })),
      made_(grid, lanes, Row::P, Row::D, (flags_of(lanes) & rsl::kGatherCosine) != 0) {
    set_lanes();
}

uint32_t GatherRays::Call::scattered() const {
    uint32_t lanes = 0;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        lanes |= uint32_t(lanes_.asks(lane) && lanes_.number(Row::Angle, lane) > 0) << lane;
    return lanes;
}

void GatherRays::Call::mark_absent(int most) {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        for (int k = samples(lane); k < most; ++k)
            records_.at(uint32_t(k), rsl::kGatherState, lane) = jit::float_of(rsl::kGatherNone);
}

void GatherRays::Call::repeat_samples() {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        const uint32_t sent = uint32_t(plan_.count[lane]);
        for (uint32_t k = sent; k < uint32_t(samples(lane)); ++k) records_.copy(k % sent, k, lane);
    }
}

void GatherRays::Call::set_lanes() {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (plan_.count[lane] == 0) continue;
        const float angle = lanes_.number(Row::Angle, lane);
        const vec3 way = made_.way(lane);
        if (angle > 0)
            made_.set_cone(lane, angle, plan_.count[lane]);
        else
            made_.set_straight(lane, way / glm::length(way));
        made_.set_reach(lane, lanes_.number(Row::Maxdist, lane), lanes_.number(Row::Bias, lane));
        made_.set_budget(lane, plan_.share[lane], plan_.allowance[lane]);
    }
}

// First what is known of each ray goes into its record, then the rays that are sent are made: those
// of several lanes together.
void GatherRays::Call::add(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
    Arena& arena = grid_.memory.arena;
    Arena::Mark mark = arena.mark();
    std::span<Sent> sent = arena.allocate_span<Sent>(samples.size());
    std::span<vec3> way = arena.allocate_span<vec3>(weighs_ ? samples.size() : 0);
    for (size_t i = 0, n; i < samples.size(); i += n) {
        for (n = 1; i + n < samples.size() && samples.lane[i + n] == samples.lane[i];) ++n;
        record(samples.subspan(i, n), sent.subspan(i, n), weighs_ ? way.subspan(i, n) : way);
    }
    for (size_t i = 0, n; i < samples.size(); i += n) {
        for (n = 1; i + n < samples.size() && sent[i + n] == sent[i];) ++n;
        if (sent[i] == Sent::InCone) made_.add(rays, samples.subspan(i, n), slot + uint32_t(i));
        for (size_t j = i; sent[i] == Sent::Alone && j < i + n; ++j)
            add_along(rays, samples.lane[j], samples.number[j], way[j], slot + uint32_t(j));
    }
    arena.release(mark);
}

// Of samples of one lane: their rays as far as they are known, how they are sent and whither those
// go that do not go as LaneRays would have them.
void GatherRays::Call::record(const SampleSpan& planned, std::span<Sent> sent,
                              std::span<vec3> way) {
    const int lane = planned.lane[0];
    const int32_t map = lanes_.integer(Row::Map, lane);
    const bool shoots = plan_.share[lane] > 0;
    std::fill(sent.begin(), sent.end(), shoots ? Sent::InCone : Sent::Not);
    if (!map && of_ray_.empty()) return;
    const int n = plan_.count[lane];
    const uint32_t hit = grid_.points[std::min(lanes_.point(lane), grid_.count() - 1)];
    const raytrace::SampleSeries series = series_of(grid_, lanes_, lane, grid_.hits, hit);
    const Cone cone = made_.cone(lane);
    const bool by_brightness = map && weighs_ && !cone.by_cosine && cone.cosine < 0.999f;
    const MapDirections over(cone, by_brightness ? all_.maps_.find(map) : nullptr, series.seed);
    for (size_t i = 0; i < planned.size(); ++i) {
        const uint32_t k = planned.number[i];
        const vec3 dir = by_brightness ? over.direction(series.part * uint32_t(n) + k)
                                       : made_.direction(lane, k);
        RayFacts facts{lanes_.triple(Row::P, lane), all_.frame_.camera_from_accel * dir,
                       lanes_.number(Row::Maxdist, lane)};
        if (by_brightness) way[i] = dir;
        if (by_brightness && shoots) sent[i] = Sent::Alone;
        if (map) facts.solid_angle = over.solid_angle(dir, n);
        if (by_brightness && facts.solid_angle == 0) {
            records_.at(k, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherNone);
            sent[i] = Sent::Not;
            continue;
        }
        if (map) light_of_map(*all_.frame_.resources.textures, map, {&dir, 1}, &facts.map_color);
        facts.solid_angle *= float(n) / float(samples(lane));  // records share the n rays
        record_ray(records_, of_ray_, k, lane, facts);
    }
}

void GatherRays::Call::add_along(raytrace::RayBatch& rays, int lane, uint32_t k, vec3 direction,
                                 uint32_t slot) {
    const RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(Row::P, lane));
    add_ray(rays, grid_, start, direction, lanes_.number(Row::Maxdist, lane),
            lanes_.number(Row::Bias, lane), raytrace::hash(lanes_.seed(lane), k), slot);
    rays.share[rays.count - 1] = plan_.share[lane];
    rays.allowance[rays.count - 1] = plan_.allowance[lane];
    spread_ray(rays, grid_, *start.hits, start.hit);
}

// Origin, direction and what else stands already have no column.
std::span<float*> GatherRays::Call::columns_of(const raytrace::HitBatch& hits, const RayTag& tag,
                                               Arena& arena) {
    const size_t room = padded(hits.count);
    std::span<float*> columns =
        arena.allocate_span<float*>(size_t(record_width(results_) - rsl::kGatherResults));
    for (float*& column : columns) {
        column = arena.allocate_span<float>(room).data();
        std::fill_n(column, room, 0.0f);
    }
    if (any_of_surface(results_)) {
        raytrace::ShadeResult result = take_colors(arena, hits.count);
        HitOutputs outputs{results_, columns};
        all_.hits_.shade(hits, tag, grid_.memory, result, &outputs);
        dim(all_.frame_.quality, tag, result, hits.count);
        copy_colors(results_, columns, result, hits.count);
    }
    fill_geometry(results_, columns, hits, all_.frame_, grid_.memory);
    size_t at = 0;
    for (const GatherResult& result : results_) {
        size_t width = size_t(rsl::component_count(result.type));
        if (result.name == "ray:length")
            std::copy_n(hits.t, hits.count, columns[at]);
        else if (result.name.starts_with("ray:"))
            for (size_t k = 0; k < width; ++k) columns[at + k] = nullptr;
        at += width;
    }
    return columns;
}

void GatherRays::Call::meet(const SampleSpan& samples, const raytrace::RayBatch& rays,
                            const raytrace::HitBatch& hits, const RayTag& tag) {
    std::span<float*> columns = columns_of(hits, tag, grid_.memory.arena);
    for (size_t h = 0; h < hits.count; ++h) {
        uint32_t slot = rays.slot[hits.ray[h]];
        uint32_t record = samples.number[slot];
        int lane = samples.lane[slot];
        records_.at(record, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherHit);
        for (size_t c = 0; c < columns.size(); ++c)
            if (columns[c]) records_.at(record, rsl::kGatherResults + int(c), lane) = columns[c][h];
    }
}

// Its light is there without end: no other result has a value.
void GatherRays::Call::meet_dome(const SampleSpan& samples, const raytrace::RayBatch& rays,
                                 const raytrace::HitBatch& hits, const RayTag& tag) {
    if (!all_.hits_.dome().is_seen(tag) || !wants_color(results_)) return;
    ThreadMemory& memory = grid_.memory;
    NestedWavefront nested(memory);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& ends =
        raytrace::missed(rays, hits, all_.frame_.miss_distance, nested->hits);
    raytrace::ShadeResult seen = take_colors(memory.arena, ends.count);
    all_.hits_.shade_misses(ends, tag, memory, seen);
    for (size_t k = 0; k < ends.count; ++k) {
        if (rays.tfar[ends.ray[k]] < kMiss / 10) continue;
        const uint32_t slot = rays.slot[ends.ray[k]], record = samples.number[slot];
        const int lane = samples.lane[slot];
        records_.at(record, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherHit);
        int column = rsl::kGatherResults;
        for (const GatherResult& result : results_) {
            const int width = rsl::component_count(result.type);
            const bool color = result.name == "surface:Ci";
            for (int c = 0; c < width && !result.name.starts_with("ray:"); ++c)
                records_.at(record, column + c, lane) = color ? seen.Ci[c][k] : 0.0f;
            if (result.name == "ray:length") records_.at(record, column, lane) = kMiss;
            column += width;
        }
    }
}

}  // namespace kinora
