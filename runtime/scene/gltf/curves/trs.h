// runtime/scene/gltf/curves/trs.h: affine matrices as translation, rotation and scale.
#pragma once

#include <array>

#include "runtime/base/math.h"

namespace kinora {

// M = translation * rotation * diag(scale), rotation as x y z w.
struct Trs {
    dvec3 translation{0.0};
    std::array<double, 4> rotation{0, 0, 0, 1};
    dvec3 scale{1.0};
};
// False where the columns are not orthogonal: `trs` is then the nearest.
bool decompose_trs(const dmat4& m, Trs& trs);
// Any affine matrix as two nodes, outer * inner, exactly.
void split_shear(const dmat4& m, Trs& outer, Trs& inner);

bool is_identity(const dmat4& m, double tolerance = 0);

}  // namespace kinora
