// skin/morph.h: weighted sums of shapes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/math.h"

namespace kinora::skin {

// COLLADA 1.4.1, morph: NORMALIZED (1 - sum of w) base + sum of w target; RELATIVE base + sum of
// w target.
enum class MorphMethod : uint8_t { Normalized, Relative };

// Both methods as base + sum of w * delta. Only entries that move are kept where few do.
struct MorphDeltas {
    std::vector<uint32_t> entries;  // ascending; empty: dense
    std::vector<vec4> deltas;       // w = 0
};
struct MorphTarget {
    MorphDeltas positions;
    MorphDeltas normals;  // none: the target leaves normals alone
};
// Made by build_morph; immutable afterwards.
struct Morph {
    std::vector<vec4> base_positions;
    std::vector<vec4> base_normals;
    std::vector<MorphTarget> targets;
};

// Positions in the base mesh's space minus its anchor; RELATIVE targets are differences and have no
// anchor taken off. A target's normals may be empty.
struct MorphTargetSource {
    std::span<const vec3> positions = {};
    std::span<const vec3> normals = {};
};
// A target whose counts differ from the base's is used as far as both reach; `mismatched` counts
// such targets for the caller to report.
Morph build_morph(MorphMethod method, std::span<const vec3> base_positions,
                  std::span<const vec3> base_normals, std::span<const MorphTargetSource> targets,
                  uint32_t* mismatched = nullptr);

// base + sum of w * delta; normals made unit (zero stays zero). Zero and non-finite weights cost
// nothing; weights beyond the targets are ignored, missing ones are 0. Outputs have the base's
// counts (CHECK), 16 bytes an element, w = 0, ready for skin::deform as rest data. Parallel over
// fixed chunks; the bits do not depend on the threads. No allocation.
void deform(const Morph& morph, std::span<const double> weights, std::span<vec4> positions,
            std::span<vec4> normals);

}  // namespace kinora::skin
