// tests/runtime/scene/ri/displays_test.cpp: what displays show besides the picture.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// Their lower left half of the picture, 3 and 2 before the eye.
const std::string kFarPart = "Polygon \"P\" [-1 -1 3 -1 1 3 1 -1 3] ";
const std::string kNearPart = "Polygon \"P\" [-1 -1 2 -1 1 2 0 -1 2] ";

std::string added_displays(std::initializer_list<const char*> modes) {
    std::string text;
    for (const char* mode : modes)
        text += std::string("Display \"+") + mode + ".tif\" \"file\" \"" + mode + "\" ";
    return text;
}

std::string world_of(const std::string& inside) {
    return "WorldBegin Surface \"constant\" " + inside + "WorldEnd";
}

TEST(RiDisplays, ZIsTheNearestSamplesAndUnfiltered) {
    const std::string several = "PixelSamples 4 4 PixelFilter \"gaussian\" 2 2 ";
    RibPicture r(kSmall + several + added_displays({"z"}) + world_of(kFarPart));
    EXPECT_EQ(r.plane("z", 2, 13), 3);
    EXPECT_EQ(r.plane("z", 13, 2), raytrace::kNoDepth);
    EXPECT_EQ(r.plane("z", 8, 8), 3);  // of which half the samples miss
    EXPECT_LT(r.at(8, 8).w, 1);
    RibPicture both(kSmall + several + added_displays({"z"}) + world_of(kFarPart + kNearPart));
    EXPECT_EQ(both.plane("z", 2, 8), 2);
}

// Not the distance from the eye.
TEST(RiDisplays, ZIsAlongTheCameras) {
    RibPicture r("Format 16 16 1 PixelSamples 1 1 Projection \"perspective\" \"fov\" 90 " +
                 added_displays({"z"}) + world_of("Polygon \"P\" [-5 -5 3 -5 5 3 5 5 3 5 -5 3] "));
    for (int x : {0, 8, 15}) EXPECT_NEAR(r.plane("z", x, 1), 3, 1e-6);
}

TEST(RiDisplays, GlobalsOfSurfacesAreThere) {
    RibPicture r(kSmall + added_displays({"N", "P", "Cs", "s", "u"}) +
                 world_of("Color .25 .5 1 Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] "
                          "\"st\" [0 0 0 1 1 1 1 0] "));
    EXPECT_EQ(r.plane("N.Z", 8, 8), -1);
    EXPECT_NEAR(r.plane("P.X", 12, 3), 12.5 / 8 - 1, 1e-6);
    EXPECT_NEAR(r.plane("P.Y", 12, 3), 1 - 3.5 / 8, 1e-6);
    EXPECT_EQ(r.plane("P.Z", 12, 3), 3);
    EXPECT_EQ(r.plane("Cs.R", 8, 8), .25f);
    EXPECT_EQ(r.plane("Cs.B", 8, 8), 1);
    EXPECT_NEAR(r.plane("s", 12, 3), 12.5 / 16, 1e-6);
    EXPECT_EQ(r.findings(), "");
}

TEST(RiDisplays, OutputsOfShadersAreThereWhateverTheOthersHave) {
    RibFolder folder;
    folder.file("two.sl",
                "surface two(output varying color glow = 0; output varying float N2 = 0;) "
                "{ Oi = 1; Ci = 1; glow = color(.5, 0, 1); N2 = 7; }");
    const std::string text = kSmall + folder.search() +
                             "Display \"+g\" \"file\" \"varying color glow\" " +
                             added_displays({"N2"}) + "WorldBegin Surface \"constant\" " +
                             kFarPart + "Surface \"two\" " + kNearPart + "WorldEnd";
    RibPicture r(text);
    EXPECT_EQ(r.plane("glow.R", 2, 10), .5f) << r.findings();
    EXPECT_EQ(r.plane("glow.B", 2, 10), 1);
    EXPECT_EQ(r.plane("N2", 2, 10), 7);
    EXPECT_EQ(r.plane("N2", 8, 13), 0);
}

TEST(RiDisplays, OfWhatNoSurfaceHasAreReported) {
    RibPicture r(kSmall + added_displays({"glow", "Cl"}) + world_of(kFarPart));
    EXPECT_EQ(r.count("RI_OUTPUT_UNKNOWN"), 2) << r.findings();
    EXPECT_NE(r.findings().find("glow.tif"), std::string::npos);
    EXPECT_TRUE(r.film.aovs.empty());
}

// A hole shows nothing but where it is.
TEST(RiDisplays, OfMattesAreZero) {
    RibPicture r(kSmall + added_displays({"Cs", "z"}) + world_of("Matte 1 " + kFarPart));
    EXPECT_EQ(r.plane("Cs.R", 2, 13), 0);
    EXPECT_EQ(r.plane("z", 2, 13), 3);
}

TEST(RiDisplays, HaveTheirOwnQuantizationAndExposure) {
    RibWorlds r(
        "Display \"N.tif\" \"file\" \"N\" \"quantize\" [128 255 0 255] \"exposure\" [2 1.5] "
        "Display \"+s.tif\" \"file\" \"s\" Display \"+g.tif\" \"file\" \"float g\" "
        "Quantize \"s\" 100 0 100 0 Quantize \"rgba\" 0 0 0 0 WorldBegin WorldEnd");
    EXPECT_EQ(r.findings(), "");
    ASSERT_EQ(r.picture().displays.size(), 3u);
    const FileDisplay& N = r.picture().displays[0];
    EXPECT_EQ(N.quantization->zero, 128);
    EXPECT_EQ(N.quantization->one, 255);
    EXPECT_EQ(N.exposure->gain, 2);
    EXPECT_EQ(r.picture().displays[1].quantization->one, 100);
    EXPECT_FALSE(r.picture().displays[2].quantization->is_whole());
}

TEST(RiDisplays, WrongNumbersAreReported) {
    for (const char* wrong : {"\"exposure\" [0 1]", "\"quantize\" [0 255 9 8]"})
        EXPECT_EQ(RibWorlds("Display \"a\" \"file\" \"rgb\" " + std::string(wrong) +
                            " WorldBegin WorldEnd")
                      .count("RI_RANGE"),
                  1)
            << wrong;
    EXPECT_EQ(RibWorlds("Quantize \"rgba\" 255 9 8 0 WorldBegin WorldEnd").count("RI_RANGE"), 1);
}

}  // namespace
}  // namespace kinora::ri
