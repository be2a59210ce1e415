// skin/dual_quaternion.h: skinning by blended rotations, which keeps the volume of twisted limbs.
#pragma once

#include <span>

#include "skin/skin.h"

namespace kinora::skin {

// A joint's matrix as rotation, translation and stretch: M p = R (S p) + t. Of the size of a
// JointMatrix, so that the offsets of InfluenceBlocks serve both.
struct alignas(64) DualJoint {
    float rotation[4];  // unit quaternion: w x y z, w >= 0
    float translation[3];
    float stretch[9];  // by columns; symmetric unless M has no inverse
};
static_assert(sizeof(DualJoint) == sizeof(JointMatrix));

// The polar decomposition, by Newton's iteration (Higham: "Computing the polar decomposition, with
// applications", 1986). A matrix that mirrors has a stretch that mirrors; one without an inverse
// does not turn: all of it is stretch.
DualJoint dual_joint(const JointMatrix& matrix);

// p' = R (S p) + t, with R and t those of the weighted sum of the joints' dual quaternions and S
// the weighted sum of their stretches (Kavan, Collins, Zara, O'Sullivan: "Geometric Skinning with
// Approximate Dual Quaternion Blending", 2008). Each quaternion is taken on the side of the
// vertex's first one; at half a turn from it, on the side that turns it positively about the axis
// whose first component that is not zero is positive. Where one joint holds a vertex, and where all
// joints agree, the result is that of deform. Normals as deform's: unit, right side out.
//
// Spans as for deform. Parallel over fixed chunks: the bits depend on no thread and no CPU.
void deform_dual(const SkinMesh& skin, std::span<const DualJoint> palette,
                 std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                 std::span<vec4> positions, std::span<vec4> normals);
// As deform_dual, by a named kernel that the CPU supports (see deform_kernels); for tests,
// benchmarks.
void deform_dual_with(const char* kernel, const SkinMesh& skin, std::span<const DualJoint> palette,
                      std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                      std::span<vec4> positions, std::span<vec4> normals);

}  // namespace kinora::skin
