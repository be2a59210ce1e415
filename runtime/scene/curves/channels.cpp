// runtime/scene/curves/channels.cpp: the channels that move some numbers, and when.
#include "runtime/scene/curves/channels.h"

#include <algorithm>
#include <cmath>

#include "runtime/scene/curves/reduce_keys.h"
#include "runtime/scene/description/display_color.h"
#include "runtime/scene/description/play_range.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr double kLargestTurn = 90;  // degrees between keys: slerp takes the shorter way

// Whether a channel writes any of `count` values.
bool writes(const anim::Channel& c, uint32_t first_value, uint32_t count) {
    uint32_t end = c.slot + (c.count - 1) * c.slot_step + 1;
    return c.slot < first_value + count && end > first_value;
}

bool writes_any(const std::vector<MovingChannel>& channels, uint32_t first_value, uint32_t count) {
    return std::ranges::any_of(
        channels, [&](const MovingChannel& c) { return writes(*c.channel, first_value, count); });
}

}  // namespace

std::vector<double> distinct_times(std::vector<double> times) {
    for (double& t : times) t = double(float(t));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

void ValuesAtTime::evaluate(const std::vector<MovingChannel>& channels, double time) {
    for (const MovingChannel& c : channels) {
        const anim::Channel& to = *c.channel;
        if (to.slot_step == 1)
            anim::evaluate(*c.sampler, time, to.component,
                           std::span(values_).subspan(to.slot, to.count));
        for (uint32_t i = 0; to.slot_step != 1 && i < to.count; ++i)
            anim::evaluate(*c.sampler, time, to.component + i,
                           {&values_[to.slot + i * to.slot_step], 1});
    }
    for (const MovingColor& color : colors_) {
        if (!writes_any(channels, color.display, 3)) continue;
        const double* display = &values_[color.display];
        dvec3 linear = linear_of_display({display[0], display[1], display[2]});
        for (int k = 0; k < 3; ++k) values_[color.linear + uint32_t(k)] = linear[k];
    }
}

void ValuesAtTime::to_rest(const std::vector<MovingChannel>& channels) {
    for (const MovingChannel& c : channels)
        for (uint32_t i = 0; i < c.channel->count; ++i) {
            uint32_t slot = c.channel->slot + i * c.channel->slot_step;
            values_[slot] = rest_[slot];
        }
    for (const MovingColor& color : colors_)
        if (writes_any(channels, color.display, 3))
            std::copy_n(&rest_[color.linear], 3, &values_[color.linear]);
}

ValueSlot written_slot(const SceneDescription& description, ValueSlot slot) {
    for (const MovingColor& color : description.moving_colors)
        if (slot.present() && color.linear == slot.offset) return {color.display, slot.count};
    return slot;
}

std::vector<MovingChannel> channels_of(const SceneDescription& description,
                                       const anim::Animation& animation,
                                       std::span<const ValueSlot> slots) {
    std::vector<MovingChannel> result;
    for (const anim::Channel& c : animation.channels) {
        const anim::Sampler& sampler = animation.samplers[c.sampler];
        bool moves = std::ranges::any_of(slots, [&](ValueSlot slot) {
            ValueSlot written = written_slot(description, slot);
            return slot.present() && writes(c, written.offset, written.count);
        });
        if (moves && !sampler.empty()) result.push_back({&sampler, &c});
    }
    return result;
}

std::vector<MovingChannel> channels_of(const anim::Animation& animation, uint32_t first_value,
                                       uint32_t count) {
    std::vector<MovingChannel> result;
    for (const anim::Channel& c : animation.channels) {
        const anim::Sampler& sampler = animation.samplers[c.sampler];
        if (writes(c, first_value, count) && !sampler.empty()) result.push_back({&sampler, &c});
    }
    return result;
}

std::vector<MovingChannel> channels_of(const anim::Animation& animation,
                                       std::span<const Transform> stack) {
    std::vector<MovingChannel> all;
    for (const Transform& t : stack) {
        std::vector<MovingChannel> own = channels_of(animation, t.value, 16);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

std::vector<double> key_times(std::span<const Transform> stack,
                              const std::vector<MovingChannel>& channels,
                              const SceneDescription& description) {
    std::vector<double> times;
    bool endless = false;
    for (const MovingChannel& c : channels) {
        const std::vector<double>& keys = c.sampler->times;
        times.insert(times.end(), keys.begin(), keys.end());
        endless |= c.sampler->pre != anim::Behaviour::Constant ||
                   c.sampler->post != anim::Behaviour::Constant;
        bool angle = false;
        for (const Transform& t : stack)
            angle |= t.kind == TransformKind::Rotate && c.channel->slot <= t.value + 3 &&
                     t.value + 3 < c.channel->slot + c.channel->count;
        for (size_t k = 0; angle && k + 1 < keys.size(); ++k) {
            double a, b;
            uint32_t component = c.channel->component + c.channel->count - 1;
            anim::evaluate(*c.sampler, keys[k], component, {&a, 1});
            anim::evaluate(*c.sampler, keys[k + 1], component, {&b, 1});
            double pieces = std::min(std::ceil(std::abs(b - a) / kLargestTurn), 1e4);
            for (double i = 1; i < pieces; ++i)
                times.push_back(keys[k] + (keys[k + 1] - keys[k]) * i / pieces);
        }
    }
    if (endless) {
        PlayRange range = play_range(description);
        times.push_back(range.start);
        times.push_back(range.end);
        double step = range.rate > 0 ? 1 / range.rate : 1.0 / 24;
        for (double t = range.start; t < range.end && times.size() < kMostKeys; t += step)
            times.push_back(t);
    }
    times = distinct_times(std::move(times));
    // glTF's time begins at 0.
    if (!times.empty() && times[0] < 0) {
        times.erase(std::remove_if(times.begin(), times.end(), [](double t) { return t < 0; }),
                    times.end());
        if (times.empty() || times[0] > 0) times.insert(times.begin(), 0.0);
    }
    return times;
}

dmat4 stack_matrix(const dmat4& before, std::span<const Transform> stack,
                   const std::vector<double>& values) {
    dmat4 m = before;
    for (const Transform& t : stack) m = m * transform_matrix(t.kind, &values[t.value]);
    return m;
}

}  // namespace kinora
