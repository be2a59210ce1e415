// tests/runtime/ri/filters_test.cpp: pixel filters that a program brings.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "runtime/scene/ri/calls/ri.h"
#include "runtime/scene/ri/import/interpretation.h"

namespace kinora::ri {
namespace {

int calls_of_filter = 0;
RtFloat tilted(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth) {
    EXPECT_LT(std::abs(x), xwidth / 2);
    EXPECT_LT(std::abs(y), ywidth / 2);
    ++calls_of_filter;
    return 1 + x;
}
RtFloat nothing(RtFloat x, RtFloat, RtFloat, RtFloat) {
    return x;
}
RtFloat endless(RtFloat, RtFloat, RtFloat, RtFloat) {
    return INFINITY;
}

struct Filtered {
    Diagnostics diagnostics;
    FilePicture picture;

    explicit Filtered(RtFilterFunc filter) {
        Interpretation calls("program.rib", {}, {}, diagnostics, [&](SceneDescription&& world) {
            picture = *world.file_picture;
            return true;
        });
        Context::make_current(&calls.context());
        RiPixelFilter(filter, 4, 2);
        RiWorldBegin();
        RiWorldEnd();
        Context::make_current(nullptr);
        calls.finish();
    }
};

TEST(RiFilters, OfProgramsAreCalledWhenTheyAreGiven) {
    calls_of_filter = 0;
    const Filtered r(tilted);
    EXPECT_EQ(calls_of_filter, 64 * 64);
    ASSERT_EQ(r.picture.filter_values.size(), 64u * 64u);
    EXPECT_EQ(r.picture.filter_width, 4);
    EXPECT_EQ(r.picture.filter_height, 2);
    EXPECT_NEAR(r.picture.filter_values[0], 1 + 4 * (.5 / 64 - .5), 1e-6);
    EXPECT_NEAR(r.picture.filter_values[63], 1 + 4 * (63.5 / 64 - .5), 1e-6);
    EXPECT_EQ(r.diagnostics.findings().size(), 0u);
}

TEST(RiFilters, WithoutASumAreReportedAndSoIsNone) {
    for (RtFilterFunc filter : {nothing, endless, RtFilterFunc(nullptr)}) {
        const Filtered r(filter);
        ASSERT_EQ(r.diagnostics.findings().size(), 1u);
        EXPECT_STREQ(r.diagnostics.findings()[0].info->code, "RI_RANGE");
        EXPECT_TRUE(r.picture.filter_values.empty());
    }
}

}  // namespace
}  // namespace kinora::ri
