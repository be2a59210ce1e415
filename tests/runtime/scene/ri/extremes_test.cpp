// tests/runtime/scene/ri/extremes_test.cpp: numbers that no primitive can have, and very many
// of all: findings or nothing, in a bounded time, and never a crash.
#include <ctime>

#include "rib_scene.h"
#include "tests/fuzz_settings.h"

namespace kinora::ri {
namespace {

const std::string kGood = "Sphere .5 -.5 .5 360 ";

// Renders with a sound sphere at the end, which must be there.
RibPicture with_good(const std::string& inside, const std::string& before = "") {
    return RibPicture(kSmall + before + "WorldBegin Surface \"constant\" AttributeBegin " + inside +
                      " AttributeEnd Translate 0 0 2 " + kGood + "WorldEnd");
}

TEST(RiExtremes, PrimitivesWithoutSizeDrawNothing) {
    for (const char* bad :
         {"Sphere 0 -1 1 360",
          "Sphere 1 0 0 360",
          "Sphere 1 -1 1 0",
          "Sphere 1 5 9 360",
          "Cone 0 0 360",
          "Cone 1 0 360",
          "Cylinder 0 -1 1 360",
          "Cylinder 1 1 1 360",
          "Disk 1 0 360",
          "Torus 0 0 0 360 360",
          "Torus 1 0 0 360 360",
          "Paraboloid 0 0 0 360",
          "Paraboloid 1 -1 0 360",
          "Paraboloid 1 0 -1 360",
          "Hyperboloid 0 0 0 0 0 0 360",
          "Polygon \"P\" [0 0 1 0 0 1 0 0 1]",
          "Polygon \"P\" [0 0 1 1 0 1]",
          "Polygon \"P\" []",
          "PointsPolygons [] [] \"P\" []",
          "PointsPolygons [] []",
          "GeneralPolygon [] \"P\" []",
          "GeneralPolygon [0] \"P\" []",
          "GeneralPolygon [3 0] \"P\" [0 0 0 0 0 0 0 0 0]",
          "PointsGeneralPolygons [] [] [] \"P\" []",
          "PointsGeneralPolygons [0] [] [] \"P\" []",
          "Patch \"bilinear\" \"P\" [0 0 1 0 0 1 0 0 1 0 0 1]",
          "NuPatch 2 2 [0 0 0 0] 0 0 2 2 [0 0 0 0] 0 0 \"P\" [0 0 0 1 0 0 0 1 0 1 1 0]"}) {
        RibPicture r = with_good(bad);
        EXPECT_TRUE(r.covers(8, 8)) << bad;
        EXPECT_EQ(r.covered(), with_good("").covered()) << bad << r.findings();
    }
}

TEST(RiExtremes, NumbersThatAreNone) {
    for (const char* bad :
         {"Sphere nan -1 1 360", "Sphere 1 -1 nan 360", "Sphere inf -1 1 360",
          "Sphere 1e38 -1e38 1e38 360", "Polygon \"P\" [0 0 1 nan 0 1 0 1 1]",
          "Translate nan 0 0 Sphere 1 -1 1 360", "Rotate nan 0 0 1 Sphere 1 -1 1 360",
          "Scale inf 1 1 Sphere 1 -1 1 360", "Color nan 0 0", "Torus nan nan nan nan nan",
          "Patch \"bilinear\" \"P\" [nan 0 0 1 0 0 0 1 0 1 1 0]",
          "TextureCoordinates nan 0 0 0 0 0 0 0", "ShadingRate nan",
          "Detail [nan nan nan nan nan nan] DetailRange 0 0 1 1",
          "Basis [nan 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0] 3 \"bezier\" 3"}) {
        RibPicture r = with_good(bad);
        EXPECT_TRUE(r.covers(8, 8)) << bad << r.findings();
    }
    for (const char* option :
         {"Format nan nan nan", "ScreenWindow nan 1 0 1", "CropWindow nan 1 0 1",
          "Clipping nan nan", "Shutter nan 1", "PixelSamples nan 1", "Exposure nan 1",
          "FrameAspectRatio nan", "Projection \"perspective\" \"fov\" nan",
          "Projection \"perspective\" \"fov\" 180", "PixelFilter \"box\" nan 1", "PixelSamples 0 0",
          "RelativeDetail nan"}) {
        RibPicture r =
            with_good("", std::string(option) + " " + kSmall + "Projection \"orthographic\" ");
        EXPECT_TRUE(r.covers(8, 8)) << option << r.findings();
    }
}

TEST(RiExtremes, NegativeSizesAreTheSameShape) {
    for (const char* odd : {"Sphere -.5 -.5 .5 360", "Disk 0 -.5 360", "Sphere .5 .5 -.5 360"}) {
        RibPicture r(kSmall + "WorldBegin Surface \"constant\" Translate 0 0 2 " + odd +
                     " WorldEnd");
        EXPECT_FALSE(r.covers(0, 0)) << odd;
    }
}

// An order over the number of points is lowered. All else has no domain, or no finite place.
TEST(RiExtremes, NurbsWithoutADomainAreTold) {
    auto patch = [](const char* u, const char* points) {
        return fmt::format("NuPatch {} 2 2 [0 0 1 1] 0 1 {}", u, points);
    };
    const char* kPlain = "\"P\" [0 0 1 1 0 1 0 1 1 1 1 1]";
    RibPicture whole(kSmall + "WorldBegin Surface \"constant\" " +
                     patch("2 4 [0 0 0 1 1 1] 0 1", kPlain) + " WorldEnd");
    EXPECT_EQ(whole.covered(), 64) << whole.findings();
    for (const std::string& bad :
         {patch("2 2 [1 1 0 0] 0 1", kPlain), patch("2 2 [0 2 1 3] 0 1", kPlain),
          patch("2 2 [0 0 1 1] 1 0", kPlain), patch("2 2 [0 0 0 0] 0 1", kPlain),
          patch("2 2 [nan 0 1 1] 0 1", kPlain),
          patch("2 2 [0 0 1 1] 0 1", "\"Pw\" [0 0 1 0 1 0 1 0 0 1 1 0 1 1 1 0]")}) {
        RibPicture r = with_good(bad);
        EXPECT_EQ(r.covered(), with_good("").covered()) << bad;
        EXPECT_EQ(r.count("RI_RANGE"), 1) << bad << r.findings();
    }
}

TEST(RiExtremes, MeshesOfBoundariesAloneAreTold) {
    RibPicture r = with_good(
        "SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] \"P\" "
        "[-1 -1 1 1 -1 1 1 1 1 -1 1 1]");
    EXPECT_EQ(r.count("RI_RANGE"), 1) << r.findings();
    EXPECT_NE(r.findings().find("interpolateboundary"), std::string::npos);
}

TEST(RiExtremes, MoreThanATurnIsOne) {
    for (const char* turns : {"Sphere .5 -.5 .5 3600000", "Torus .4 .1 0 360 -1e30",
                              "Torus .4 .1 0 1e9 360", "Disk 0 .5 1e20"}) {
        RibWorlds r(kSmall + "WorldBegin " + turns + " WorldEnd");
        ASSERT_EQ(r.world().meshes.size(), 1u) << turns;
        EXPECT_LT(r.world().meshes[0].groups[0].triangles.size(), 6000u) << turns;
    }
}

// As many triangles as one may have, in a time that is theirs, and a finding.
TEST(RiExtremes, HugeSurfacesAreLimited) {
    for (const char* huge : {"Sphere 1e6 -1e6 1e6 360", "Scale 1e30 1e30 1e30 Sphere 1 -1 1 360",
                             "Torus 1e9 1e8 0 360 360", "Paraboloid 1e6 0 1e6 360"}) {
        const std::clock_t begin = std::clock();
        RibWorlds r(kSmall + "WorldBegin " + huge + " WorldEnd");
        EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 5) << huge;
        ASSERT_EQ(r.world().meshes.size(), 1u) << huge;
        EXPECT_LE(r.world().meshes[0].groups[0].triangles.size(), 3'000'000u) << huge;
        EXPECT_EQ(r.count("RI_RANGE"), 1) << huge << r.findings();
    }
}

TEST(RiExtremes, SingularTransformations) {
    for (const char* flat : {"Scale 0 0 0", "Scale 1 0 1", "Scale 1 1 0",
                             "ConcatTransform [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]",
                             "Transform [1 1 1 0 1 1 1 0 1 1 1 0 0 0 0 1]",
                             "Scale 1e-30 1e-30 1e-30", "Scale 1e30 1e30 1e30", "Rotate 90 0 0 0",
                             "Skew 90 0 1 0 1 0 0", "Skew 45 0 1 0 0 1 0", "Skew 45 0 0 0 0 0 0"}) {
        RibPicture r = with_good(std::string(flat) +
                                 " Surface \"matte\" LightSource \"pointlight\" 1 " + kGood);
        EXPECT_TRUE(r.covers(8, 8)) << flat << r.findings();
        RibPicture camera(kSmall + flat + " WorldBegin " + kGood + "WorldEnd");
        RibPicture projection(
            kSmall + flat +
            " Projection \"orthographic\" WorldBegin CoordSysTransform \"screen\" " + kGood +
            "WorldEnd");
        EXPECT_EQ(projection.film.width, 16);
    }
}

TEST(RiExtremes, CountsThatContradictEachOther) {
    for (const char* bad :
         {"PointsPolygons [3] [0 1 9] \"P\" [0 0 1 1 0 1 0 1 1]",
          "PointsPolygons [3] [0 1 -2] \"P\" [0 0 1 1 0 1 0 1 1]",
          "PointsPolygons [2000000000] [0 1 2] \"P\" [0 0 1 1 0 1 0 1 1]",
          "PointsPolygons [-3] [0 1 2] \"P\" [0 0 1 1 0 1 0 1 1]",
          "GeneralPolygon [3 2000000000] \"P\" [0 0 1 1 0 1 0 1 1]",
          "PointsGeneralPolygons [9] [3] [0 1 2] \"P\" [0 0 1 1 0 1 0 1 1]",
          "PatchMesh \"bilinear\" 2000000 \"nonperiodic\" 2000000 \"nonperiodic\" \"P\" [0 0 0]",
          "PatchMesh \"bicubic\" 3 \"nonperiodic\" 4 \"nonperiodic\" \"P\" [0 0 0]",
          "NuPatch 2000000000 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0]",
          "NuPatch 2 9 [0 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [0 0 0]", "Sphere 1 -1", "Sphere",
          "Polygon \"Q\" [0 0 0]", "Patch \"bilinear\" \"P\" [0 0 0]", "Polygon \"P\" [0 0 1 1]"}) {
        RibPicture r = with_good(bad);
        EXPECT_TRUE(r.covers(8, 8)) << bad;
        EXPECT_NE(r.findings(), "") << bad;
    }
}

TEST(RiExtremes, DeepBlocks) {
    constexpr int kDepth = 10'000;
    std::string text = "WorldBegin ";
    for (int i = 0; i < kDepth; ++i) text += "AttributeBegin Translate 0 0 .001 ";
    text += kGood;
    for (int i = 0; i < kDepth; ++i) text += "AttributeEnd ";
    RibWorlds r(text + kGood + "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    expect_near(r.primitive(0).place({}), {0, 0, 10}, 1e-3);
    expect_near(r.primitive(1).place({}), {0, 0, 0});
    EXPECT_EQ(r.findings(), "");
}

TEST(RiExtremes, DeepBlocksOfEachKind) {
    constexpr int kDepth = 10'000;
    for (auto [begin, end] : {std::pair{"TransformBegin Scale .999 1 1 ", "TransformEnd "},
                              {"SolidBegin \"union\" ", "SolidEnd "},
                              {"ObjectBegin 1 ", "ObjectEnd "},
                              {"ArchiveBegin \"a\" ", "ArchiveEnd "},
                              {"IfBegin \"1\" ", "IfEnd "},
                              {"FrameBegin 1 ", "FrameEnd "},
                              {"MotionBegin [0 1] ", "MotionEnd "}}) {
        std::string text = kSmall;
        for (int i = 0; i < kDepth; ++i) text += begin;
        for (int i = 0; i < kDepth; ++i) text += end;
        RibWorlds closed(text + "WorldBegin " + kGood + "WorldEnd");
        EXPECT_EQ(closed.primitives().size(), 1u) << begin << closed.findings();
        RibWorlds open(kSmall + "WorldBegin " + kGood + text.substr(0, text.size() / 2));
        EXPECT_EQ(open.primitives().size(), 1u) << begin;
    }
}

// The promise is of 10^6: KINORA_RIB_SPHERES=1000000.
TEST(RiExtremes, ManySpheres) {
    const int kCount = int(fuzz_setting("KINORA_RIB_SPHERES", 100'000));
    std::string text = "WorldBegin ";
    for (int i = 0; i < kCount; ++i)
        text += fmt::format(
            "TransformBegin Translate {} {} 5 Color {} 0 0 Sphere .01 -.01 .01 360 TransformEnd ",
            i % 300, i / 300, i % 7);
    const std::clock_t begin = std::clock();
    RibWorlds r(text + "WorldEnd");
    EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, kCount * 3e-4);
    // They are of one look but for their colours, and join.
    EXPECT_EQ(r.world().materials.size(), 1u);
    size_t colors = 0, triangles = 0;
    for (const MeshDefinition& mesh : r.world().meshes) {
        triangles += mesh.groups[0].triangles.size() / 3;
        for (const VertexAttribute& a : mesh.groups[0].attributes)
            if (a.semantic == "Cs") colors += a.values.size() / 3;
    }
    EXPECT_LT(r.world().meshes.size(), 100u);
    EXPECT_EQ(colors, size_t(kCount));
    EXPECT_GE(triangles, 8 * size_t(kCount));
    EXPECT_LE(triangles, 200 * size_t(kCount));
}

}  // namespace
}  // namespace kinora::ri
