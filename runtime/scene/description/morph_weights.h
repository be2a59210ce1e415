// runtime/scene/description/morph_weights.h: morphs that change one another's results.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// A morph and those whose results it changes, the innermost first.
std::vector<uint32_t> morph_chain(const SceneDescription& description, uint32_t morph);

// The targets of all of them.
size_t chain_targets(const SceneDescription& description, uint32_t morph);

// How often each target's difference from the base mesh is added to it, in the order of the chain's
// targets; `out` has one number for each. No allocation. All have one base B, so NORMALIZED,
// (1 - sum of w) P + sum of w T, is B + (1 - sum of w) (P - B) + sum of w (T - B): it weakens what
// P adds to B.
void morph_weights(const SceneDescription& description, std::span<const double> values,
                   uint32_t morph, std::span<double> out);

}  // namespace kinora
