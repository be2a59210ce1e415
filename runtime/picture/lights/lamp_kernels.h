// runtime/picture/lights/lamp_kernels.h: what points may have of lamps, or of groups of lamps, and
// the choice among them, eight lamps or sixteen points at once; one source, compiled per
// instruction set and chosen at run time. All give the same bits.
//
// The kernel files are compiled for one instruction set each, so this header must hold no inline
// function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/base/kernel_table.h"

namespace kinora {

inline constexpr size_t kLampLanes = 8;

// Lamps as in lamp.h, or groups of them: a lane each.
struct alignas(64) LampLanes {
    float center[3][kLampLanes] = {};  // of a group: weighed by strength
    float radius[kLampLanes] = {};     // of a sphere about the center that holds all
    float spread[kLampLanes] = {};     // the mean square of the distances to the center
    float strength[kLampLanes] = {};   // 0: the lane is not used
    float fall[3][kLampLanes] = {};
    float range[kLampLanes] = {};
    float axis[3][kLampLanes] = {};
    float edge[kLampLanes] = {};      // of a cone about all axes and cones; -1: there is none
    float slope[kLampLanes] = {};     // of a soft edge: 1 / (inner - edge), else 0
    float exponent[kLampLanes] = {};  // as slope: 0 of groups
    bool cones = false;               // some lane has a cone
    float mixed[kLampLanes] = {};     // 1 where cones of the group do not look along the axis
};

// A node of a tree of lamps.
struct LampBlock {
    LampLanes lanes;                  // those in use come first
    uint32_t below[kLampLanes] = {};  // the block of a group; kOneLamp: the lane is a lamp alone
    uint32_t lamp[kLampLanes] = {};
};
inline constexpr uint32_t kOneLamp = ~0u;

inline constexpr size_t kLampPoints = 16;

// Points to be lit, side by side.
struct alignas(64) LampPoints {
    float P[3][kLampPoints] = {};
    float side[3][kLampPoints] = {};  // light counts by the cosine to it; 0: from all around
    float start[kLampPoints] = {};    // in [0, 1): all that is drawn at random
    size_t count = 0;
};

struct ChosenLamp {
    uint32_t lamp = 0;  // as the tree numbers it
    uint32_t point = 0;
    float weight = 1;  // its light counts so often
};

// A part of the tree that a point has chosen.
struct LampHit {
    uint32_t point, block, lane;
    float at;      // in [0, 1): which of a group's lamps
    float weight;  // a lamp's light counts so often, if it is alone
};

// Parts of a tree, with their light at each point: room for them.
struct LampParts {
    struct Part {
        uint32_t block, lane;
    };
    static constexpr size_t kMostOpened = 48;  // blocks, for one point
    static constexpr size_t kRoom = kLampPoints * kMostOpened * kLampLanes;
    Part* parts;                  // kRoom of them
    float (*light)[kLampPoints];  // likewise
};

struct LampKernels {
    const char* name;
    // The light at P that counts by the cosine to `side`, or from all around where that is 0; and
    // how much of it is not known, up to 1: 0 of lamps. The light is 0 only where none arrives.
    void (*see)(const LampLanes& lamps, const float P[3], const float side[3], float* light,
                float* doubt);
    // Up to `wanted` lamps of the tree for each point, those of a point in its order; how many in
    // all. What a point chooses does not depend on those beside it. There is room for all of
    // `hits`, which are of no more use.
    size_t (*choose)(const LampBlock* tree, const LampPoints& points, size_t wanted,
                     const LampParts& parts, LampHit* hits, ChosenLamp* chosen);
};
KINORA_KERNEL_TABLES(LampKernels, Lamps);

// Those this CPU can run, and the widest of them.
const UsableKernels<LampKernels>& usable_lamp_kernels();
const LampKernels& lamp_kernels();

}  // namespace kinora
