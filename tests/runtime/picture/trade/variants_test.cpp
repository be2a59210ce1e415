// tests/runtime/picture/trade/variants_test.cpp: each setting of each knob is measured, once.
#include "runtime/picture/trade/variants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace kinora {
namespace {

std::vector<Variant> with_combinations(const CombinationRequest& request = {}) {
    std::vector<Variant> variants = trade_variants();
    add_combinations(variants, request);
    return variants;
}

TEST(Variants, BeginWithThePresets) {
    std::vector<Variant> variants = trade_variants();
    ASSERT_GE(variants.size(), kPresets);
    for (size_t p = 0; p < kPresets; ++p) {
        EXPECT_EQ(variants[p].name, kPresetNames[p]);
        EXPECT_EQ(knob_texts(variants[p].quality), knob_texts(qualities()[p]));
        EXPECT_EQ(qualities()[variants[p].base].name, std::string(p < 2 ? "preview" : "final"));
    }
}

TEST(Variants, HoldEachSettingOfEachKnobAroundPreviewAndFinal) {
    std::set<std::string> measured;
    for (const Variant& variant : trade_variants()) measured.insert(knob_texts(variant.quality));
    for (const Knob& knob : knobs())
        for (std::string_view setting : knob.settings)
            for (const char* base : {"preview", "final"}) {
                Quality quality = *find_quality(base);
                set_knob(knob, setting, quality);
                EXPECT_TRUE(measured.contains(knob_texts(quality))) << knob.option << setting;
            }
}

TEST(Variants, DifferInOneKnobAndAreNoTwoAlike) {
    std::set<std::string> settings, names;
    for (const Variant& variant : with_combinations()) {
        EXPECT_TRUE(settings.insert(knob_texts(variant.quality)).second) << variant.name;
        EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
        if (!variant.knob) continue;
        for (const Knob& knob : knobs())
            EXPECT_EQ(
                knob_text(knob, variant.quality) == knob_text(knob, qualities()[variant.base]),
                &knob != variant.knob)
                << variant.name << ' ' << knob.option;
    }
}

// A Latin hypercube: each setting comes up as often as the others, give or take one.
TEST(Variants, CombineAllSettingsEvenly) {
    std::vector<Variant> variants = with_combinations();
    std::erase_if(variants, [](auto& v) { return v.kind != VariantKind::Combination; });
    ASSERT_EQ(variants.size(), 24u);
    for (const Knob& knob : knobs()) {
        std::map<std::string, int> counts;
        for (const Variant& variant : variants) ++counts[knob_text(knob, variant.quality)];
        auto [least, most] =
            std::ranges::minmax_element(counts, {}, [](const auto& entry) { return entry.second; });
        EXPECT_LE(most->second - least->second, 1) << knob.option;
        size_t settings = knob.settings.size() - (knob.option == "spp" ? 2 : 0);  // up to 64
        EXPECT_EQ(counts.size(), settings) << knob.option;
    }
}

TEST(Variants, CombineWithinWhatIsAskedFor) {
    CombinationRequest request{.count = 5, .most_samples = 4, .fixed = {find_knob("skin")}};
    std::vector<Variant> variants = with_combinations(request);
    std::erase_if(variants, [](auto& v) { return v.kind != VariantKind::Combination; });
    ASSERT_EQ(variants.size(), 5u);
    std::set<std::string> math;
    for (const Variant& variant : variants) {
        EXPECT_LE(variant.quality.samples_per_pixel, 4);
        EXPECT_EQ(knob_text(*find_knob("skin"), variant.quality), "linear");
        math.insert(knob_text(*find_knob("math"), variant.quality));
    }
    EXPECT_EQ(math.size(), 2u);
}

TEST(Variants, ShareScenesWhereOnlySamplesDiffer) {
    Quality a = *find_quality("final"), b = a, c = a;
    set_knob(*find_knob("spp"), "4", b);
    set_knob(*find_knob("filter"), "box", b);
    set_knob(*find_knob("math"), "fast", c);
    EXPECT_EQ(scene_key(a), scene_key(b));
    EXPECT_NE(scene_key(a), scene_key(c));
}

}  // namespace
}  // namespace kinora
