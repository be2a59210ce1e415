// tests/base/stage_clock_test.cpp: stages exclude each other and add up, by a clock of our own.
#include "runtime/base/stage_clock.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <string>
#include <thread>

namespace kinora::test {
namespace {

uint64_t g_now = 0;
uint64_t now() {
    return g_now;
}

double sum_of(const std::array<double, kStageCount>& ms) {
    return std::accumulate(ms.begin(), ms.end(), 0.0);
}

TEST(StageClock, AScopeWithinAnotherTakesItsTimeAway) {
    g_now = 1000;
    StageClock clock(now);
    RunningClock running(clock);
    g_now += 1;  // other
    {
        StageScope gather(Stage::Gather);
        g_now += 10;
        {
            StageScope kernels(Stage::Kernels);
            g_now += 100;
            {
                StageScope nested(Stage::Gather);
                g_now += 1000;
            }
            g_now += 200;
        }
        g_now += 20;
    }
    g_now += 2;
    const StageTicks ticks = clock.ticks();
    EXPECT_EQ(ticks[Stage::Other], 3u);
    EXPECT_EQ(ticks[Stage::Gather], 1030u);
    EXPECT_EQ(ticks[Stage::Kernels], 300u);
    EXPECT_EQ(ticks.sum(), 1333u);
}

TEST(StageClock, StagesAddUpToTheLifeOfTheClockWhenAsked) {
    g_now = 5;
    StageClock clock(now);
    RunningClock running(clock);
    for (int i = 0; i < 100; ++i) {
        StageScope scope(Stage(i % int(kStageCount)));
        g_now += uint64_t(i);
        EXPECT_EQ(clock.ticks().sum(), g_now - 5);
    }
}

TEST(StageClock, WithoutOneScopesDoNothing) {
    g_now = 0;
    StageClock clock(now);
    StageScope scope(Stage::Film);
    g_now = 7;
    EXPECT_EQ(clock.ticks()[Stage::Other], 7u);
    EXPECT_EQ(clock.ticks()[Stage::Film], 0u);
}

TEST(StageClock, ACounterThatStepsBackStandsStill) {
    g_now = 100;
    StageClock clock(now);
    g_now = 90;
    clock.enter(Stage::Film);
    g_now = 130;
    EXPECT_EQ(clock.ticks()[Stage::Other], 0u);
    EXPECT_EQ(clock.ticks()[Stage::Film], 30u);
}

TEST(StageClock, EachThreadHasItsOwnAndTheOneBeforeReturns) {
    g_now = 0;
    StageClock outer(now), inner(now);
    RunningClock run_outer(outer);
    std::thread([] {
        StageScope scope(Stage::Film);  // no clock there
        g_now += 4;
    }).join();
    {
        RunningClock run_inner(inner);
        StageScope scope(Stage::Film);
        g_now += 8;
    }
    StageScope scope(Stage::Trace);
    g_now += 16;
    EXPECT_EQ(outer.ticks()[Stage::Other], 12u);
    EXPECT_EQ(outer.ticks()[Stage::Trace], 16u);
    EXPECT_EQ(inner.ticks()[Stage::Film], 8u);
}

TEST(StageMs, TilesOfThreadsCountWithTheirMeanAndAddUp) {
    StageTicks frame, tiles;
    frame[Stage::Refit] = 100;
    frame[Stage::Other] = 20;
    frame[Stage::Idle] = 1000;  // while two threads did tiles
    tiles[Stage::Trace] = 1200;
    tiles[Stage::Film] = 600;
    const auto ms = stage_ms(frame, tiles, 2, 11.2);
    EXPECT_DOUBLE_EQ(ms[size_t(Stage::Refit)], 1.0);
    EXPECT_DOUBLE_EQ(ms[size_t(Stage::Other)], 0.2);
    EXPECT_DOUBLE_EQ(ms[size_t(Stage::Trace)], 6.0);
    EXPECT_DOUBLE_EQ(ms[size_t(Stage::Film)], 3.0);
    EXPECT_NEAR(ms[size_t(Stage::Idle)], 1.0, 1e-12);
    EXPECT_DOUBLE_EQ(sum_of(ms), 11.2);
}

// Counters of two cores need not agree.
TEST(StageMs, TilesNeverHaveMoreThanTheFrameHadForThem) {
    StageTicks frame, tiles;
    frame[Stage::Refit] = 100;
    frame[Stage::Idle] = 100;
    tiles[Stage::Trace] = 210;
    tiles[Stage::Film] = 210;
    const auto ms = stage_ms(frame, tiles, 2, 2);
    EXPECT_DOUBLE_EQ(sum_of(ms), 2);
    EXPECT_DOUBLE_EQ(ms[size_t(Stage::Refit)], 1);
    EXPECT_DOUBLE_EQ(ms[size_t(Stage::Trace)], 0.5);
    EXPECT_NEAR(ms[size_t(Stage::Idle)], 0, 1e-15);
}

TEST(StageMs, AClockThatDidNotTickGivesAllToOther) {
    EXPECT_EQ(sum_of(stage_ms({}, {}, 1, 3)), 3);
}

TEST(StageName, AllDiffer) {
    std::set<std::string> names;
    for (size_t s = 0; s < kStageCount; ++s) names.insert(stage_name(Stage(s)));
    EXPECT_EQ(names.size(), kStageCount);
    EXPECT_EQ(std::string(stage_name(Stage::Sample)), "sample");
    EXPECT_EQ(std::string(stage_name(Stage::Idle)), "idle");
}

}  // namespace
}  // namespace kinora::test
