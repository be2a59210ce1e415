// runtime/picture/shading/gather_rays.cpp: the service gather: all rays of a statement at once,
// their hits shaded as grids, the results kept as records that the statement's loop replays
// (docs/decisions.md#lights-run-once).
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "raytrace/sampling.h"
#include "runtime/picture/shading/hit_shader.h"
#include "runtime/picture/shading/nested_rays.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

constexpr uint32_t kMostDepth = 64;  // of --rays
using GatherResult = rsl::LoweredShader::GatherResult;

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

// Results that are known before the ray is shot.
enum class RayFact : uint8_t { Origin, Direction, Length, MapColor, SolidAngle };
struct RayFactRow {
    std::string_view name;
    RayFact fact;
};
constexpr RayFactRow kRayFacts[] = {
    {"ray:origin", RayFact::Origin},          {"ray:direction", RayFact::Direction},
    {"ray:length", RayFact::Length},          {"environment:direction", RayFact::Direction},
    {"environment:color", RayFact::MapColor}, {"environment:solidangle", RayFact::SolidAngle},
};
struct RayColumn {
    RayFact fact;
    int column;
};
std::span<const RayColumn> ray_columns(std::span<const GatherResult> results, Arena& arena) {
    std::span<RayColumn> found = arena.allocate_span<RayColumn>(results.size());
    size_t count = 0;
    int column = rsl::kGatherResults;
    for (const GatherResult& result : results) {
        for (const RayFactRow& row : kRayFacts)
            if (row.name == result.name) found[count++] = {row.fact, column};
        column += rsl::component_count(result.type);
    }
    return found.first(count);
}

bool any_of_surface(std::span<const GatherResult> results) {
    for (const GatherResult& result : results)
        if (result.name.starts_with("surface:") && result.name != "surface:P") return true;
    return false;
}

// One statement's records: columns [record][state, results...][lane].
class Records {
  public:
    Records(GatherMemory& memory, int count, int width, size_t first)
        : memory_(memory), width_(width) {
        size_t columns = size_t(count) * size_t(width);
        memory.values.assign(columns * jit::kMaxLanes, 0.0f);
        memory.columns.resize(columns);
        memory.records.resize(size_t(count));
        for (size_t c = 0; c < columns; ++c)  // read at the grid's point: a part starts before it
            memory.columns[c] = memory.values.data() + c * jit::kMaxLanes - first;
        for (size_t r = 0; r < size_t(count); ++r)
            memory.records[r] = {memory.columns.data() + r * size_t(width), nullptr};
    }
    float& at(uint32_t record, int column, int lane) {
        return memory_.values[(size_t(record) * size_t(width_) + size_t(column)) * jit::kMaxLanes +
                              size_t(lane)];
    }
    void set(uint32_t record, int column, int lane, vec3 v) {
        for (int k = 0; k < 3; ++k) at(record, column + k, lane) = v[k];
    }

  private:
    GatherMemory& memory_;
    int width_;
};

// Rows of the service's arguments (rsl/model/services.def).
struct Row {
    enum { Request = 2, Level, P, D = 7, Angle = 10, Samples, Maxdist, Bias, Label, Flags, Map };
};

// The rays of one call at each lane: how many, and the share of the eye's ray that each has.
struct RayCounts {
    int samples[jit::kMaxLanes] = {};
    float share[jit::kMaxLanes] = {};  // 0: not shot
    int most = 0;                      // of any lane
};

// Rays that cannot be shot meet nothing, and are left out where the statement has no use for that;
// where the budget is spent there are none.
RayCounts count_rays(Grid& grid, const Lanes& lanes, int flags, bool shoots) {
    RayCounts counts;
    bool wants_rays = !(flags & rsl::kGatherNoRays), hits_only = flags & rsl::kGatherHitsOnly;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (!lanes.asks(lane)) continue;
        float length = glm::length(lanes.triple(Row::D, lane));
        if (!(length > 0 && length < kMiss)) continue;
        int n = counts.samples[lane] = lanes.samples(Row::Samples, lane);
        size_t point = lanes.point(lane);
        if (shoots) counts.share[lane] = ray_share(grid, point, n);
        if (counts.share[lane] > 0 ? !spend_rays(grid, point, n)
                                   : wants_rays && (!refuse_rays(grid, point, n) || hits_only))
            n = counts.samples[lane] = 0;
        counts.most = std::max(counts.most, n);
    }
    return counts;
}

int flags_of(const Lanes& lanes) {  // the same for all
    return lanes.integer(Row::Flags, lanes.first());
}

int record_width(std::span<const GatherResult> results) {
    int width = rsl::kGatherResults;
    for (const GatherResult& result : results) width += rsl::component_count(result.type);
    return width;
}

// A ray as its record shows it, in current space.
struct RayFacts {
    vec3 origin, direction;
    float length;  // until it is known to end earlier
    vec3 map_color{0.0f};
    float solid_angle = 0;  // that it stands for
};
void record_ray(Records& records, std::span<const RayColumn> columns, uint32_t record, int lane,
                const RayFacts& facts) {
    for (const RayColumn& c : columns) switch (c.fact) {
            case RayFact::Origin:
                records.set(record, c.column, lane, facts.origin);
                break;
            case RayFact::Direction:
                records.set(record, c.column, lane, facts.direction);
                break;
            case RayFact::Length:
                records.at(record, c.column, lane) = facts.length;
                break;
            case RayFact::MapColor:
                records.set(record, c.column, lane, facts.map_color);
                break;
            case RayFact::SolidAngle:
                records.at(record, c.column, lane) = facts.solid_angle;
                break;
        }
}

// The directions of one lane over a map: of n, every other one by the map's brightness where a
// table is given, the rest over the cone. The solid angle of each is 1 over the density of them all
// (E. Veach's balance heuristic), so sums over solid angles have the mean of even directions.
class MapDirections {
  public:
    MapDirections(const Cone& cone, const EnvironmentTable* table, int n)
        : cone_(cone), table_(n > 1 ? table : nullptr), of_table_(table_ ? n / 2 : 0), n_(n) {}

    vec3 direction(uint32_t k, uint32_t seed) const {
        if (!table_) return cone_.direction(k, seed);
        if (k % 2 == 0) return cone_.direction(k / 2, seed);
        return table_->direction(raytrace::stratified_sample(k / 2, raytrace::hash(seed, 1u)));
    }
    // 0: outside the cone.
    float solid_angle(vec3 d) const {
        if (table_ && glm::dot(d, cone_.z) < cone_.cosine) return 0;
        float density = float(n_ - of_table_) / (2 * float(kPi) * (1 - cone_.cosine));
        if (table_) density += float(of_table_) * table_->density(d);
        return 1 / density;
    }

    // Of a look at the map. One for all where densities differ: a wide look beside what is bright
    // would count it twice.
    float width(float solid_angle) const {
        return table_ ? EnvironmentTable::kWidth : std::sqrt(solid_angle);
    }

  private:
    const Cone& cone_;
    const EnvironmentTable* table_;
    int of_table_, n_;
};

// The solid angle that each of n directions of the cone stands for: 1 / (n density).
float solid_angle(const Cone& cone, vec3 direction, int n) {
    float c = cone.cosine;
    if (!cone.by_cosine) return 2 * float(kPi) * (1 - c) / float(n);
    float up = std::max(glm::dot(direction, cone.z), 1e-6f);
    return float(kPi) * (1 - c * c) / (up * float(n));
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

// One call of the service: its rays are made in batches, shot, and what they meet goes into its
// records.
class GatherRays::Call {
  public:
    Call(GatherRays& all, Grid& grid, const Lanes& lanes, const RayCounts& counts,
         std::span<const GatherResult> results, Records& records);
    // `shoots`: whether there are rays at all, or their facts alone.
    void run(bool shoots);

  private:
    void mark_absent();
    void set_lanes();
    void add_rays_of(int lane);
    // The rays that wait, up to the `end`-th, are made; those before are.
    void make(size_t end);
    // The sample that waits last, in a direction of its own.
    void make_last_along(int lane, uint32_t k, vec3 direction);
    void flush();
    // Of the hits: what the statement's results take from them.
    std::span<float*> columns_of(const raytrace::HitBatch& hits, Arena& arena);
    void shade();

    GatherRays& all_;
    Grid& grid_;
    const Lanes& lanes_;
    const RayCounts& counts_;
    std::span<const GatherResult> results_;
    Records& records_;
    std::span<const RayColumn> of_ray_;
    bool weighs_;  // by solid angles; else all directions may count alike, and stay even
    bool shoots_ = false;
    NestedWavefront nested_;
    LaneRays made_;
    uint8_t lane_of_[kGridPoints];
    uint32_t sample_of_[kGridPoints];
    int32_t label_ = 0;   // of the rays that wait
    size_t waiting_ = 0;  // rays from the batch's count on are not yet made
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

const EnvironmentTable* GatherRays::table_of(int32_t map) {
    std::lock_guard lock(tables_mutex_);
    auto found = tables_.find(map);
    if (found == tables_.end()) {
        std::vector<vec3> directions(EnvironmentTable::kCells), light(EnvironmentTable::kCells);
        for (uint32_t c = 0; c < EnvironmentTable::kCells; ++c)
            directions[c] = EnvironmentTable::middle(c);
        light_of_map(*frame_.scene.textures, map, directions, EnvironmentTable::kWidth,
                     light.data());
        std::vector<float> brightness;
        for (vec3 c : light) brightness.push_back(c.x + c.y + c.z);
        found = tables_.emplace(map, EnvironmentTable(brightness)).first;
    }
    return found->second.uneven() ? &found->second : nullptr;
}

int32_t GatherRays::gather(Grid& grid, const jit::ServiceCall& call) {
    Lanes lanes(call);
    const int any = lanes.first(), level = lanes.integer(Row::Level, any), flags = flags_of(lanes);
    const auto& results = grid.look->lowered.gathers[size_t(lanes.integer(Row::Request, any))];
    bool shoots = !(flags & rsl::kGatherNoRays) && grid.shadows &&
                  grid.depth < frame_.quality.ray_depth && !frame_.stopped();
    RayCounts counts = count_rays(grid, lanes, flags, shoots);
    if (is_noting(grid)) {  // its turns wait for the second run
        grid.record_sets[kGatherSets + size_t(level)] = {};
        return int32_t(kGatherSets) + level;
    }

    Arena::Mark mark = grid.memory.arena.mark();
    GatherMemory& memory = records_of(grid, level);
    Records records(memory, counts.most, record_width(results), size_t(call.first));
    Call(*this, grid, lanes, counts, results, records).run(shoots);
    grid.memory.arena.release(mark);
    int32_t handle = int32_t(kGatherSets) + level;
    grid.record_sets[size_t(handle)] = {counts.most, memory.records.data()};
    return handle;
}

GatherRays::Call::Call(GatherRays& all, Grid& grid, const Lanes& lanes, const RayCounts& counts,
                       std::span<const GatherResult> results, Records& records)
    : all_(all),
      grid_(grid),
      lanes_(lanes),
      counts_(counts),
      results_(results),
      records_(records),
      of_ray_(ray_columns(results, grid.memory.arena)),
      weighs_(std::ranges::any_of(
          of_ray_, [](const RayColumn& c) { return c.fact == RayFact::SolidAngle; })),
      nested_(grid.memory),
      made_(grid, lanes, Row::P, Row::D, (flags_of(lanes) & rsl::kGatherCosine) != 0) {
    nested_->rays.reserve(kGridPoints);
    nested_->rays.count = 0;
}

void GatherRays::Call::run(bool shoots) {
    shoots_ = shoots;
    mark_absent();
    set_lanes();
    lanes_.for_each_text(Row::Label, [&](const Lanes& alike) {
        label_ = alike.integer(Row::Label, alike.first());
        for (int lane = 0; lane < jit::kMaxLanes; ++lane)
            if (alike.asks(lane) && counts_.samples[lane] > 0) add_rays_of(lane);
        flush();
    });
}

void GatherRays::Call::mark_absent() {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        for (int k = counts_.samples[lane]; k < counts_.most; ++k)
            records_.at(uint32_t(k), rsl::kGatherState, lane) = jit::float_of(rsl::kGatherNone);
}

void GatherRays::Call::set_lanes() {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (counts_.samples[lane] == 0) continue;
        const float angle = lanes_.number(Row::Angle, lane);
        const vec3 way = made_.way(lane);
        if (angle > 0)
            made_.set_cone(lane, angle, counts_.samples[lane]);
        else
            made_.set_straight(lane, way / glm::length(way));
        made_.set_reach(lane, lanes_.number(Row::Maxdist, lane), lanes_.number(Row::Bias, lane),
                        counts_.share[lane]);
    }
}

void GatherRays::Call::add_rays_of(int lane) {
    const int n = counts_.samples[lane];
    const uint32_t hit = grid_.points[std::min(lanes_.point(lane), grid_.count() - 1)];
    const raytrace::SampleSeries series = series_of(grid_, lanes_, lane, grid_.hits, hit);
    const uint32_t first_sample = series.part * uint32_t(n);
    const vec3 P = lanes_.triple(Row::P, lane);
    const Cone cone = made_.cone(lane);
    const int32_t map = lanes_.integer(Row::Map, lane);
    const bool by_brightness = map && weighs_ && !cone.by_cosine && cone.cosine < 0.999f;
    const MapDirections over(cone, by_brightness ? all_.table_of(map) : nullptr, n);
    for (uint32_t k = 0; k < uint32_t(n); ++k) {
        vec3 dir(0.0f);
        if (map || !of_ray_.empty()) {
            dir = by_brightness ? over.direction(first_sample + k, series.seed)
                                : made_.direction(lane, k);
            RayFacts facts{P, all_.frame_.camera_from_accel * dir,
                           lanes_.number(Row::Maxdist, lane)};
            if (map)
                facts.solid_angle =
                    by_brightness ? over.solid_angle(dir) : solid_angle(cone, dir, n);
            if (by_brightness && facts.solid_angle == 0) {
                records_.at(k, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherNone);
                continue;
            }
            if (map)
                light_of_map(*all_.frame_.scene.textures, map, {&dir, 1},
                             over.width(facts.solid_angle), &facts.map_color);
            record_ray(records_, of_ray_, k, lane, facts);
        }
        if (counts_.share[lane] == 0) continue;
        lane_of_[waiting_] = uint8_t(lane);
        sample_of_[waiting_++] = k;
        if (by_brightness) make_last_along(lane, k, dir);
        if (waiting_ == kGridPoints) flush();
    }
}

void GatherRays::Call::make(size_t end) {
    raytrace::RayBatch& rays = nested_->rays;
    const size_t first = rays.count, n = end - first;
    made_.add(rays, {{lane_of_ + first, n}, {sample_of_ + first, n}}, uint32_t(first));
}

void GatherRays::Call::make_last_along(int lane, uint32_t k, vec3 direction) {
    make(waiting_ - 1);
    raytrace::RayBatch& rays = nested_->rays;
    const RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(Row::P, lane));
    add_ray(rays, grid_, start, direction, lanes_.number(Row::Maxdist, lane),
            lanes_.number(Row::Bias, lane), raytrace::hash(lanes_.seed(lane), k),
            uint32_t(waiting_ - 1), counts_.share[lane]);
    spread_ray(rays, grid_, *start.hits, start.hit);
}

void GatherRays::Call::flush() {
    make(waiting_);
    if (std::exchange(waiting_, 0) > 0 && shoots_) shade();
    nested_->rays.count = 0;
}

// Origin, direction and what else stands already have no column.
std::span<float*> GatherRays::Call::columns_of(const raytrace::HitBatch& hits, Arena& arena) {
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
        all_.hits_.shade(hits, deeper(grid_, RayKind::Specular, label_), grid_.memory, result,
                         &outputs);
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

void GatherRays::Call::shade() {
    ThreadMemory& own = grid_.memory;
    Arena::Mark mark = own.arena.mark();
    NestedWavefront below(own);
    below->hits.reserve(kGridPoints);
    const raytrace::RayBatch& rays = nested_->rays;
    const raytrace::HitBatch& hits =
        raytrace::trace(all_.frame_.pose.accel, nested_->rays, raytrace::kMaskAll, grid_.depth + 1,
                        below->hits, own.counters.trace);
    if (hits.count == 0) return;
    std::span<float*> columns = columns_of(hits, own.arena);
    for (size_t h = 0; h < hits.count; ++h) {
        uint32_t slot = rays.slot[hits.ray[h]];
        uint32_t record = sample_of_[slot];
        int lane = lane_of_[slot];
        records_.at(record, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherHit);
        for (size_t c = 0; c < columns.size(); ++c)
            if (columns[c]) records_.at(record, rsl::kGatherResults + int(c), lane) = columns[c][h];
    }
    own.arena.release(mark);
}

}  // namespace kinora
