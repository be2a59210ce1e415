// tests/programs/tradeoff/reports_test.cpp: floors, fronts and files of results made by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/programs/tradeoff/asserts.h"
#include "runtime/programs/tradeoff/plot.h"
#include "runtime/programs/tradeoff/thumbnails.h"
#include "runtime/programs/tradeoff/tradeoff.h"
#include "runtime/scene/images/png_memory.h"

namespace kinora {
namespace {

TradeResults small_results() {
    TradeResults results;
    results.scene = "a<b>.dae";
    results.floor.picture.flip = 0.01;
    results.floor.picture.psnr = 50;
    auto row = [&](const char* name, double ms, double flip, double psnr) {
        TradeRow made;
        made.variant.name = name;
        made.variant.quality = *find_quality("final");
        made.times.ms = {ms, 0.9 * ms, 1.1 * ms, 0.97};
        made.errors.picture.flip = flip;
        made.errors.picture.psnr = psnr;
        results.rows.push_back(made);
    };
    row("draft", 1, 0.5, 20);
    row("preview", 2, 0.1, 30);
    row("final", 8, 0.02, 40);
    row("reference", 100, 0.01, 50);
    row("bad", 3, 0.2, 25);
    results.rows[4].variant.kind = VariantKind::Combination;
    results.rows.push_back({.variant = {.kind = VariantKind::Combination, .name = "late"},
                            .not_measured = "the budget was used up"});
    mark_front(results);
    return results;
}

TEST(Reports, MarkTheFront) {
    TradeResults results = small_results();
    std::vector<bool> front;
    for (const TradeRow& row : results.rows) front.push_back(row.on_front);
    EXPECT_EQ(front, (std::vector<bool>{true, true, true, true, false, false}));
    // Surely 2.7 ms and more, against 2.2 ms and less of preview, which errs less.
    EXPECT_NEAR(results.rows[4].off_front, 2.7 / 2.2 - 1, 1e-12);
    EXPECT_EQ(results.rows[2].off_front, 0);
}

// By five times an interval holds 1 - 2 / 32 = 94 %: nothing is called slow for it or by it.
TEST(Reports, CallNothingSlowWithoutSureIntervals) {
    TradeResults results = small_results();
    results.rows[4].times.ms.cover = 1 - 2.0 / 32;
    mark_front(results);
    EXPECT_EQ(results.rows[4].off_front, 0);
    results = small_results();
    results.rows[1].times.ms.cover = 1 - 2.0 / 32;
    mark_front(results);
    EXPECT_EQ(results.rows[4].off_front, 0);  // 2.7 ms of its own interval are its only rival
}

// Shadows that a scene does not have cost time all the same: no preset is slow for keeping them. A
// knob that trades time for time is another matter.
TEST(Reports, CallNoPresetSlowByTheLuckOfAScene) {
    for (const auto& [option, setting, off] :
         {std::tuple{"shadows", 2.0, 0.0}, std::tuple{"bvh", 1.0, 1.8 / 1.1 - 1}}) {
        TradeResults results = small_results();
        ASSERT_EQ(results.rows[1].variant.kind, VariantKind::Preset);
        TradeRow& preset = results.rows[1];
        for (const auto kind : {VariantKind::Knob, VariantKind::Combination}) {
            TradeRow fast = preset;
            fast.variant.kind = kind;
            fast.variant.base = 1;
            fast.variant.knob = kind == VariantKind::Knob ? find_knob(option) : nullptr;
            fast.same_picture = kind == VariantKind::Knob;
            find_knob(option)->set(fast.variant.quality, setting);
            fast.times.ms = {1, 0.9, 1.1, 0.97};
            results.rows.push_back(fast);
        }
        mark_front(results);
        EXPECT_NEAR(results.rows[1].off_front, off, 1e-12) << option;
    }
}

TEST(Reports, HideWhatTheNoiseHides) {
    TradeResults results = small_results();
    const TradeMetric &flip = *find_trade_metric("flip"), &psnr = *find_trade_metric("psnr");
    EXPECT_EQ(error_text(flip, results.rows[3], results.floor), "<= floor");
    EXPECT_EQ(error_text(flip, results.rows[2], results.floor), "0.02");
    EXPECT_EQ(error_text(psnr, results.rows[3], results.floor), "<= floor");
    EXPECT_EQ(error_text(psnr, results.rows[0], results.floor), "20");
    // Pixels that are not finite are never hidden.
    EXPECT_EQ(error_text(*find_trade_metric("non_finite"), results.rows[0], results.floor), "0");
}

TEST(Reports, AreJsonThatNamesEverySetting) {
    nlohmann::json json = nlohmann::json::parse(tradeoff_json(small_results()));
    EXPECT_EQ(json["format"], "kinora-tradeoff");
    ASSERT_EQ(json["rows"].size(), 6u);
    const nlohmann::json& row = json["rows"][2];
    EXPECT_EQ(row["settings"].size(), knobs().size());
    EXPECT_EQ(row["settings"]["spp"], 64);
    EXPECT_EQ(row["settings"]["math"], "precise");
    EXPECT_TRUE(row["settings"]["light-samples"].is_null());  // the file's
    EXPECT_EQ(row["errors"]["flip"], 0.02);
    EXPECT_EQ(json["rows"][5]["not_measured"], "the budget was used up");
    EXPECT_FALSE(json["rows"][5].contains("errors"));
}

TEST(Reports, AreTablesWithAsManyCellsInEachLine) {
    std::string csv = tradeoff_csv(small_results());
    size_t commas = 0, lines = 0;
    for (size_t at = 0; at < csv.size(); ++lines) {
        size_t end = csv.find('\n', at);
        size_t count = size_t(std::count(csv.begin() + long(at), csv.begin() + long(end), ','));
        if (lines == 0) commas = count;
        EXPECT_EQ(count, commas) << csv.substr(at, end - at);
        at = end + 1;
    }
    EXPECT_EQ(lines, 7u);
}

TEST(Reports, ArePagesThatEscapeAndNeedNothingElse) {
    std::string page = tradeoff_html(small_results());
    EXPECT_EQ(page.find("a<b>"), std::string::npos);
    EXPECT_NE(page.find("a&lt;b&gt;"), std::string::npos);
    for (const char* outside : {"http://", "https://", "@import", "<link"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(Asserts, HoldOrSayWhatIs) {
    TradeResults results = small_results();
    auto broken = [&](const char* text) {
        std::string error;
        std::optional<TradeAssert> parsed = parse_trade_assert(text, error);
        EXPECT_TRUE(parsed) << error;
        std::vector<std::string> lines = broken_asserts(results, {*parsed});
        return lines.empty() ? std::string() : lines[0];
    };
    EXPECT_EQ(broken("preset=final:flip<0.03"), "");
    EXPECT_EQ(broken("preset=final:psnr>39"), "");
    EXPECT_EQ(broken("preset=final:ms<9"), "");
    EXPECT_EQ(broken("preset=final:flip<0.02"), "preset=final:flip<0.02: flip is 0.02");
    EXPECT_NE(broken("preset=reference:flip<0.001").find("within the noise"), std::string::npos);
    results.rows[2].not_measured = "the budget was used up";
    EXPECT_EQ(broken("preset=final:flip<1"), "preset=final:flip<1: final was not measured");
}

TEST(Asserts, ThatAreNoneSayWhatTheyTake) {
    for (const char* text : {"", "final", "preset=final", "preset=final:flip", "preset=final:flip<",
                             "preset=final:flip<1x", "preset=best:flip<1", "preset=final:floop<1",
                             "final:flip<1", "preset=final<1:flip"}) {
        std::string error;
        EXPECT_FALSE(parse_trade_assert(text, error)) << text;
        EXPECT_FALSE(error.empty()) << text;
    }
}

TEST(Means, AverageThePowerOfNoiseAndCountPixels) {
    PictureErrors a, b;
    a.psnr = 20, b.psnr = 40;  // powers 0.01 and 0.0001
    a.non_finite = 2, b.non_finite = 3;
    a.flip = 0.1, b.flip = 0.3;
    PictureErrors mean = mean_errors(std::vector{a, b});
    EXPECT_NEAR(mean.psnr, -10 * std::log10(0.00505), 1e-9);
    EXPECT_EQ(mean.non_finite, 5u);
    EXPECT_NEAR(mean.flip, 0.2, 1e-15);
}

// RFC 4648, section 10.
TEST(Base64, GivesTheVectorsOfItsStandard) {
    auto text = [](std::string_view s) { return base64({s.begin(), s.end()}); };
    EXPECT_EQ(text(""), "");
    EXPECT_EQ(text("f"), "Zg==");
    EXPECT_EQ(text("fo"), "Zm8=");
    EXPECT_EQ(text("foo"), "Zm9v");
    EXPECT_EQ(text("foobar"), "Zm9vYmFy");
}

TEST(Thumbnails, AreMeansOfBlocks) {
    raytrace::Film film(400, 2);
    for (size_t i = 0; i < film.rgba.size(); ++i) film.rgba[i] = vec4(i % 2 ? 1.0f : 0.0f);
    std::vector<uint8_t> png = picture_thumbnail(film, ColorEncoding::Linear);
    std::string file = testing::TempDir() + "/thumbnail.png";
    std::FILE* out = std::fopen(file.c_str(), "wb");
    ASSERT_TRUE(out);
    std::fwrite(png.data(), 1, png.size(), out);
    std::fclose(out);
    std::optional<Image8> image = read_png(file);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 134);  // blocks of 3
    EXPECT_EQ(image->height, 1);
    // 3 x 2 pixels, of which 2 or 4 are white; unassociated, the colour is 1.
    for (int x = 0; x < 133; ++x) {
        int alpha = image->rgba[size_t(x) * 4 + 3];
        EXPECT_TRUE(alpha == 85 || alpha == 170) << x << ' ' << alpha;
        EXPECT_EQ(image->rgba[size_t(x) * 4], 255);
    }
}

// Decades are as far apart as each other.
TEST(Plots, HaveLogarithmicAxes) {
    Plot plot{.title = "t", .x_title = "x", .y_title = "y", .points = {}};
    for (double x : {1.0, 10.0, 100.0}) plot.points.push_back({x, x, "p", "s"});
    std::string svg = plot_svg(plot);
    std::vector<double> at;
    for (size_t p = svg.find("cx=\""); p != std::string::npos; p = svg.find("cx=\"", p + 1))
        at.push_back(std::stod(svg.substr(p + 4)));
    ASSERT_EQ(at.size(), 3u);
    EXPECT_NEAR(at[1] - at[0], at[2] - at[1], 0.11);
    EXPECT_GT(at[1], at[0]);
    EXPECT_EQ(plot_svg({}), "");
}

}  // namespace
}  // namespace kinora
