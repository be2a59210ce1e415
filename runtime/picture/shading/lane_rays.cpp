// runtime/picture/shading/lane_rays.cpp: the rays of a call's lanes: made sixteen at a time; calls
// noted, traced together and answered.
#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "raytrace/hits.h"
#include "runtime/picture/columns/kernels.h"
#include "runtime/picture/shading/nested_rays.h"
#include "runtime/picture/shading/volumes.h"
#include "runtime/scene/scene.h"

namespace kinora {

static_assert(kSixteen == jit::kMaxLanes);

namespace {

// Rows of RayLanes::carried.
enum Carried { kdOdx, kdOdy = 3, kPixelX = 6, kPixelY, kShare, kWeight, kMedium, kTnear, kTfar };
static_assert(kTfar + 1 == kCarried);

constexpr size_t kRowBytes = kSixteen * sizeof(float);

template <class Row>
void copy_row(const Row& from, void* to) {
    static_assert(sizeof(Row) == kRowBytes);
    std::memcpy(to, from, kRowBytes);
}

}  // namespace

LaneRays::LaneRays(const Grid& grid, const Lanes& lanes, int P, int way, bool by_cosine)
    : grid_(grid), lanes_(lanes), wants_{false, by_cosine, grid.memory.footprints} {
    find_hits(P);
    enter_hits();
    enter_starts(P);
    const mat3 accel_from_camera = glm::transpose(grid.frame.camera_from_accel);
    const float* rows = arguments(way);
    float* const axis[3] = {lane_.axis[0], lane_.axis[1], lane_.axis[2]};
    column_kernels().turn(&accel_from_camera[0][0], {{rows, rows + kSixteen, rows + 2 * kSixteen}},
                          axis);
    for (int lane = 0; lane < kSixteen; ++lane) {
        lane_.straight[lane] = 0;
        lane_.cosine[lane] = 1;
        const raytrace::SampleSeries own = series_of(grid, lanes, lane, *hits_[lane], hit_[lane]);
        lane_.seed[lane] = own.seed;
        part_[lane] = own.part;
        first_[lane] = 0;
    }
}

// The hits that the lanes' rays leave; lanes that do not ask have some hit, too.
void LaneRays::find_hits(int P) {
    for (int lane = 0; lane < kSixteen; ++lane) {
        const size_t point = std::min(lanes_.point(lane), grid_.count() - 1);
        hits_[lane] = &grid_.hits;
        hit_[lane] = grid_.points[point];
        if (!of_light() || !lanes_.asks(lane)) continue;
        const RayStart start = ray_start(grid_, point, lanes_.triple(P, lane));
        hits_[lane] = start.hits;
        hit_[lane] = start.hit;
    }
    dense_ = !of_light();
    for (uint32_t lane = 1; lane < uint32_t(kSixteen); ++lane)
        dense_ &= hit_[lane] == hit_[0] + lane;
}

// A light on geometry has hits of its own.
bool LaneRays::of_light() const {
    return grid_.lit && &grid_.lit->hits != &grid_.hits;
}

void LaneRays::enter_hits() {
    auto enter = [&](auto&& column_of, void* to) {
        if (dense_) {
            std::memcpy(to, column_of(grid_.hits) + hit_[0], kRowBytes);
            return;
        }
        for (size_t i = 0; i < kSixteen; ++i)
            std::memcpy(static_cast<std::byte*>(to) + i * sizeof(float),
                        column_of(*hits_[i]) + hit_[i], sizeof(float));
    };
    using Hits = raytrace::HitBatch;
    for (size_t k = 0; k < 3; ++k) {
        enter([k](const Hits& h) { return h.P[k]; }, lane_.P[k]);
        enter([k](const Hits& h) { return h.P_error[k]; }, lane_.error[k]);
        enter([k](const Hits& h) { return h.Ng[k]; }, lane_.Ng[k]);
        if (!wants_.spreads) continue;
        enter([k](const Hits& h) { return h.Ng[k]; }, lane_.in_Ng[k]);
        enter([k](const Hits& h) { return h.dir[k]; }, lane_.in[k]);
        enter([k](const Hits& h) { return h.dDdx[k]; }, lane_.dDdx[k]);
        enter([k](const Hits& h) { return h.dDdy[k]; }, lane_.dDdy[k]);
        enter([k](const Hits& h) { return h.dPdx[k]; }, lane_.carried[kdOdx + k]);
        enter([k](const Hits& h) { return h.dPdy[k]; }, lane_.carried[kdOdy + k]);
    }
    if (wants_.spreads) enter_bends();
    enter([](const Hits& h) { return h.pixel_x; }, lane_.carried[kPixelX]);
    enter([](const Hits& h) { return h.pixel_y; }, lane_.carried[kPixelY]);
    for (int lane = 0; lane < kSixteen; ++lane) {
        const raytrace::RayBatch* rays = hits_[lane]->rays;
        const uint32_t ray = hits_[lane]->ray[hit_[lane]];
        set_weight(lane, rays ? rays->weight[ray] : 1.0f);
        lane_.carried[kMedium][lane] = rays ? rays->medium[ray] : 0;
    }
}

void LaneRays::enter_bends() {
    SmoothSurface surface(grid_.scene, grid_.pose);
    for (int lane = 0; lane < kSixteen; ++lane) {
        vec3 x(0.0f), y(0.0f);
        const bool asks = lanes_.asks(lane) && on_surface(grid_);
        if (asks) surface.bend_at(*hits_[lane], hit_[lane], x, y);
        for (int k = 0; k < 3; ++k) lane_.dNdx[k][lane] = x[k], lane_.dNdy[k][lane] = y[k];
    }
}

void LaneRays::enter_starts(int P) {
    if (!of_light()) {
        float at[3][kSixteen];
        std::memcpy(at, arguments(P), sizeof(at));
        ray_kernels().start(&grid_.frame.camera_from_accel[0][0], &grid_.frame.eye.x, at, lane_);
        return;
    }
    for (int lane = 0; lane < kSixteen; ++lane) {
        if (!lanes_.asks(lane)) continue;
        const RayStart start = ray_start(grid_, lanes_.point(lane), lanes_.triple(P, lane));
        for (int k = 0; k < 3; ++k) {
            lane_.P[k][lane] = start.P[k];
            lane_.error[k][lane] = start.error[k];
            lane_.Ng[k][lane] = start.Ng[k];
        }
    }
}

const float* LaneRays::arguments(int row) const {
    return lanes_.call().args + size_t(row) * kSixteen;
}

vec3 LaneRays::way(int lane) const {
    return {lane_.axis[0][lane], lane_.axis[1][lane], lane_.axis[2][lane]};
}

void LaneRays::set_straight(int lane, vec3 unit) {
    for (int k = 0; k < 3; ++k) lane_.axis[k][lane] = unit[k];
    lane_.straight[lane] = 1;
    first_[lane] = part_[lane];
}

void LaneRays::set_cone(int lane, float angle, int samples) {
    first_[lane] = part_[lane] * uint32_t(samples);
    grid_.note_random();
    if (!wants_.cones || angle != angle_)
        cosine_ = Cone(vec3(0, 0, 1), angle, wants_.by_cosine).cosine;
    angle_ = angle;
    wants_.cones = true;
    lane_.cosine[lane] = cosine_;
    lane_.straight[lane] = 0;
}

void LaneRays::set_reach(int lane, float tfar, float bias, float share) {
    if (tfar >= kMiss) tfar = std::numeric_limits<float>::infinity();
    lane_.carried[kTfar][lane] = std::bit_cast<uint32_t>(tfar);
    lane_.carried[kTnear][lane] = std::bit_cast<uint32_t>(bias > 0 ? bias : 0.0f);
    lane_.carried[kShare][lane] = std::bit_cast<uint32_t>(share);
}

void LaneRays::set_weight(int lane, float weight) {
    lane_.carried[kWeight][lane] = std::bit_cast<uint32_t>(weight);
}

void LaneRays::aim() {
    if (!std::exchange(aimed_, true)) ray_kernels().aim(lane_);
}

vec3 LaneRays::direction(int lane, uint32_t k) {
    if (lane_.straight[lane]) return way(lane);
    k += first_[lane];
    if (lane != lane_made_ || k / kSixteen != block_made_) {
        lane_made_ = lane;
        block_made_ = k / kSixteen;
        ray_kernels().directions(cone(lane), block_made_ * kSixteen, lane_.seed[lane], made_);
    }
    const size_t i = k % kSixteen;
    return {made_[0][i], made_[1][i], made_[2][i]};
}

Cone LaneRays::cone(int lane) {
    aim();
    auto at = [lane](const float(&rows)[3][kSixteen]) {
        return vec3(rows[0][lane], rows[1][lane], rows[2][lane]);
    };
    Cone cone;
    cone.x = at(lane_.x), cone.y = at(lane_.y), cone.z = at(lane_.z);
    cone.cosine = lane_.cosine[lane];
    cone.by_cosine = wants_.by_cosine;
    return cone;
}

void LaneRays::add(raytrace::RayBatch& rays, const SampleSpan& samples, uint32_t slot) {
    if (wants_.cones) aim();
    RaySamples sixteen;
    for (size_t first = 0, count; first < samples.size(); first += count) {
        count = std::min(samples.size() - first, size_t(kSixteen));
        for (size_t i = 0; i < kSixteen; ++i) {
            const size_t from = first + std::min(i, count - 1);
            sixteen.lane[i] = samples.lane[from];
            sixteen.number[i] = first_[sixteen.lane[i]] + samples.number[from];
        }
        put(rays, sixteen, count, slot + uint32_t(first));
    }
}

// Whole rows of sixteen; what is written behind the last ray is overwritten by the next ones, or
// padding (RayBatch has room for it).
void LaneRays::put(raytrace::RayBatch& rays, const RaySamples& samples, size_t count,
                   uint32_t slot) {
    SixteenRays made;
    ray_kernels().shoot(lane_, samples, wants_, made);
    const size_t at = rays.count;
    for (size_t k = 0; k < 3; ++k) {
        copy_row(made.dir[k], rays.dir[k] + at);
        copy_row(made.org[k], rays.org[k] + at);
        copy_row(made.org[k], rays.first_org[k] + at);
        if (!wants_.spreads) continue;
        copy_row(made.carried[kdOdx + k], rays.dOdx[k] + at);
        copy_row(made.carried[kdOdy + k], rays.dOdy[k] + at);
        copy_row(made.dDdx[k], rays.dDdx[k] + at);
        copy_row(made.dDdy[k], rays.dDdy[k] + at);
    }
    copy_row(made.path, rays.sample + at);
    copy_row(made.carried[kPixelX], rays.pixel_x + at);
    copy_row(made.carried[kPixelY], rays.pixel_y + at);
    copy_row(made.carried[kShare], rays.share + at);
    copy_row(made.carried[kWeight], rays.weight + at);
    copy_row(made.carried[kMedium], rays.medium + at);
    copy_row(made.carried[kTnear], rays.tnear + at);
    copy_row(made.carried[kTfar], rays.tfar + at);
    for (float* column : {rays.time, rays.t_passed}) std::fill_n(column + at, kSixteen, 0.0f);
    for (uint32_t* column : {rays.layer, rays.turns, rays.spent})
        std::fill_n(column + at, kSixteen, 0u);
    for (uint32_t i = 0; i < uint32_t(kSixteen); ++i) rays.slot[at + i] = slot + i;
    if (!grid_.scene.volumes.empty())
        for (size_t i = 0; i < count; ++i) {
            const uint32_t lane = samples.lane[i];
            rays.medium[at + i] =
                nested_medium(grid_.scene, *hits_[lane], hit_[lane], triple(rays.dir, at + i));
        }
    rays.count += count;
}

// ---- calls that are noted
// -------------------------------------------------------------------------

struct RayCollector::Call {
    const Grid* grid;
    int32_t first;
    uint32_t mask;
    int rows;
    const float* args;  // [row][lane]
    RayPlan plan;
    std::span<SeenByRay> seen;
    Call* next;
};

namespace {

// Whether the lanes of the mask ask the same, bit for bit.
bool same_arguments(const float* a, const float* b, int rows, uint32_t mask) {
    if (std::memcmp(a, b, size_t(rows) * kRowBytes) == 0) return true;
    uint32_t differs[jit::kMaxLanes] = {};
    for (int row = 0; row < rows; ++row, a += jit::kMaxLanes, b += jit::kMaxLanes)
        for (int lane = 0; lane < jit::kMaxLanes; ++lane)
            differs[lane] |= uint32_t(jit::bits_of(a[lane]) ^ jit::bits_of(b[lane]));
    for (; mask; mask &= mask - 1)
        if (differs[std::countr_zero(mask)]) return false;
    return true;
}

bool same_rays(const RayPlan& a, const RayPlan& b) {
    if (std::memcmp(&a, &b, sizeof(a)) == 0) return true;  // as in most calls
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (a.count[lane] != b.count[lane]) return false;
        if (a.count[lane] == 0) continue;
        if (a.share[lane] != b.share[lane] || a.way[lane].weight != b.way[lane].weight)
            return false;
    }
    return true;
}

}  // namespace

void RayCollector::start() {
    collecting_ = true;
    batch_->rays.reserve(kGridPoints);
    batch_->rays.count = 0;
    targets_ = memory_.arena.allocate_span<SeenByRay*>(kGridPoints);
}

void RayCollector::finish() {
    flush();
    collecting_ = false;
}

void RayCollector::answer(const Grid& grid) {
    for (next_ = first_; next_ && next_->grid != &grid;) next_ = next_->next;
}

void RayCollector::reset() {
    first_ = last_ = next_ = nullptr;
}

std::span<SeenByRay> RayCollector::note(const Grid& grid, const Lanes& lanes, int rows,
                                        const RayPlan& plan) {
    Arena& arena = memory_.arena;
    size_t floats = size_t(rows) * jit::kMaxLanes, rays = 0;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane)
        if (lanes.asks(lane)) rays += size_t(plan.count[lane]);
    Call* call = arena.allocate_span<Call>(1).data();
    float* args = arena.allocate_span<float>(floats).data();
    std::copy_n(lanes.call().args, floats, args);
    *call = {&grid,
             lanes.call().first,
             lanes.mask(),
             rows,
             args,
             plan,
             arena.allocate_span<SeenByRay>(rays),
             nullptr};
    (last_ ? last_->next : first_) = call;
    last_ = call;
    return call->seen;
}

raytrace::RayBatch& RayCollector::batch(const RayTag& tag) {
    raytrace::RayBatch& rays = batch_->rays;
    bool alike = tag.kind == tag_.kind && tag.label == tag_.label &&
                 tag.specular == tag_.specular && tag.diffuse == tag_.diffuse;
    if (!alike || rays.count == kGridPoints) flush();
    tag_ = tag;
    return rays;
}

std::optional<std::span<const SeenByRay>> RayCollector::find(const Grid& grid, const Lanes& lanes,
                                                             int rows, const RayPlan& plan) {
    const jit::ServiceCall& asked = lanes.call();
    while (next_ && next_->grid == &grid && next_->first < asked.first) next_ = next_->next;
    for (Call* c = next_; c && c->grid == &grid && c->first == asked.first; c = c->next) {
        bool same = c->mask == lanes.mask() && c->rows == rows && same_rays(c->plan, plan) &&
                    same_arguments(c->args, asked.args, rows, c->mask);
        if (!same) continue;
        next_ = c->next;
        return c->seen;
    }
    return {};
}

void RayCollector::flush() {
    raytrace::RayBatch& rays = batch_->rays;
    size_t count = rays.count;
    if (count == 0) return;
    Arena::Mark mark = memory_.arena.mark();
    std::span<SeenByRay> seen = memory_.arena.allocate_span<SeenByRay>(count);
    nested_.see(rays, depth_, tag_, memory_, seen);
    for (size_t r = 0; r < count; ++r) *targets_[r] = seen[r];
    rays.count = 0;
    memory_.arena.release(mark);
}

void RayCollector::expect(size_t first, SeenByRay* seen) {
    raytrace::RayBatch& rays = batch_->rays;
    for (size_t r = first; r < rays.count; ++r) {
        targets_[r] = seen + (rays.slot[r] - first);
        rays.slot[r] = uint32_t(r);
    }
}

namespace {

// The samples of a plan in their order.
class PlannedSamples {
  public:
    PlannedSamples(const Lanes& lanes, const RayPlan& plan) : lanes_(lanes), plan_(plan) {}
    // Up to `room` of those left; none at the end.
    size_t take(uint8_t* lane, uint32_t* number, size_t room) {
        size_t count = 0;
        while (lane_ < jit::kMaxLanes) {
            const uint32_t all = lanes_.asks(lane_) ? uint32_t(plan_.count[lane_]) : 0u;
            for (; next_ < all && count < room; ++next_, ++count) {
                lane[count] = uint8_t(lane_);
                number[count] = next_;
            }
            if (next_ < all) break;
            next_ = 0;
            ++lane_;
        }
        return count;
    }

  private:
    const Lanes& lanes_;
    const RayPlan& plan_;
    int lane_ = 0;
    uint32_t next_ = 0;
};

void note_samples(RayCollector& collector, PlannedSamples& planned, SeenByRay* seen,
                  const RayTag& tag, const AddSamples& add) {
    uint8_t lane_of[kSixteen];
    uint32_t number_of[kSixteen];
    for (;;) {
        raytrace::RayBatch& rays = collector.batch(tag);
        const size_t n =
            planned.take(lane_of, number_of, std::min<size_t>(kSixteen, collector.room()));
        if (n == 0) return;
        const size_t before = rays.count;
        std::fill_n(seen, n, SeenByRay{});
        add(rays, {{lane_of, n}, {number_of, n}}, uint32_t(before));
        collector.expect(before, seen);
        seen += n;
    }
}

}  // namespace

void see_samples(Grid& grid, const Lanes& lanes, int rows, const RayPlan& plan, const RayTag& tag,
                 NestedRays& nested, const AddSamples& add, const SumSamples& sum) {
    RayCollector* collector = grid.collector;
    PlannedSamples planned(lanes, plan);
    if (collector && collector->collecting())
        return note_samples(*collector, planned, collector->note(grid, lanes, rows, plan).data(),
                            tag, add);
    Arena& arena = grid.memory.arena;
    Arena::Mark mark = arena.mark();
    std::span<uint8_t> lane_of = arena.allocate_span<uint8_t>(kGridPoints);
    std::span<uint32_t> number_of = arena.allocate_span<uint32_t>(kGridPoints);
    auto take = [&] {
        const size_t n = planned.take(lane_of.data(), number_of.data(), kGridPoints);
        return SampleSpan{lane_of.first(n), number_of.first(n)};
    };
    auto found = collector ? collector->find(grid, lanes, rows, plan) : std::nullopt;
    if (found) {
        size_t first = 0;
        for (SampleSpan samples = take(); samples.size() > 0; samples = take()) {
            sum(samples, found->subspan(first, samples.size()));
            first += samples.size();
        }
    } else {
        std::span<SeenByRay> seen = arena.allocate_span<SeenByRay>(kGridPoints);
        NestedWavefront batch(grid.memory);
        raytrace::RayBatch& rays = batch->rays;
        rays.reserve(kGridPoints);
        for (SampleSpan samples = take(); samples.size() > 0; samples = take()) {
            rays.count = 0;
            std::fill_n(seen.begin(), samples.size(), SeenByRay{});
            add(rays, samples, 0);
            nested.see(rays, grid.depth + 1, tag, grid.memory, seen);
            sum(samples, seen.first(samples.size()));
        }
    }
    arena.release(mark);
}

}  // namespace kinora
