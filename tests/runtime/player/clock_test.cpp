// tests/runtime/player/clock_test.cpp: how time goes on, by arithmetic.
#include "runtime/player/clock.h"

#include <gtest/gtest.h>

namespace kinora {
namespace {

TimeState playing(double frame, LoopMode loop) {
    TimeState time;
    time.first = 0;
    time.last = 9;
    time.frame = frame;
    time.loop = loop;
    time.playing = true;
    return time;
}

TEST(Clock, GoesByTheRateAndTheSpeed) {
    TimeState time = playing(1, LoopMode::Loop);
    advance_time(time, 24, 0.125);
    EXPECT_DOUBLE_EQ(time.frame, 4);
    time.speed = -2;
    advance_time(time, 24, 0.0625);
    EXPECT_DOUBLE_EQ(time.frame, 1);
    time.playing = false;
    advance_time(time, 24, 1);
    EXPECT_DOUBLE_EQ(time.frame, 1);
}

TEST(Clock, LoopsShowTheLastFrameAsLongAsOthers) {
    TimeState time = playing(9, LoopMode::Loop);
    advance_time(time, 10, 0.05);
    EXPECT_DOUBLE_EQ(time.frame, 9.5);
    advance_time(time, 10, 0.05);
    EXPECT_DOUBLE_EQ(time.frame, 0);
    time.speed = -1;
    advance_time(time, 10, 0.1);
    EXPECT_DOUBLE_EQ(time.frame, 9);
}

TEST(Clock, PingPongTurnsBackAtBothEnds) {
    TimeState time = playing(8, LoopMode::PingPong);
    advance_time(time, 1, 3);  // 9, 8, 7... : 8 -> 11 mirrors to 7
    EXPECT_DOUBLE_EQ(time.frame, 7);
    EXPECT_LT(time.speed, 0);
    advance_time(time, 1, 9);  // 7 -> -2 mirrors to 2
    EXPECT_DOUBLE_EQ(time.frame, 2);
    EXPECT_GT(time.speed, 0);
    advance_time(time, 1, 18);  // a whole round
    EXPECT_DOUBLE_EQ(time.frame, 2);
    EXPECT_GT(time.speed, 0);
}

TEST(Clock, OnceStopsAtTheEnd) {
    TimeState time = playing(8, LoopMode::Once);
    advance_time(time, 1, 5);
    EXPECT_DOUBLE_EQ(time.frame, 9);
    EXPECT_FALSE(time.playing);
}

TEST(Clock, InAndOutAreTheRange) {
    TimeState time = playing(3, LoopMode::Loop);
    time.in = 3;
    time.out = 5;
    advance_time(time, 1, 3);
    EXPECT_DOUBLE_EQ(time.frame, 3);
    time.speed = -1;
    advance_one_frame(time);
    EXPECT_DOUBLE_EQ(time.frame, 5);
}

TEST(Clock, ARangeOfOneFrameStands) {
    for (LoopMode loop : {LoopMode::Loop, LoopMode::PingPong}) {
        TimeState time = playing(0, loop);
        time.last = 0;
        advance_time(time, 24, 10.3);
        EXPECT_GE(time.frame, 0);
        EXPECT_LT(time.frame, 1);
    }
}

}  // namespace
}  // namespace kinora
