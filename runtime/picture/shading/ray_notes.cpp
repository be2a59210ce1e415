// runtime/picture/shading/ray_notes.cpp: calls that send rays, noted so that rays of many points
// fill batches (docs/rays.md#full-packets).
#include <algorithm>

#include "runtime/picture/shading/ray_queue.h"

namespace kinora {

struct RayNotes::Note {
    const PicturePoints* points;  // of the surface
    const ShaderInstance* look;   // its own or a light's
    int32_t first;                // lane of the call
    uint32_t mask;
    int rows;
    const float* args;  // [row][lane]
    RayPlan plan;
    std::span<SeenByRay> seen;
    Note* next;
};

RayNotes::Batch::Batch(const RayTag& of, ThreadMemory& memory) : tag(of), wave(memory) {
    wave->rays.reserve(kGridPoints);
    wave->rays.count = 0;
}

void RayNotes::start() {
    open_ = true;
}

void RayNotes::finish() {
    for (auto& batch : batches_)
        if (batch) flush(*batch);
    open_ = false;
}

// Where too many tags take turns, the rays of the one that has most go first.
RayNotes::Batch& RayNotes::batch_of(const RayTag& tag) {
    Batch* fullest = nullptr;
    for (auto& batch : batches_) {
        if (!batch) batch.emplace(tag, memory_);
        if (batch->targets.empty())
            batch->targets = memory_.arena.allocate_span<SeenByRay*>(kGridPoints);
        if (batch->tag == tag) return *batch;
        if (!fullest || batch->wave->rays.count > fullest->wave->rays.count) fullest = &*batch;
    }
    flush(*fullest);
    fullest->tag = tag;
    return *fullest;
}

bool RayNotes::is_of(const Note* note, const Grid& grid) {
    return note && note->points == &grid.of_surface() && note->look == grid.look;
}

void RayNotes::answer(const Grid& grid) {
    for (next_ = first_; next_ && !is_of(next_, grid);) next_ = next_->next;
}

void RayNotes::reset() {
    first_ = last_ = next_ = nullptr;
    for (auto& batch : batches_)
        if (batch) batch->targets = {};
}

RayNotes::Note& RayNotes::add_note(const RayCall& call) {
    Arena& arena = memory_.arena;
    const size_t floats = size_t(call.rows) * jit::kMaxLanes;
    Note* note = arena.allocate_span<Note>(1).data();
    float* args = arena.allocate_span<float>(floats).data();
    std::copy_n(call.lanes.call().args, floats, args);
    const size_t rays = PlannedSamples(call.lanes, call.plan).count();
    *note = {&call.grid.of_surface(),
             call.grid.look,
             call.lanes.call().first,
             call.lanes.mask(),
             call.rows,
             args,
             call.plan,
             arena.allocate_span<SeenByRay>(rays),
             nullptr};
    (last_ ? last_->next : first_) = note;
    last_ = note;
    return *note;
}

void RayNotes::note(const RayCall& call, const RayTag& tag, const AddSamples& add) {
    SeenByRay* seen = add_note(call).seen.data();
    PlannedSamples planned(call.lanes, call.plan);
    uint8_t lane[kSixteen];
    uint32_t number[kSixteen];
    Batch& batch = batch_of(tag);
    raytrace::RayBatch& rays = batch.wave->rays;
    for (;;) {
        if (rays.count == kGridPoints) flush(batch);
        const size_t first = rays.count;
        const size_t n =
            planned.take(lane, number, std::min<size_t>(kSixteen, kGridPoints - first));
        if (n == 0) return;
        std::fill_n(seen, n, SeenByRay{});
        add(rays, {{lane, n}, {number, n}}, uint32_t(first));
        set_kind(rays, first, call.kind);
        for (size_t r = first; r < rays.count; ++r) {
            batch.targets[r] = seen + (rays.slot[r] - first);
            rays.slot[r] = uint32_t(r);
        }
        seen += n;
    }
}

std::optional<std::span<const SeenByRay>> RayNotes::find(const RayCall& call) {
    const jit::ServiceCall& asked = call.lanes.call();
    const Grid& grid = call.grid;
    while (is_of(next_, grid) && next_->first < asked.first) next_ = next_->next;
    for (Note* n = next_; is_of(n, grid) && n->first == asked.first; n = n->next) {
        const bool same = n->mask == call.lanes.mask() && n->rows == call.rows &&
                          same_rays(n->plan, call.plan) &&
                          same_arguments(n->args, asked.args, call.rows, n->mask);
        if (!same) continue;
        next_ = n->next;
        return n->seen;
    }
    return {};
}

void RayNotes::flush(Batch& batch) {
    raytrace::RayBatch& rays = batch.wave->rays;
    const size_t count = rays.count;
    if (count == 0) return;
    Arena::Mark mark = memory_.arena.mark();
    std::span<SeenByRay> seen = memory_.arena.allocate_span<SeenByRay>(count);
    queue_.see(rays, depth_, batch.tag, memory_, seen);
    for (size_t r = 0; r < count; ++r) *batch.targets[r] = seen[r];
    rays.count = 0;
    memory_.arena.release(mark);
}

}  // namespace kinora
