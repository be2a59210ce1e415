// tests/anim/animation_test.cpp: channels, owners' bits, threads, allocations.
#include "anim/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "allocation_count.h"
#include "runtime/base/parallel.h"

namespace kinora::anim {
namespace {

Sampler line(double slope, uint32_t stride = 1) {
    std::vector<double> times{0, 1}, values;
    for (uint32_t c = 0; c < stride; ++c) values.push_back(0);
    for (uint32_t c = 0; c < stride; ++c) values.push_back(slope + c);
    return make_sampler({times, values, stride});
}

bool bit(const std::vector<uint64_t>& changed, uint32_t owner) {
    return changed[owner / 64] >> (owner % 64) & 1;
}

TEST(Animation, WritesTheChannelsNumbersAndNoOthers) {
    Animation a = make_animation({line(10, 3)}, {{0, 1, 4, 2, 3, 70}});
    std::vector<double> values(9, -1);
    std::vector<uint64_t> changed(changed_words(a.owner_count));
    evaluate(a, 0.5, values, changed);
    EXPECT_EQ(values, (std::vector<double>{-1, -1, -1, -1, 5.5, -1, -1, 6, -1}));
    EXPECT_TRUE(bit(changed, 70));
    EXPECT_EQ(changed[0], 0u);
}

TEST(Animation, OnlyAChangedNumberSetsItsOwnersBit) {
    Animation a = make_animation({line(0), line(4)}, {{0, 0, 0, 1, 1, 3}, {1, 0, 1, 1, 1, 5}});
    std::vector<double> values(2, 0);
    std::vector<uint64_t> changed(1);
    evaluate(a, 0.5, values, changed);
    EXPECT_EQ(changed[0], uint64_t{1} << 5);
    changed[0] = 0;
    evaluate(a, 0.5, values, changed);
    EXPECT_EQ(changed[0], 0u);
}

TEST(Animation, StateDependsOnTimeAlone) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
    for (uint32_t i = 0; i < 50; ++i) {
        std::vector<double> times, values;
        for (int k = 0; k < 20; ++k) {
            times.push_back(k + unit(random));
            values.push_back(unit(random));
        }
        std::vector<Interpolation> kind{Interpolation::Cardinal};
        samplers.push_back(make_sampler({times, values, 1, kind}));
        channels.push_back({i, 0, i, 1, 1, i});
    }
    Animation a = make_animation(std::move(samplers), std::move(channels));
    std::vector<double> fresh(50), used(50);
    std::vector<uint64_t> changed(1);
    for (double t : {3.0, 17.2, 0.1, 5.5}) evaluate(a, t, used, changed);
    evaluate(a, 5.5, fresh, changed);
    EXPECT_EQ(used, fresh);
}

TEST(Animation, TheLaterOfTwoChannelsOnOneNumberWins) {
    Sampler matrix;
    {
        std::vector<double> times{0, 1}, values(32, 1.0);
        SamplerSource source{times, values, 16};
        source.kind = SampleKind::Matrix;
        matrix = make_sampler(source);
    }
    Animation a = make_animation({matrix, line(8)},
                                 {{0, 0, 0, 16, 1, 0}, {1, 0, matrix_slot(3, 0), 1, 1, 0}});
    EXPECT_EQ(a.overridden, 1u);
    std::vector<double> values(16);
    std::vector<uint64_t> changed(1);
    evaluate(a, 0.5, values, changed);
    EXPECT_EQ(values[3], 4);
    EXPECT_EQ(values[2], 1);
    changed[0] = 0;
    evaluate(a, 0.5, values, changed);
    EXPECT_EQ(changed[0], 0u) << "an overridden number must not count as a change";
}

TEST(Animation, AllMorphWeightsInOneChannelAreReached) {
    constexpr uint32_t kWeights = 100;
    Animation a = make_animation({line(1, kWeights)}, {{0, 0, 2, kWeights, 1, 0}});
    std::vector<double> values(kWeights + 2);
    std::vector<uint64_t> changed(1);
    evaluate(a, 1, values, changed);
    for (uint32_t i = 0; i < kWeights; ++i) EXPECT_EQ(values[i + 2], 1 + i);
}

TEST(Animation, EmptySamplersAndMissingComponentsWriteNothing) {
    Animation a = make_animation({Sampler{}, line(1)},
                                 {{0, 0, 0, 1, 1, 0}, {1, 0, 1, 5, 1, 0}, {1, 7, 0, 1, 1, 0}});
    std::vector<double> values(6, -1);
    std::vector<uint64_t> changed(1);
    evaluate(a, 1, values, changed);
    EXPECT_EQ(values, (std::vector<double>{-1, 1, -1, -1, -1, -1}));
}

TEST(Animation, TimeRangeAndKeyTimesCoverAllChannels) {
    std::vector<double> one{0.5, 2}, two{-1, 0.5, 1}, zero(3);
    Animation a = make_animation({make_sampler({one, zero}), make_sampler({two, zero}), Sampler{}},
                                 {{0, 0, 0}, {1, 0, 1}, {2, 0, 2}});
    EXPECT_EQ(time_range(a).begin, -1);
    EXPECT_EQ(time_range(a).end, 2);
    EXPECT_EQ(key_times(a), (std::vector<double>{-1, 0.5, 1, 2}));
    EXPECT_EQ(time_range(make_animation({}, {})).end, 0);
}

Animation many_channels(uint32_t count) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
    for (uint32_t i = 0; i < count; ++i) {
        std::vector<double> times{0, 1, 2}, values{unit(random), unit(random), unit(random)};
        std::vector<double> out{unit(random), 1, 1 + unit(random), 0, 2, 0};
        std::vector<double> in{0, 0, unit(random), 1, 1 + unit(random), 1};
        std::vector<Interpolation> kind{Interpolation::Bezier};
        samplers.push_back(make_sampler({times, values, 1, kind, in, out, 2, 2}));
        channels.push_back({i, 0, i, 1, 1, i / 3});
    }
    return make_animation(std::move(samplers), std::move(channels));
}

TEST(Animation, ThreadsGiveTheSameBits) {
    Animation a = many_channels(5000);
    std::vector<double> one(a.slot_count), two(a.slot_count);
    std::vector<uint64_t> changed_one(changed_words(a.owner_count)), changed_two(changed_one);
    set_thread_count(1);
    evaluate(a, 1.3, one, changed_one);
    set_thread_count(2);
    evaluate(a, 1.3, two, changed_two);
    EXPECT_EQ(one, two);
    EXPECT_EQ(changed_one, changed_two);
}

TEST(Animation, EvaluatingAllocatesNothing) {
    Animation a = many_channels(5000);
    std::vector<double> values(a.slot_count);
    std::vector<uint64_t> changed(changed_words(a.owner_count));
    set_thread_count(1);
    evaluate(a, 0, values, changed);
    size_t before = allocation_count();
    for (int frame = 0; frame < 24; ++frame) evaluate(a, frame / 12.0, values, changed);
    EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace kinora::anim
