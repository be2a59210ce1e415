// runtime/shading/gather_rays.cpp: the service gather: all rays of a statement at once, their hits
// shaded as grids, the results kept as records that the statement's loop replays
// (docs/decisions.md#lights-run-once).
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "raytrace/sampling.h"
#include "runtime/scene/scene.h"
#include "runtime/shading/hit_shader.h"
#include "runtime/shading/nested_rays.h"
#include "runtime/shading/ray_services.h"

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

// The rays of one batch: what they meet goes into their records.
struct GatherRays::Job {
    Grid& grid;
    std::span<const GatherResult> results;
    Records& records;
    std::span<const uint8_t> lane_of;
    std::span<const uint32_t> sample_of;
    int32_t label;
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
    int any = std::countr_zero(call.mask);
    const auto& results = grid.look->lowered.gathers[size_t(lanes.integer(Row::Request, any))];
    int level = lanes.integer(Row::Level, any), flags = lanes.integer(Row::Flags, any);
    bool shoots = !(flags & rsl::kGatherNoRays) && grid.shadows && grid.depth < frame_.ray_depth &&
                  !frame_.stopped();
    RayCounts counts = count_rays(grid, lanes, flags, shoots);
    if (is_noting(grid)) {  // its turns wait for the second run
        grid.record_sets[kGatherSets + size_t(level)] = {};
        return int32_t(kGatherSets) + level;
    }

    ThreadMemory& own = grid.memory;
    GatherMemory& memory = records_of(grid, level);
    Records records(memory, counts.most, record_width(results), size_t(call.first));
    Arena::Mark mark = own.arena.mark();
    std::span<const RayColumn> of_ray = ray_columns(results, own.arena);
    // Who takes no solid angles may count all directions alike: these stay even.
    bool weighs = std::ranges::any_of(
        of_ray, [](const RayColumn& c) { return c.fact == RayFact::SolidAngle; });
    NestedWavefront nested(own);
    raytrace::RayBatch& rays = nested->rays;
    rays.reserve(kGridPoints);
    rays.count = 0;
    uint8_t lane_of[kGridPoints];
    uint32_t sample_of[kGridPoints];
    int32_t label = 0;   // of the rays that wait
    size_t waiting = 0;  // rays from rays.count on are not yet made
    LaneRays made(grid, lanes, Row::P, Row::D, (flags & rsl::kGatherCosine) != 0);
    auto make = [&](size_t end) {
        const size_t first = rays.count, n = end - first;
        made.add(rays, {{lane_of + first, n}, {sample_of + first, n}}, uint32_t(first));
    };
    auto flush = [&] {
        const size_t n = std::exchange(waiting, 0);
        make(n);
        if (n > 0 && shoots)
            shade({grid, results, records, {lane_of, n}, {sample_of, n}, label}, rays);
        rays.count = 0;
    };
    // The sample that waits last, in a direction of its own.
    auto add_along = [&](int lane, uint32_t k, vec3 dir) {
        make(waiting - 1);
        const RayStart start = ray_start(grid, lanes.point(lane), lanes.triple(Row::P, lane));
        add_ray(rays, grid, start, dir, lanes.number(Row::Maxdist, lane),
                lanes.number(Row::Bias, lane), raytrace::hash(lanes.seed(lane), k),
                uint32_t(waiting - 1), counts.share[lane]);
        spread_ray(rays, grid, *start.hits, start.hit);
    };
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        for (int k = counts.samples[lane]; k < counts.most; ++k)
            records.at(uint32_t(k), rsl::kGatherState, lane) = jit::float_of(rsl::kGatherNone);
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (counts.samples[lane] == 0) continue;
        const float angle = lanes.number(Row::Angle, lane);
        const vec3 way = made.way(lane);
        if (angle > 0)
            made.set_cone(lane, angle);
        else
            made.set_straight(lane, way / glm::length(way));
        made.set_reach(lane, lanes.number(Row::Maxdist, lane), lanes.number(Row::Bias, lane),
                       counts.share[lane]);
    }
    lanes.for_each_text(Row::Label, [&](const Lanes& alike) {
        label = alike.integer(Row::Label, alike.first());
        for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
            int n = alike.asks(lane) ? counts.samples[lane] : 0;
            if (n == 0) continue;
            uint32_t seed = lanes.seed(lane);
            const float reach = lanes.number(Row::Maxdist, lane);
            vec3 P = lanes.triple(Row::P, lane);
            const Cone cone = made.cone(lane);
            int32_t map = lanes.integer(Row::Map, lane);
            bool by_brightness = map && weighs && !cone.by_cosine && cone.cosine < 0.999f;
            MapDirections over(cone, by_brightness ? table_of(map) : nullptr, n);
            for (uint32_t k = 0; k < uint32_t(n); ++k) {
                vec3 dir(0.0f);
                if (map || !of_ray.empty()) {
                    dir = by_brightness ? over.direction(k, seed) : made.direction(lane, k);
                    RayFacts facts{P, frame_.camera_from_accel * dir, reach};
                    if (map)
                        facts.solid_angle =
                            by_brightness ? over.solid_angle(dir) : solid_angle(cone, dir, n);
                    if (by_brightness && facts.solid_angle == 0) {
                        records.at(k, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherNone);
                        continue;
                    }
                    if (map)
                        light_of_map(*frame_.scene.textures, map, {&dir, 1},
                                     over.width(facts.solid_angle), &facts.map_color);
                    record_ray(records, of_ray, k, lane, facts);
                }
                if (counts.share[lane] == 0) continue;
                lane_of[waiting] = uint8_t(lane);
                sample_of[waiting++] = k;
                if (by_brightness) add_along(lane, k, dir);
                if (waiting == kGridPoints) flush();
            }
        }
        flush();
    });
    own.arena.release(mark);
    int32_t handle = int32_t(kGatherSets) + level;
    grid.record_sets[size_t(handle)] = {counts.most, memory.records.data()};
    return handle;
}

void GatherRays::shade(const Job& job, raytrace::RayBatch& rays) {
    Grid& grid = job.grid;
    ThreadMemory& own = grid.memory;
    Arena::Mark mark = own.arena.mark();
    NestedWavefront nested(own);
    nested->hits.reserve(kGridPoints);
    const raytrace::HitBatch& hits =
        raytrace::trace(frame_.scene.accel, rays, raytrace::kMaskAll, grid.depth + 1, nested->hits,
                        own.counters.trace);
    if (hits.count == 0) return;
    size_t components = 0;
    for (const GatherResult& result : job.results)
        components += size_t(rsl::component_count(result.type));
    std::span<float*> columns = own.arena.allocate_span<float*>(components);
    for (float*& column : columns) {
        column = own.arena.allocate_span<float>(padded(hits.count)).data();
        std::fill_n(column, padded(hits.count), 0.0f);
    }
    if (any_of_surface(job.results)) {
        raytrace::ShadeResult result = take_colors(own.arena, hits.count);
        HitOutputs outputs{job.results, columns};
        hits_.shade(hits, deeper(grid, RayKind::Specular, job.label), own, result, &outputs);
        copy_colors(job.results, columns, result, hits.count);
    }
    fill_geometry(job.results, columns, hits, frame_, own);
    // Origin and direction stand already.
    size_t at = 0;
    for (const GatherResult& result : job.results) {
        size_t width = size_t(rsl::component_count(result.type));
        bool length = result.name == "ray:length";
        if (length) std::copy_n(hits.t, hits.count, columns[at]);
        if (!length && result.name.starts_with("ray:"))
            for (size_t k = 0; k < width; ++k) columns[at + k] = nullptr;
        at += width;
    }
    for (size_t h = 0; h < hits.count; ++h) {
        uint32_t slot = rays.slot[hits.ray[h]];
        uint32_t record = job.sample_of[slot];
        int lane = job.lane_of[slot];
        job.records.at(record, rsl::kGatherState, lane) = jit::float_of(rsl::kGatherHit);
        for (size_t c = 0; c < components; ++c)
            if (columns[c])
                job.records.at(record, rsl::kGatherResults + int(c), lane) = columns[c][h];
    }
    own.arena.release(mark);
}

}  // namespace kinora
