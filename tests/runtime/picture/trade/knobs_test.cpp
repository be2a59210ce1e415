// tests/runtime/picture/trade/knobs_test.cpp: the table of knobs agrees with itself and with what
// it names.
#include "runtime/scene/quality/knobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "raytrace/film.h"
#include "runtime/base/stage_clock.h"

namespace kinora {
namespace {

TEST(Knobs, HaveNamesOfTheirOwnAndStagesThatExist) {
    std::set<std::string_view> names, stages;
    for (size_t s = 0; s < kStageCount; ++s) stages.insert(stage_name(Stage(s)));
    for (const Knob& knob : knobs()) {
        EXPECT_TRUE(names.insert(knob.option).second) << knob.option;
        EXPECT_TRUE(stages.contains(knob.stage)) << knob.option << ' ' << knob.stage;
        EXPECT_EQ(find_knob(knob.option), &knob);
    }
    EXPECT_EQ(find_knob("sp"), nullptr);
}

TEST(Knobs, HaveSettingsThatTheirOptionsTake) {
    for (const Knob& knob : knobs()) {
        EXPECT_GE(knob.settings.size(), 2u) << knob.option;
        for (std::string_view setting : knob.settings) {
            Quality quality;
            std::optional<double> value = knob_value(knob, setting);
            ASSERT_TRUE(value) << knob.option << ' ' << setting;
            if (knob.kind != KnobKind::Choice) {
                EXPECT_GE(*value, knob.low);
                EXPECT_LE(*value, knob.high);
            }
            ASSERT_TRUE(set_knob(knob, setting, quality));
            EXPECT_EQ(knob_text(knob, quality), setting);
            EXPECT_EQ(knob.get(quality), *value);
        }
    }
}

// From draft to reference no knob goes back towards its fast end.
TEST(Knobs, GrowFromPresetToPreset) {
    for (const Knob& knob : knobs()) {
        auto place = [&](std::string_view text) {
            return std::ranges::find(knob.settings, text) - knob.settings.begin();
        };
        for (size_t p = 1; p < kPresets; ++p)
            EXPECT_TRUE(knob.presets[p] == knob.presets[p - 1] ||
                        place(knob.presets[p]) > place(knob.presets[p - 1]))
                << knob.option;
    }
}

TEST(Knobs, ReadNoTextsOfOtherKinds) {
    EXPECT_FALSE(knob_value(*find_knob("spp"), "4.5"));
    EXPECT_FALSE(knob_value(*find_knob("spp"), "four"));
    EXPECT_FALSE(knob_value(*find_knob("spp"), ""));
    EXPECT_FALSE(knob_value(*find_knob("math"), "1"));
    EXPECT_EQ(knob_value(*find_knob("math"), "FAST"), knob_value(*find_knob("math"), "fast"));
    EXPECT_EQ(knob_value(*find_knob("dice"), "0.5"), 0.5);
}

// Words stand for the values of types elsewhere.
TEST(Knobs, WordsMeanWhatTheirTypesMean) {
    const Knob& filter = *find_knob("filter");
    ASSERT_EQ(filter.words.size(), raytrace::pixel_filters().size());
    for (size_t f = 0; f < filter.words.size(); ++f)
        EXPECT_EQ(filter.words[f], raytrace::pixel_filters()[f].name);
    Quality q;
    EXPECT_TRUE(set_knob(*find_knob("math"), "fast", q) && q.math == jit::math::Tier::Fast);
    EXPECT_TRUE(set_knob(*find_knob("shadows"), "explicit", q));
    EXPECT_EQ(q.shadows, ShadowMode::Explicit);
    EXPECT_TRUE(set_knob(*find_knob("displacement"), "bump", q));
    EXPECT_EQ(q.displacement, DisplacementMode::Bump);
    EXPECT_TRUE(set_knob(*find_knob("bvh"), "rebuild", q) && q.always_rebuild);
    EXPECT_TRUE(set_knob(*find_knob("robust"), "on", q) && q.robust);
    EXPECT_TRUE(set_knob(*find_knob("derivatives"), "on", q) && q.derivatives);
    EXPECT_TRUE(set_knob(*find_knob("rotation"), "slerp", q));
    EXPECT_EQ(q.rotation, anim::RotationPath::Slerp);
    EXPECT_TRUE(set_knob(*find_knob("depth"), "float", q));
    EXPECT_EQ(q.depth, PictureDepth::Float);
    EXPECT_TRUE(set_knob(*find_knob("texture-filter"), "trilinear", q));
    EXPECT_EQ(q.texture_filter, TextureFilter::Trilinear);
}

// What --quality means changes by intent alone.
TEST(Presets, AreTheKnownOnes) {
    ASSERT_EQ(qualities().size(), kPresets);
    const Quality& draft = *find_quality("draft");
    EXPECT_EQ(knob_texts(draft),
              "spp=1 filter=gaussian math=fast robust=off bvh=refit refit-limit=1.3 keys=0 "
              "rotation=slerp skin=linear influences=0 displacement=bump dice=8 rays=4 bounces=1 "
              "split=1 ray-limit=1000 light-samples=0 samples-behind=1 clamp-indirect=0 "
              "light-choice=auto texture-filter=anisotropic derivatives=on weak-lights=0.00195 "
              "opacity-threshold=0 shadows=auto depth=half");
    const Quality& final_ = *find_quality("final");
    EXPECT_EQ(knob_texts(final_),
              "spp=64 filter=gaussian math=precise robust=on bvh=refit refit-limit=1.3 keys=0 "
              "rotation=slerp skin=linear influences=0 displacement=true dice=1 rays=16 bounces=2 "
              "split=1 ray-limit=1000 light-samples=0 samples-behind=1 clamp-indirect=0 "
              "light-choice=auto texture-filter=anisotropic derivatives=on weak-lights=0.00024 "
              "opacity-threshold=0 shadows=auto depth=half");
    EXPECT_EQ(find_quality("best"), nullptr);
}

}  // namespace
}  // namespace kinora
