// anim/sampler_evaluate.cpp: from a time to a segment, and what holds outside the keys.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "anim/curve_p.h"
#include "runtime/base/check.h"

namespace kinora::anim {
namespace {

// The last key at or before `time`; first_time <= time <= last_time. Of keys at one time this is
// the right-hand one. Even spacing is met at the first try, a million keys else in twenty steps.
size_t key_before(const std::vector<double>& times, double time) {
    size_t last = times.size() - 1;
    double span = times[last] - times[0];
    if (span > 0) {
        auto guess = static_cast<size_t>((time - times[0]) / span * static_cast<double>(last));
        if (guess < last && times[guess] <= time && time < times[guess + 1]) return guess;
    }
    return static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin()) -
           1;
}

void evaluate_inside(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    size_t key = key_before(sampler.times, time);
    Interpolation interpolation =
        key + 1 < sampler.times.size() ? sampler.interpolations[key] : Interpolation::Step;
    row(interpolation).evaluate(sampler, key, time - sampler.times[key], first, out);
}

void hold(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    evaluate_inside(sampler, std::clamp(time, sampler.first_time(), sampler.last_time()), first,
                    out);
}

// The key nearest to that end whose time differs from the end's.
size_t inner_key(const std::vector<double>& times, bool at_start) {
    if (at_start)
        return static_cast<size_t>(std::upper_bound(times.begin(), times.end(), times.front()) -
                                   times.begin());
    return static_cast<size_t>(std::lower_bound(times.begin(), times.end(), times.back()) -
                               times.begin()) -
           1;
}

void extend_line(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    bool at_start = time < sampler.first_time();
    size_t end = at_start ? 0 : sampler.times.size() - 1;
    size_t inner = inner_key(sampler.times, at_start);
    double s = (time - sampler.times[end]) / (sampler.times[inner] - sampler.times[end]);
    const double* p = &sampler.values[end * sampler.stride + first];
    const double* q = &sampler.values[inner * sampler.stride + first];
    for (size_t i = 0; i < out.size(); ++i) out[i] = p[i] + (q[i] - p[i]) * s;
}

// Time folded into the keys' range, and how many whole ranges it lay away.
struct Folded {
    double time;
    double cycles;
};
Folded fold(const Sampler& sampler, double time) {
    double start = sampler.first_time(), period = sampler.last_time() - start;
    double offset = std::fmod(time - start, period);
    if (offset < 0) offset += period;
    double cycles = std::round((time - start - offset) / period);
    return {std::min(start + offset, sampler.last_time()), cycles};
}

void cycle(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    evaluate_inside(sampler, fold(sampler, time).time, first, out);
}

void cycle_relative(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    Folded folded = fold(sampler, time);
    evaluate_inside(sampler, folded.time, first, out);
    const double* begin = &sampler.values[first];
    const double* end = &sampler.values[sampler.values.size() - sampler.stride + first];
    for (size_t i = 0; i < out.size(); ++i) out[i] += folded.cycles * (end[i] - begin[i]);
}

void oscillate(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    Folded folded = fold(sampler, time);
    if (std::fmod(folded.cycles, 2) != 0)
        folded.time = std::clamp(sampler.first_time() + (sampler.last_time() - folded.time),
                                 sampler.first_time(), sampler.last_time());
    evaluate_inside(sampler, folded.time, first, out);
}

using EvaluateOutside = void (*)(const Sampler&, double time, uint32_t first,
                                 std::span<double> out);
constexpr EvaluateOutside kBehaviours[] = {  // by Behaviour
    hold, extend_line, cycle, cycle_relative, oscillate};
static_assert(std::size(kBehaviours) == static_cast<size_t>(Behaviour::Count));

void evaluate_any(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    if (std::isnan(time)) time = sampler.first_time();
    bool before = time<sampler.first_time(), after = time> sampler.last_time();
    if (!before && !after) return evaluate_inside(sampler, time, first, out);
    Behaviour behaviour = before ? sampler.pre : sampler.post;
    // one moment has no slope and no period
    if (!std::isfinite(time) || !(sampler.last_time() > sampler.first_time()))
        behaviour = Behaviour::Constant;
    kBehaviours[static_cast<int>(behaviour)](sampler, time, first, out);
}

// All four numbers together: each depends on the length of all.
void evaluate_unit_quaternion(const Sampler& sampler, double time, uint32_t first,
                              std::span<double> out) {
    double v[4];
    evaluate_any(sampler, time, 0, v);
    Quaternion q = normalized({v[3], v[0], v[1], v[2]});
    const double xyzw[4] = {q.x, q.y, q.z, q.w};
    std::copy_n(xyzw + first, out.size(), out.data());
}

}  // namespace

void evaluate(const Sampler& sampler, double time, uint32_t first, std::span<double> out) {
    CHECK(!sampler.empty());
    CHECK_LE(first + out.size(), sampler.stride);
    if (sampler.kind == SampleKind::Quaternion)
        evaluate_unit_quaternion(sampler, time, first, out);
    else
        evaluate_any(sampler, time, first, out);
}

}  // namespace kinora::anim
