// runtime/scene/curves/channels.h: the channels that move some numbers, and when.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct MovingChannel {
    const anim::Sampler* sampler;
    const anim::Channel* channel;
};

// Those that write any of `count` values, or any number of a stack of transforms.
std::vector<MovingChannel> channels_of(const anim::Animation& animation, uint32_t first_value,
                                       uint32_t count);
std::vector<MovingChannel> channels_of(const anim::Animation& animation,
                                       std::span<const Transform> stack);

// Where the numbers of a slot stand that channels write: a display color's own, where the slot has
// it decoded.
ValueSlot written_slot(const SceneDescription& description, ValueSlot slot);

// Those that move any number of these slots.
std::vector<MovingChannel> channels_of(const SceneDescription& description,
                                       const anim::Animation& animation,
                                       std::span<const ValueSlot> slots);

// The times as the file holds them, as floats, each later than the one before.
std::vector<double> distinct_times(std::vector<double> times);

// All times at which a channel has a key, more within pieces where a turn of the stack passes 90
// degrees; the whole played range where a channel goes on beyond its keys.
std::vector<double> key_times(std::span<const Transform> stack,
                              const std::vector<MovingChannel>& channels,
                              const SceneDescription& description);

// A description's values at any time, as channels move them, with the colors decoded from them.
class ValuesAtTime {
  public:
    explicit ValuesAtTime(const SceneDescription& description)
        : rest_(description.values), values_(rest_), colors_(description.moving_colors) {}

    void evaluate(const std::vector<MovingChannel>& channels, double time);
    // Back to where nothing moves, for whoever evaluates next.
    void to_rest(const std::vector<MovingChannel>& channels);

    const std::vector<double>& values() const { return values_; }

  private:
    const std::vector<double>& rest_;
    std::vector<double> values_;
    const std::vector<MovingColor>& colors_;
};

// before * the matrices of the stack.
dmat4 stack_matrix(const dmat4& before, std::span<const Transform> stack,
                   const std::vector<double>& values);

}  // namespace kinora
