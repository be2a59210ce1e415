// skin/narrowest.h: what linear blending takes from a limb.
#pragma once

#include <span>

#include "skin/skin.h"

namespace kinora::skin {

// The share of its radius that linear blending leaves a limb, at the vertex that loses most: the
// root of det(sum of w M) over the sum of w det(M). Joints that a limb is twisted by an angle a
// between leave |cos(a / 2)| half-way; 1: nothing is lost, 0: it closes. Joints that mirror or have
// no volume do not count.
double narrowest(const SkinMesh& skin, std::span<const JointMatrix> palette);

}  // namespace kinora::skin
