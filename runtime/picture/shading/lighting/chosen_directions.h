// runtime/picture/shading/lighting/chosen_directions.h: directions that a material has chosen at
// lit points: what the service samplinglights is asked.
#pragma once

#include <span>

#include "jit/ir/kernel_call.h"
#include "runtime/base/arena.h"
#include "runtime/base/math.h"

namespace kinora {

// By point; rows are readable up to the points' padded number.
struct ChosenDirections {
    float* D[3];     // current space
    float* density;  // of the material's samples, by solid angle; 0: nothing is asked there
    float* power;    // of the heuristic that weighs them

    vec3 at(size_t i) const { return {D[0][i], D[1][i], D[2][i]}; }
};

// Of one call, its lanes being points.
ChosenDirections directions_of(const jit::ServiceCall& call, Arena& arena);

// Calls for the points of a grid, answered together. A kernel that calls runs twice: first its
// calls are noted, lane group by lane group, the first ones of all groups in one round, the next
// ones in another; then it gets the records that lights have made of the rounds. A call that was
// not noted, or with other arguments, has no answer here.
class DirectionNotes {
  public:
    struct Round {
        ChosenDirections directions;
        jit::RecordSet answer;
    };

    // Of so many points; calls beyond `most` rounds are not noted.
    DirectionNotes(size_t points, size_t most, Arena& arena);

    void note(const jit::ServiceCall& call);
    // Before the answers, and before the kernel's second run.
    std::span<Round> rounds() { return rounds_.first(count_); }
    void rewind() { group_ = -1; }
    // Null: none.
    const jit::RecordSet* find(const jit::ServiceCall& call);

  private:
    size_t next_of(const jit::ServiceCall& call);

    const size_t points_;
    Arena& arena_;
    std::span<Round> rounds_;
    size_t count_ = 0;
    int32_t group_ = -1;  // the first lane of the group that calls
    size_t next_ = 0;     // its next round
};

}  // namespace kinora
