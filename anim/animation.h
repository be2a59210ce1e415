// anim/animation.h: all channels of a scene, evaluated together at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anim/channel.h"
#include "anim/sampler.h"

namespace kinora::anim {

// Made by make_animation; immutable afterwards.
struct Animation {
    struct Write {
        uint32_t component;
        uint32_t slot;
    };
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
    std::vector<Write> writes;          // of channel c: first_write[c] .. first_write[c + 1]
    std::vector<uint32_t> first_write;  // channels + 1
    uint32_t overridden = 0;            // numbers of a channel that a later channel also writes
    uint32_t slot_count = 0;            // values must hold at least these
    uint32_t owner_count = 0;           // changed must hold at least these bits
};

// Where two channels write one number, the later wins (and no two write it in parallel). Channels
// with an empty sampler write nothing; components beyond the sampler's stride are left out.
// A sampler index out of range is a bug (CHECK).
Animation make_animation(std::vector<Sampler> samplers, std::vector<Channel> channels);

// Writes every channel's numbers at `time_seconds` into `values` and sets bit `owner` of `changed`
// (bit o of word o / 64) where a number became another; bits are never cleared here. The numbers
// depend on the time alone. Parallel where there are many channels; no allocation. `samplers`: as
// many that stand for the animation's own (anim/baked.h); none: these themselves.
void evaluate(const Animation& animation, double time_seconds, std::span<double> values,
              std::span<uint64_t> changed, std::span<const Sampler> samplers = {});

// Words of `changed` that hold a bit for each owner.
constexpr size_t changed_words(size_t owners) {
    return (owners + 63) / 64;
}

struct TimeRange {
    double begin = 0;  // seconds
    double end = 0;
};
// From the first key to the last of all channels; {0, 0} without any.
TimeRange time_range(const Animation& animation);
// All key times of all channels, ascending, each once.
std::vector<double> key_times(const Animation& animation);

}  // namespace kinora::anim
