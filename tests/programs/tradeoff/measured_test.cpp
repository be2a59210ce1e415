// tests/programs/tradeoff/measured_test.cpp: settings chosen from a tradeoff.json written by hand.
#include "runtime/programs/tradeoff/measured.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "runtime/programs/tradeoff/tradeoff.h"

namespace kinora {
namespace {

// 20 x 10 pixels; wall times 1, 2, 8, 100 and 3 ms.
class Measured : public ::testing::Test {
  protected:
    void SetUp() override {
        TradeResults results;
        results.fingerprint = "f00d";
        results.target = "avx2";
        results.threads = 2;
        results.plan.width = 20;
        results.plan.height = 10;
        results.floor.picture.flip = 0.025;
        auto row = [&](const char* name, const char* preset, double ms, double flip, double rmse) {
            TradeRow made;
            made.variant.name = name;
            made.variant.quality = *find_quality(preset);
            made.times.wall_ms = ms;
            made.errors.picture.flip = flip;
            made.errors.picture.rmse = rmse;
            results.rows.push_back(made);
        };
        row("draft", "draft", 1, 0.5, 0.4);
        row("preview", "preview", 2, 0.1, 0.2);
        row("final", "final", 8, 0.02, 0.04);
        row("reference", "reference", 100, 0.01, 0.01);
        row("good", "final", 6, 0.02, 0.05);
        results.rows.push_back({.variant = {.name = "late"}, .not_measured = "no time"});
        file_ = std::filesystem::path(::testing::TempDir()) / "measured_test" / "tradeoff.json";
        std::filesystem::create_directories(file_.parent_path());
        std::ofstream(file_) << tradeoff_json(results);
    }
    void TearDown() override { std::filesystem::remove_all(file_.parent_path()); }

    std::string chosen(const FrameTarget& wanted, double pixels = 200) {
        query_.wanted = wanted;
        query_.pixels = pixels;
        auto found = measured_settings(query_, why_not_);
        if (found) quality_ = found->quality;
        return found ? found->name : "";
    }

    std::filesystem::path file_;
    MeasuredQuery query_{
        .file = "", .fingerprint = "f00d", .target = "avx2", .threads = 2, .wanted = {}};
    std::string why_not_;
    Quality quality_;
};

TEST_F(Measured, OfATimeErrLeastWithinIt) {
    query_.file = file_.parent_path();  // the folder will do
    EXPECT_EQ(chosen({.ms = 2.5}), "preview");
    EXPECT_EQ(chosen({.ms = 6.5}), "good");
    // The floor hides how final and reference differ from it: the fastest is taken.
    EXPECT_EQ(chosen({.ms = 1000}), "good");
    EXPECT_EQ(quality_.samples_per_pixel, 64);
    EXPECT_EQ(quality_.light_samples, 0u);  // the file's
    // A picture of four times the pixels takes four times as long.
    EXPECT_EQ(chosen({.ms = 8.5}, 800), "preview");
    EXPECT_EQ(chosen({.ms = 0.5}), "");
    EXPECT_NE(why_not_.find("reach the target"), std::string::npos);
}

TEST_F(Measured, OfAnErrorTakeLeastTime) {
    query_.file = file_;
    EXPECT_EQ(chosen({.error = 0.2}), "preview");
    EXPECT_EQ(chosen({.error = 0.02}), "good");
    EXPECT_EQ(chosen({.error = 0.04, .metric = TargetMetric::Rmse}), "final");
    EXPECT_EQ(chosen({.error = 0.001}), "");
}

TEST_F(Measured, FitTheSameSceneThreadsAndTarget) {
    query_.file = file_;
    query_.threads = 3;
    EXPECT_EQ(chosen({.ms = 10}), "");
    EXPECT_EQ(why_not_, "was measured with 2 threads on avx2");
    query_.threads = 2;
    query_.fingerprint = "beef";
    EXPECT_EQ(chosen({.ms = 10}), "");
    EXPECT_NE(why_not_.find("another scene"), std::string::npos);
}

}  // namespace
}  // namespace kinora
