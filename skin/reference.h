// skin/reference.h: skinning and morphing by their formulas, scalar and in double.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/math.h"
#include "skin/morph.h"
#include "skin/skin.h"

namespace kinora::skin::reference {

// The defining versions that tests compare with; they repair nothing. `joint_matrices` are
// world_from_joint * inverse_bind * bind_shape, `bind` what joint -1 applies. Weights are scaled to
// sum 1 (source.normalise). Every joint index must be in range.
std::vector<dvec3> skin_positions(const InfluenceSource& source,
                                  std::span<const dmat4> joint_matrices, const dmat4& bind,
                                  std::span<const dvec3> rest);
// Inverse transpose of the blended matrix, unit length; (0, 0, 0) where that has no meaning.
std::vector<dvec3> skin_normals(const InfluenceSource& source,
                                std::span<const dmat4> joint_matrices, const dmat4& bind,
                                std::span<const uint32_t> normal_positions,
                                std::span<const dvec3> rest);
// COLLADA 1.4.1, morph, as written there; not made unit.
std::vector<dvec3> morph(MorphMethod method, std::span<const dvec3> base,
                         std::span<const std::vector<dvec3>> targets,
                         std::span<const double> weights);

}  // namespace kinora::skin::reference
