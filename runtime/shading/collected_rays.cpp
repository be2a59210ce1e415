// runtime/shading/collected_rays.cpp: calls of ray services noted, traced together and answered.
#include <algorithm>
#include <cstring>

#include "runtime/shading/nested_rays.h"

namespace kinora {

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
    uint32_t differs[jit::kMaxLanes] = {};
    for (int row = 0; row < rows; ++row, a += jit::kMaxLanes, b += jit::kMaxLanes)
        for (int lane = 0; lane < jit::kMaxLanes; ++lane)
            differs[lane] |= uint32_t(jit::bits_of(a[lane]) ^ jit::bits_of(b[lane]));
    for (; mask; mask &= mask - 1)
        if (differs[std::countr_zero(mask)]) return false;
    return true;
}

bool same_rays(const RayPlan& a, const RayPlan& b) {
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

void see_samples(Grid& grid, const Lanes& lanes, int rows, const RayPlan& plan, const RayTag& tag,
                 NestedRays& nested, const AddSample& add, const SumSamples& sum) {
    RayCollector* collector = grid.collector;
    Arena& arena = grid.memory.arena;
    auto for_each_sample = [&](auto&& f) {
        for (int lane = 0; lane < jit::kMaxLanes; ++lane)
            for (int k = 0; lanes.asks(lane) && k < plan.count[lane]; ++k) f(lane, uint32_t(k));
    };
    if (collector && collector->collecting()) {
        SeenByRay* seen = collector->note(grid, lanes, rows, plan).data();
        for_each_sample([&](int lane, uint32_t k) {
            raytrace::RayBatch& rays = collector->batch(tag);
            size_t before = rays.count;
            *seen = {};
            add(rays, lane, k, uint32_t(before));
            if (rays.count > before) collector->expect(*seen);
            ++seen;
        });
        return;
    }
    Arena::Mark mark = arena.mark();
    std::span<uint8_t> lane_of = arena.allocate_span<uint8_t>(kGridPoints);
    std::span<uint32_t> number_of = arena.allocate_span<uint32_t>(kGridPoints);
    size_t filled = 0;
    auto found = collector ? collector->find(grid, lanes, rows, plan) : std::nullopt;
    if (found) {
        size_t first = 0;
        auto empty = [&] {
            sum(SampleSpan{lane_of.first(filled), number_of.first(filled)},
                found->subspan(first, filled));
            first += filled;
            filled = 0;
        };
        for_each_sample([&](int lane, uint32_t k) {
            lane_of[filled] = uint8_t(lane);
            number_of[filled] = k;
            if (++filled == kGridPoints) empty();
        });
        if (filled > 0) empty();
    } else {
        std::span<SeenByRay> seen = arena.allocate_span<SeenByRay>(kGridPoints);
        NestedWavefront batch(grid.memory);
        raytrace::RayBatch& rays = batch->rays;
        rays.reserve(kGridPoints);
        rays.count = 0;
        auto empty = [&] {
            nested.see(rays, grid.depth + 1, tag, grid.memory, seen);
            sum(SampleSpan{lane_of.first(filled), number_of.first(filled)}, seen.first(filled));
            rays.count = filled = 0;
        };
        for_each_sample([&](int lane, uint32_t k) {
            lane_of[filled] = uint8_t(lane);
            number_of[filled] = k;
            seen[filled] = {};
            add(rays, lane, k, uint32_t(filled));
            if (++filled == kGridPoints) empty();
        });
        if (filled > 0) empty();
    }
    arena.release(mark);
}

}  // namespace kinora
