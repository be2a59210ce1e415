// anim/baked.cpp: curves sampled at a fixed rate.
#include "anim/baked.h"

#include <algorithm>
#include <cmath>

namespace kinora::anim {
namespace {

bool jumps(const Sampler& sampler) {
    for (size_t k = 0; k + 1 < sampler.times.size(); ++k)
        if (sampler.interpolations[k] == Interpolation::Step ||
            sampler.times[k] == sampler.times[k + 1])
            return true;
    return false;
}

bool is_straight(const Sampler& sampler) {
    return sampler.kind == SampleKind::Numbers && sampler.curves.empty();
}

std::vector<double> sample_times(const Sampler& sampler, double rate) {
    std::vector<double> times;
    const double first = sampler.first_time(), last = sampler.last_time();
    for (size_t k = 0; first + double(k) / rate < last; ++k)
        times.push_back(first + double(k) / rate);
    times.push_back(last);
    return times;
}

Sampler sampled(const Sampler& sampler, double rate) {
    const std::vector<double> times = sample_times(sampler, rate);
    std::vector<double> values(times.size() * sampler.stride);
    for (size_t k = 0; k < times.size(); ++k)
        evaluate(sampler, times[k], 0, std::span(values).subspan(k * sampler.stride, sampler.stride));
    const bool rotates = sampler.kind == SampleKind::Quaternion;
    return make_sampler({.times = times,
                         .values = values,
                         .stride = sampler.stride,
                         .pre = sampler.pre,
                         .post = sampler.post,
                         .kind = rotates ? SampleKind::Quaternion : SampleKind::Numbers});
}

}  // namespace

Sampler baked(const Sampler& sampler, const KeyOptions& options) {
    Sampler result = sampler;
    result.rotation = options.rotation;
    if (!(options.rate > 0) || sampler.times.size() < 2 || jumps(sampler) || is_straight(sampler))
        return result;
    if ((sampler.last_time() - sampler.first_time()) * options.rate > kMostBakedSamples)
        return result;
    result = sampled(result, options.rate);
    result.rotation = options.rotation;
    return result;
}

std::vector<Sampler> baked(const Animation& animation, const KeyOptions& options) {
    std::vector<Sampler> samplers;
    if (options.exact()) return samplers;
    for (const Sampler& sampler : animation.samplers) samplers.push_back(baked(sampler, options));
    return samplers;
}

}  // namespace kinora::anim
