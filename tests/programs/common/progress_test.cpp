// tests/programs/common/progress_test.cpp: what a user sees while frames are made.
#include "runtime/programs/common/progress.h"

#include <gtest/gtest.h>

namespace kinora {
namespace {

template <class Use>
std::string stderr_of(Use use) {
    testing::internal::CaptureStderr();
    use();
    return testing::internal::GetCapturedStderr();
}

TEST(Progress, PrintsOneLineAFrame) {
    std::string text = stderr_of([] {
        ProgressReport report(ProgressStyle::Lines, 3);
        report.tile(10, 0, 1, 2);
        report.frame_done(10, 0, "f.0010.png", 12.34);
        report.frame_skipped(11, 1, "f.0011.png");
        report.frame_done(12, 2, "f.0012.png", 5);
        report.clear();
    });
    EXPECT_EQ(text,
              "frame 10 (1/3) 12.3 ms f.0010.png\n"
              "frame 11 (2/3) kept f.0011.png\n"
              "frame 12 (3/3) 5.0 ms f.0012.png\n");
}

TEST(Progress, SaysNothingWhenAskedTo) {
    EXPECT_EQ(stderr_of([] {
                  ProgressReport report(ProgressStyle::None, 1);
                  report.tile(1, 0, 1, 2);
                  report.frame_done(1, 0, "f.png", 1);
                  report.clear();
              }),
              "");
}

TEST(Progress, TheBarGrowsToItsEndAndIsTakenAway) {
    std::string text = stderr_of([] {
        ProgressReport report(ProgressStyle::Bar, 2);
        report.tile(1, 0, 1, 2);
        report.frame_done(1, 0, "f.1.png", 1);
        report.frame_done(2, 1, "f.2.png", 1);
        report.clear();
    });
    EXPECT_NE(text.find(" 25% frame 1"), std::string::npos) << text;
    EXPECT_NE(text.find(" 50% frame 1"), std::string::npos) << text;
    EXPECT_NE(text.find("100% frame 2"), std::string::npos) << text;
    EXPECT_EQ(text.substr(text.size() - 4), "\r\x1b[K");
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Progress, ClearingWhatWasNeverShownPrintsNothing) {
    EXPECT_EQ(stderr_of([] { ProgressReport(ProgressStyle::Bar, 1).clear(); }), "");
}

}  // namespace
}  // namespace kinora
