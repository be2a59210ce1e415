// tests/anim/sampler_values.h: samplers of one number, as tests write and read them.
#pragma once

#include <span>
#include <vector>

#include "anim/sampler.h"

namespace kinora::anim {

using Numbers = std::vector<double>;
using Kinds = std::vector<Interpolation>;

inline double at(const Sampler& sampler, double time) {
    double value = -12345;
    evaluate(sampler, time, 0, std::span(&value, 1));
    return value;
}

}  // namespace kinora::anim
