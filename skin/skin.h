// skin/skin.h: linear blend skinning of positions and normals.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "skin/skeleton.h"

namespace kinora::skin {

// The influences of a <skin>, as read: vertex v has those in [first[v], first[v + 1]).
struct InfluenceSource {
    std::span<const uint32_t> first = {};  // vertices + 1, ascending; beyond the arrays is cut off
    std::span<const int32_t> joints = {};  // -1: bind shape alone
    std::span<const double> weights = {};  // same count as joints
    uint32_t joint_count = 0;
    uint32_t root_joint = 0;      // takes vertices without weight
    bool normalise = true;        // scale each vertex's weights to sum 1 (--weights=normalise)
    uint32_t max_influences = 0;  // 0: all; else the largest so many are kept (draft)
};

// What build_skin had to put right; counts, for the caller to report.
struct SkinRepairs {
    uint32_t weight_sum = 0;       // vertices whose sum was off 1 by more than 1e-3
    double worst_sum = 1;          // the sum farthest from 1 among them
    uint32_t unweighted = 0;       // vertices with no weight: bound to root_joint
    uint32_t non_finite = 0;       // weights that are not finite: 0
    uint32_t joint_range = 0;      // joint indices out of range: influence dropped
    uint32_t dropped = 0;          // influences over max_influences
    double largest_dropped = 0;    // weight, after normalising
    uint32_t most_influences = 0;  // on one vertex (not a repair)
    bool any() const { return weight_sum | unweighted | non_finite | joint_range | dropped; }
};

// Influences in blocks of 16 vertices, as many rounds a block as its busiest vertex needs; short
// vertices repeat their first joint with weight 0. Rounds come in sets of four, the last set of
// 1..4; within a set the entries of one vertex are neighbours: [set][vertex][round of the set].
struct InfluenceBlocks {
    static constexpr uint32_t kBlock = 16;
    size_t count = 0;               // vertices
    std::vector<uint32_t> first;    // blocks + 1: rounds before the block
    std::vector<float> weights;     // 16 a round, and three more: kernels load four at once
    std::vector<uint32_t> offsets;  // 16 a round: float offset of the joint's matrix in the palette
};

// Made by build_skin; immutable afterwards.
struct SkinMesh {
    InfluenceBlocks positions;
    InfluenceBlocks normals;      // empty if normal i belongs to position i
    bool shared_normals = false;  // normal i belongs to position i
    size_t normal_count = 0;
    uint32_t joint_count = 0;
};

// `normal_positions[i]` is the index of the position that normal i belongs to (several normals may
// share one); empty: no normals. Out of range: treated as position 0 and counted in joint_range.
SkinMesh build_skin(const InfluenceSource& source, std::span<const uint32_t> normal_positions,
                    SkinRepairs* repairs = nullptr);

// p' = (sum of w M) p, n' = unit(sign(det) cofactor(sum of w M) n), so normals stay right side out
// under mirrors and right under uneven scale; a normal that vanishes is (0, 0, 0). All spans are
// 16 bytes an element (w is written 0) in mesh order; positions.size() == skin.positions.count,
// normals.size() == skin.normal_count (CHECK). Rest normals need no unit length. Outputs must not
// overlap inputs. Parallel over fixed chunks: the bits depend neither on the threads nor on the
// CPU's vector width. No allocation.
void deform(const SkinMesh& skin, std::span<const JointMatrix> palette,
            std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
            std::span<vec4> positions, std::span<vec4> normals);

// The kernels deform can choose from, fastest first; "portable" is always there.
std::span<const char* const> deform_kernels();
// As deform, by a named kernel that the CPU supports (see deform_kernels); for tests, benchmarks.
void deform_with(const char* kernel, const SkinMesh& skin, std::span<const JointMatrix> palette,
                 std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                 std::span<vec4> positions, std::span<vec4> normals);

}  // namespace kinora::skin
