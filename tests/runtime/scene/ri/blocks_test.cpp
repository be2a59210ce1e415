// tests/runtime/scene/ri/blocks_test.cpp: what blocks save, and blocks that do not nest.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

const std::string kBall = "Sphere 1 -1 1 360 ";

TEST(RiBlocks, AttributeBlocksSaveColourAndTransformation) {
    RibWorlds r(
        "WorldBegin Color 1 0 0 Translate 1 0 0 AttributeBegin Color 0 1 0 Translate 0 2 0 " +
        kBall + "AttributeEnd " + kBall + "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    EXPECT_EQ(color_of(r.world(), r.primitive(0)), dvec3(0, 1, 0));
    expect_near(r.primitive(0).place({}), {1, 2, 0});
    EXPECT_EQ(color_of(r.world(), r.primitive(1)), dvec3(1, 0, 0));
    expect_near(r.primitive(1).place({}), {1, 0, 0});
    EXPECT_EQ(r.findings(), "");
}

TEST(RiBlocks, TransformBlocksSaveTheTransformationAlone) {
    RibWorlds r("WorldBegin TransformBegin Color 0 0 1 Translate 3 0 0 TransformEnd " + kBall +
                "WorldEnd");
    EXPECT_EQ(color_of(r.world(), r.primitive()), dvec3(0, 0, 1));
    expect_near(r.primitive().place({}), {0, 0, 0});
}

TEST(RiBlocks, SolidBlocksSaveAttributes) {
    RibWorlds r("WorldBegin SolidBegin \"primitive\" Color 0 0 1 Translate 3 0 0 " + kBall +
                "SolidEnd " + kBall + "WorldEnd");
    EXPECT_EQ(color_of(r.world(), r.primitive(0)), dvec3(0, 0, 1));
    EXPECT_EQ(color_of(r.world(), r.primitive(1)), dvec3(1, 1, 1));
    EXPECT_EQ(r.findings(), "");
}

TEST(RiBlocks, FramesSaveOptionsAttributesAndTransformation) {
    RibWorlds r(
        "Format 20 10 1 Color 0 1 0 FrameBegin 7 Format 30 30 1 Color 1 0 0 Translate 5 0 0 "
        "WorldBegin " +
        kBall +
        "WorldEnd FrameEnd "
        "FrameBegin 8 WorldBegin " +
        kBall + "WorldEnd FrameEnd");
    ASSERT_EQ(r.worlds.size(), 2u);
    EXPECT_EQ(r.picture(0).width, 30);
    EXPECT_EQ(r.picture(0).number, 7);
    EXPECT_EQ(color_of(r.world(0), r.primitive(0, 0)), dvec3(1, 0, 0));
    expect_near(r.primitive(0, 0).place({}), {5, 0, 0});
    EXPECT_EQ(r.picture(1).width, 20);
    EXPECT_EQ(r.picture(1).number, 8);
    EXPECT_EQ(color_of(r.world(1), r.primitive(0, 1)), dvec3(0, 1, 0));
    expect_near(r.primitive(0, 1).place({}), {0, 0, 0});
    EXPECT_EQ(r.findings(), "");
}

TEST(RiBlocks, WorldsWithoutFramesAreCounted) {
    RibWorlds r("Translate 1 0 0 WorldBegin Color 1 0 0 Translate 1 1 1 WorldEnd WorldBegin " +
                kBall + "WorldEnd WorldBegin WorldEnd");
    ASSERT_EQ(r.worlds.size(), 3u);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(r.picture(size_t(i)).number, i + 1);
    // What a world changed is as before it.
    EXPECT_EQ(color_of(r.world(1), r.primitive(0, 1)), dvec3(1, 1, 1));
    expect_near(r.primitive(0, 1).place({}), {1, 0, 0});
}

TEST(RiBlocks, AttributesBeforeTheWorldHoldInIt) {
    RibWorlds r("Color .5 0 0 Opacity .5 .5 .5 Sides 1 WorldBegin " + kBall + "WorldEnd");
    EXPECT_EQ(color_of(r.world(), r.primitive()), dvec3(.5, 0, 0));
    EXPECT_EQ(color_of(r.world(), r.primitive(), "Os"), dvec3(.5, .5, .5));
    EXPECT_TRUE(r.primitive().material->hide_backfaces);
    EXPECT_EQ(r.findings(), "");
}

TEST(RiBlocks, AttributeAndTransformBlocksStandOutsideOfWorldsToo) {
    RibWorlds r(
        "AttributeBegin Color 1 0 0 Translate 1 0 0 AttributeEnd TransformBegin Translate "
        "2 0 0 TransformEnd WorldBegin " +
        kBall + "WorldEnd");
    EXPECT_EQ(color_of(r.world(), r.primitive()), dvec3(1, 1, 1));
    expect_near(r.primitive().place({}), {0, 0, 0});
    EXPECT_EQ(r.findings(), "");
}

TEST(RiBlocks, OptionsWithinTheWorldAreLeftOut) {
    RibWorlds r("Format 20 10 1 WorldBegin Format 30 30 1 Projection \"perspective\" " + kBall +
                "WorldEnd");
    EXPECT_EQ(r.count("RI_OPTION_IN_WORLD"), 2) << r.findings();
    EXPECT_EQ(r.picture().width, 20);
    EXPECT_TRUE(r.world().cameras[0].orthographic);
}

TEST(RiBlocks, PrimitivesOutsideOfWorldsDrawNothing) {
    RibWorlds r(kBall + "WorldBegin WorldEnd Polygon \"P\" [0 0 0 1 0 0 1 1 0]");
    EXPECT_EQ(r.count("RI_OUTSIDE_WORLD"), 2) << r.findings();
    EXPECT_TRUE(r.primitives().empty());
}

TEST(RiBlocks, AnEndOfAnOuterBlockClosesTheInner) {
    RibWorlds r(
        "WorldBegin AttributeBegin Translate 1 0 0 TransformBegin Translate 1 0 0 "
        "AttributeEnd " +
        kBall + "WorldEnd");
    EXPECT_EQ(r.count("RI_NESTING"), 1) << r.findings();
    expect_near(r.primitive().place({}), {0, 0, 0});
}

TEST(RiBlocks, AnEndWithoutItsBeginIsLeftOut) {
    for (const char* end : {"AttributeEnd", "TransformEnd", "SolidEnd", "FrameEnd", "ObjectEnd",
                            "ArchiveEnd", "MotionEnd", "IfEnd", "Else"}) {
        RibWorlds r("WorldBegin Translate 1 0 0 " + std::string(end) + " " + kBall + "WorldEnd");
        EXPECT_EQ(r.count("RI_NESTING"), 1) << end << r.findings();
        EXPECT_EQ(r.worlds.size(), 1u) << end;
        ASSERT_EQ(r.primitives().size(), 1u) << end;
        expect_near(r.primitive().place({}), {1, 0, 0});
    }
}

TEST(RiBlocks, AWorldIsNotClosedByABlockAroundIt) {
    RibWorlds r("AttributeBegin WorldBegin AttributeEnd " + kBall + "WorldEnd AttributeEnd");
    ASSERT_EQ(r.worlds.size(), 1u);
    EXPECT_EQ(r.primitives().size(), 1u);
    EXPECT_EQ(r.count("RI_NESTING"), 1) << r.findings();
}

TEST(RiBlocks, AWorldEndClosesWhatIsOpen) {
    RibWorlds r("WorldBegin AttributeBegin TransformBegin " + kBall +
                "WorldEnd Color 0 1 0 WorldBegin " + kBall + "WorldEnd");
    ASSERT_EQ(r.worlds.size(), 2u);
    EXPECT_EQ(r.count("RI_NESTING"), 1) << r.findings();
    EXPECT_EQ(color_of(r.world(1), r.primitive(0, 1)), dvec3(0, 1, 0));
}

TEST(RiBlocks, WorldsStandNotWithinEachOther) {
    RibWorlds r("WorldBegin " + kBall + "WorldBegin " + kBall + "WorldEnd");
    EXPECT_EQ(r.worlds.size(), 1u);
    EXPECT_EQ(r.primitives().size(), 2u);
    EXPECT_EQ(r.count("RI_NESTING"), 1) << r.findings();
}

TEST(RiBlocks, FramesStandNotWithinWorlds) {
    RibWorlds r("WorldBegin FrameBegin 1 " + kBall + "FrameEnd WorldEnd");
    EXPECT_EQ(r.worlds.size(), 1u);
    EXPECT_EQ(r.primitives().size(), 1u);
    EXPECT_GE(r.count("RI_NESTING"), 1) << r.findings();
}

TEST(RiBlocks, AFileThatEndsInABlockHasItsWorldAllTheSame) {
    RibWorlds r("FrameBegin 3 WorldBegin AttributeBegin " + kBall);
    ASSERT_EQ(r.worlds.size(), 1u);
    EXPECT_EQ(r.primitives().size(), 1u);
    EXPECT_EQ(r.picture().number, 3);
    EXPECT_EQ(r.count("RI_NESTING"), 1) << r.findings();
}

TEST(RiBlocks, WhatIsKeptAndNeverEndsIsReported) {
    for (const char* begin : {"ObjectBegin 1", "ArchiveBegin \"a\"", "MotionBegin [0 1]"}) {
        RibWorlds r("WorldBegin " + kBall + "WorldEnd " + begin + " Translate 1 0 0");
        EXPECT_EQ(r.count("RI_NESTING"), 1) << begin << r.findings();
        EXPECT_EQ(r.primitives().size(), 1u);
    }
}

TEST(RiBlocks, NoWorldIsAnError) {
    Diagnostics diagnostics;
    EXPECT_FALSE(import_rib({"x.rib", "Format 10 10 1 Sphere 1 -1 1 360"}, {}, diagnostics));
    EXPECT_EQ(count_of(diagnostics, "RIB_NO_WORLD"), 1);
}

TEST(RiBlocks, AWorldIsChosenByItsNumber) {
    const std::string text =
        "WorldBegin WorldEnd WorldBegin Sphere 1 -1 1 360 WorldEnd WorldBegin WorldEnd";
    for (int world : {0, 1, 2, -1}) {
        Diagnostics diagnostics;
        ImportOptions options;
        options.world = world;
        auto got = import_rib({"x.rib", text}, options, diagnostics);
        ASSERT_TRUE(got);
        EXPECT_EQ(got->file_picture->number, world < 0 ? 3 : world + 1);
        EXPECT_EQ(got->meshes.size(), world == 1 ? 1u : 0u);
    }
    Diagnostics diagnostics;
    ImportOptions options;
    options.world = 3;
    EXPECT_FALSE(import_rib({"x.rib", text}, options, diagnostics));
    EXPECT_EQ(count_of(diagnostics, "RIB_WORLD_UNKNOWN"), 1);
}

}  // namespace
}  // namespace kinora::ri
