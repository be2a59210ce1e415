// runtime/picture/shading/lighting/chosen_directions.cpp
#include "runtime/picture/shading/lighting/chosen_directions.h"

#include <algorithm>

#include "rsl/model/renderer_services.h"

namespace kinora {

namespace {

// Calls f(row of the call, row of the directions) for each.
template <class F>
void for_each_row(const jit::ServiceCall& call, const ChosenDirections& directions, F&& f) {
    constexpr auto row = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::samplinglights, name).first;
    };
    for (int k = 0; k < 3; ++k) f(call.args + (row("D") + k) * jit::kMaxLanes, directions.D[k]);
    f(call.args + row("density") * jit::kMaxLanes, directions.density);
    f(call.args + row("power") * jit::kMaxLanes, directions.power);
}

// None is asked at any point.
ChosenDirections no_directions(size_t points, Arena& arena) {
    ChosenDirections made;
    auto take = [&] {
        std::span<float> row = arena.allocate_span<float>(points);
        std::fill(row.begin(), row.end(), 0.0f);
        return row.data();
    };
    for (float*& row : made.D) row = take();
    made.density = take();
    made.power = take();
    return made;
}

// Those of the call's lanes that ask, from point `first` on.
void copy(const jit::ServiceCall& call, const ChosenDirections& to, size_t first) {
    for_each_row(call, to, [&](const float* from, float* row) {
        for (int lane = 0; lane < call.lanes; ++lane)
            if (call.mask >> lane & 1) row[first + size_t(lane)] = from[lane];
    });
}

}  // namespace

ChosenDirections directions_of(const jit::ServiceCall& call, Arena& arena) {
    const ChosenDirections made = no_directions(jit::kMaxLanes, arena);
    copy(call, made, 0);
    return made;
}

DirectionNotes::DirectionNotes(size_t points, size_t most, Arena& arena)
    : points_(jit::padded(points)), arena_(arena), rounds_(arena.allocate_span<Round>(most)) {}

size_t DirectionNotes::next_of(const jit::ServiceCall& call) {
    if (group_ != call.first) next_ = 0;
    group_ = call.first;
    return next_++;
}

void DirectionNotes::note(const jit::ServiceCall& call) {
    const size_t round = next_of(call);
    if (round >= rounds_.size()) return;
    if (round == count_) rounds_[count_++] = {no_directions(points_, arena_), {}};
    copy(call, rounds_[round].directions, size_t(call.first));
}

const jit::RecordSet* DirectionNotes::find(const jit::ServiceCall& call) {
    const size_t round = next_of(call);
    if (round >= count_) return nullptr;
    bool same = true;
    for_each_row(call, rounds_[round].directions, [&](const float* asked, const float* noted) {
        for (int lane = 0; lane < call.lanes; ++lane)
            if (call.mask >> lane & 1)
                same &= jit::bits_of(asked[lane]) == jit::bits_of(noted[call.first + lane]);
    });
    return same ? &rounds_[round].answer : nullptr;
}

}  // namespace kinora
