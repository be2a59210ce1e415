// anim/animation.cpp: channels to values, changes to owners' bits.
#include "anim/animation.h"

#include <algorithm>
#include <atomic>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"

namespace kinora::anim {
namespace {

constexpr uint32_t kBatch = 16;        // numbers evaluated at once: a matrix
constexpr size_t kChannelGrain = 512;  // channels a task: some tens of microseconds

uint32_t reachable_count(const Animation& animation, const Channel& channel) {
    CHECK_LT(channel.sampler, animation.samplers.size());
    const Sampler& sampler = animation.samplers[channel.sampler];
    if (sampler.empty() || channel.component >= sampler.stride) return 0;
    return std::min(channel.count, sampler.stride - channel.component);
}

uint32_t slot_of(const Channel& channel, uint32_t i) {
    return channel.slot + i * channel.slot_step;
}

// For each slot the last (channel, number) that writes it, counted in document order.
std::vector<uint32_t> last_writers(const Animation& animation) {
    std::vector<uint32_t> writer(animation.slot_count, 0);
    uint32_t order = 0;
    for (const Channel& channel : animation.channels)
        for (uint32_t i = 0; i < reachable_count(animation, channel); ++i)
            writer[slot_of(channel, i)] = ++order;
    return writer;
}

void evaluate_channel(const Animation& animation, std::span<const Sampler> samplers, size_t index,
                      double time, std::span<double> values, std::span<uint64_t> changed) {
    const Channel& channel = animation.channels[index];
    const Sampler& sampler = samplers[channel.sampler];
    bool differs = false;
    uint32_t end = channel.component + std::min(channel.count, sampler.stride - channel.component);
    for (uint32_t w = animation.first_write[index]; w < animation.first_write[index + 1];) {
        double numbers[kBatch];
        uint32_t first = animation.writes[w].component;
        uint32_t count = std::min(kBatch, end - first);
        evaluate(sampler, time, first, std::span(numbers, count));
        for (; w < animation.first_write[index + 1]; ++w) {
            auto [component, slot] = animation.writes[w];
            if (component >= first + count) break;
            differs |= values[slot] != numbers[component - first];
            values[slot] = numbers[component - first];
        }
    }
    if (differs)
        std::atomic_ref(changed[channel.owner / 64])
            .fetch_or(uint64_t{1} << (channel.owner % 64), std::memory_order_relaxed);
}

}  // namespace

Animation make_animation(std::vector<Sampler> samplers, std::vector<Channel> channels) {
    Animation animation;
    animation.samplers = std::move(samplers);
    animation.channels = std::move(channels);
    for (const Channel& channel : animation.channels) {
        if (uint32_t count = reachable_count(animation, channel))
            animation.slot_count = std::max(animation.slot_count, slot_of(channel, count - 1) + 1);
        animation.owner_count = std::max(animation.owner_count, channel.owner + 1);
    }
    std::vector<uint32_t> writer = last_writers(animation);
    uint32_t order = 0;
    for (const Channel& channel : animation.channels) {
        animation.first_write.push_back(static_cast<uint32_t>(animation.writes.size()));
        for (uint32_t i = 0; i < reachable_count(animation, channel); ++i) {
            if (writer[slot_of(channel, i)] == ++order)
                animation.writes.push_back({channel.component + i, slot_of(channel, i)});
            else
                ++animation.overridden;
        }
    }
    animation.first_write.push_back(static_cast<uint32_t>(animation.writes.size()));
    return animation;
}

void evaluate(const Animation& animation, double time_seconds, std::span<double> values,
              std::span<uint64_t> changed, std::span<const Sampler> samplers) {
    if (samplers.empty()) samplers = animation.samplers;
    CHECK_EQ(samplers.size(), animation.samplers.size());
    CHECK_GE(values.size(), animation.slot_count);
    CHECK_GE(changed.size() * 64, animation.owner_count);
    parallel_for(0, animation.channels.size(), kChannelGrain, [&](size_t begin, size_t end) {
        for (size_t c = begin; c < end; ++c)
            evaluate_channel(animation, samplers, c, time_seconds, values, changed);
    });
}

TimeRange time_range(const Animation& animation) {
    TimeRange range;
    bool any = false;
    for (const Channel& channel : animation.channels) {
        const Sampler& sampler = animation.samplers[channel.sampler];
        if (sampler.empty()) continue;
        range.begin = any ? std::min(range.begin, sampler.first_time()) : sampler.first_time();
        range.end = any ? std::max(range.end, sampler.last_time()) : sampler.last_time();
        any = true;
    }
    return range;
}

std::vector<double> key_times(const Animation& animation) {
    std::vector<bool> used(animation.samplers.size());
    std::vector<double> times;
    for (const Channel& channel : animation.channels) {
        if (used[channel.sampler]) continue;
        used[channel.sampler] = true;
        const Sampler& sampler = animation.samplers[channel.sampler];
        times.insert(times.end(), sampler.times.begin(), sampler.times.end());
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

}  // namespace kinora::anim
