// skin/deform_p.h: what a deform kernel is given, and the table of kernels.
//
// The kernel files are compiled for one instruction set each, so this header and what they include
// must hold no inline function of the library: the linker could keep the wrong copy of it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace kinora::skin {

// Blocks of 16 vertices. The float arrays hold 4 floats a vertex and start at the first block to be
// done; first, weights and offsets are the whole arrays of InfluenceBlocks.
struct DeformTask {
    const float* palette;
    const uint32_t* first;
    const float* weights;
    const uint32_t* offsets;
    const float* rest_positions;
    const float* rest_normals;
    float* positions;
    float* normals;
};

using DeformBlocks = void (*)(const DeformTask& task, size_t begin_block, size_t end_block);

struct DeformKernel {
    const char* name;
    DeformBlocks positions_and_normals;
    DeformBlocks positions;
    DeformBlocks normals;
};
extern const DeformKernel kPortableKernel;
extern const DeformKernel kAvx2Kernel;
extern const DeformKernel kAvx512Kernel;
// Those of deform_dual: the palette holds DualJoints.
extern const DeformKernel kDualPortableKernel;
extern const DeformKernel kDualAvx2Kernel;
extern const DeformKernel kDualAvx512Kernel;

// Squared lengths and determinants between these bounds are safe in float; the kernels hand other
// normals to exact_normal (scales like 1e20 or 1e-20, and normals that vanish).
inline constexpr float kLeastSafe = 1e-30f;
inline constexpr float kMostSafe = 1e30f;

// The normal of one vertex (0..15) of a block in double; weights, offsets: the block's.
void exact_normal(const float* palette, const float* weights, const uint32_t* offsets,
                  uint32_t rounds, uint32_t vertex, const float* rest, float* normal);

}  // namespace kinora::skin
