// runtime/picture/shading/lighting/asked_records.cpp: the services `lights` and `samplinglights`:
// records at other points than the grid's own, and along directions that a material has chosen.
#include <algorithm>

#include "runtime/picture/shading/lighting/chosen_directions.h"
#include "runtime/picture/shading/lighting/light_records.h"

namespace kinora {

namespace {

// A part of the grid asks: one lane group at its own points. Records of a group that is done are
// let go, or a marching loop would keep them all. The handle of the call's records.
uint32_t next_handle(Grid& grid, int32_t first) {
    Arena& arena = grid.memory.arena;
    if (grid.record_group != first) {
        if (grid.record_group >= 0) arena.release(grid.record_mark);
        grid.record_mark = arena.mark();
        grid.record_group = first;
        grid.record_calls = 0;
    }
    const uint32_t handle = grid.next_record_set;
    grid.next_record_set = handle + 1 < kGatherSets ? handle + 1 : 1;
    return handle;
}

}  // namespace

int32_t LightRecords::at(Grid& grid, const jit::ServiceCall& call) {
    const uint32_t handle = next_handle(grid, call.first);
    if (++grid.record_calls > kMostLightQuestions) {
        grid.memory.counters.unlit += 1;
        grid.record_sets[handle] = {};
    } else {
        grid.record_sets[handle] = make_records(grid, points_of(grid, call));
    }
    return int32_t(handle);
}

// ---- along directions ---------------------------------------------------------------------------

bool LightRecords::notes_directions(const Grid& grid) const {
    return grid.lit_points && grid.look->lowered.lit_by_samples &&
           (!sampling_.empty() || !area_lights_.all().empty());
}

void LightRecords::start_directions(Grid& grid) const {
    constexpr size_t kMostBytes = 16 << 20, kRecordBytes = 64 * sizeof(float);  // with its making
    if (!notes_directions(grid)) return;
    // Few of the lamps on geometry lie along one direction.
    const size_t lamps = sampling_.size() + std::min<size_t>(area_lights_.all().size(), 2);
    const size_t most = kMostBytes / (kRecordBytes * lamps * padded(grid.count()));
    Arena& arena = grid.memory.arena;
    grid.directions =
        new (arena.allocate(sizeof(DirectionNotes))) DirectionNotes(grid.count(), most, arena);
}

void LightRecords::answer_directions(Grid& grid) {
    StageScope stage(Stage::Lights);
    LightPoints at = *grid.lit_points;
    at.own = false;
    for (DirectionNotes::Round& round : grid.directions->rounds())
        round.answer = records_along(grid, at, round.directions);
    grid.directions->rewind();
}

jit::RecordSet LightRecords::records_along(Grid& grid, const LightPoints& at,
                                           const ChosenDirections& directions) {
    Arena& arena = grid.memory.arena;
    Making making{grid, at, arena.allocate_span<jit::Record>(sampling_.size()),
                  arena.allocate_span<SentLight>(1)};
    const Sphere lit = sphere_about(at.P, at.count);
    for (size_t l : sampling_)
        if (bindings_.binding(grid.look->index, l).seen && reaches(reaches_[l], lit))
            record_along(making, l, directions);
    lamps_along(making, directions);
    return {int32_t(making.record_count), making.records.data()};
}

int32_t LightRecords::along(Grid& grid, const jit::ServiceCall& call) {
    const uint32_t handle = next_handle(grid, call.first);
    jit::RecordSet& records = grid.record_sets[handle];
    if (const jit::RecordSet* noted = grid.directions ? grid.directions->find(call) : nullptr) {
        records = *noted;
        return int32_t(handle);
    }
    const bool own = grid.lit_points && asks_at(*grid.lit_points, call);
    const LightPoints at = own ? part_of(*grid.lit_points, call) : points_of(grid, call);
    records = records_along(grid, at, directions_of(call, grid.memory.arena));
    return int32_t(handle);
}

}  // namespace kinora
