// anim/baked.h: curves made cheaper to follow, and less exact.
#pragma once

#include <vector>

#include "anim/animation.h"

namespace kinora::anim {

struct KeyOptions {
    double rate = 0;  // samples a second that stand for a curve, straight between; 0: the curve
    RotationPath rotation = RotationPath::Slerp;  // between matrices and quaternions

    bool exact() const { return rate == 0 && rotation == RotationPath::Slerp; }
};

inline constexpr double kMostBakedSamples = 1 << 20;  // of one curve

// The sampler by these options. Samples begin at the first key and end with the last, whose values
// they have to the bit; matrices between samples are mixed by their numbers. A curve stays as it is
// where it jumps (STEP, two keys at one time), where it is straight already, and where it would
// have more samples than kMostBakedSamples.
Sampler baked(const Sampler& sampler, const KeyOptions& options);
// All samplers of the animation, in their order; none where the options are exact.
std::vector<Sampler> baked(const Animation& animation, const KeyOptions& options);

}  // namespace kinora::anim
