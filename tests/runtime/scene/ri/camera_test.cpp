// tests/runtime/scene/ri/camera_test.cpp: which pixels a camera's options put things on.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

// x right, y up, z into the picture; a square of `size` about (x, y, z).
std::string square(double x, double y, double z, double size, const std::string& color = "1 1 1") {
    return fmt::format(
        "AttributeBegin Surface \"constant\" Color {} Translate {} {} {} Scale {} {} 1 "
        "Polygon \"P\" [-.5 -.5 0 -.5 .5 0 .5 .5 0 .5 -.5 0] AttributeEnd ",
        color, x, y, z, size, size);
}

std::string world(const std::string& inside) {
    return "WorldBegin " + inside + "WorldEnd ";
}

void expect_window(const RibWorlds& r, std::array<double, 4> want) {
    ASSERT_TRUE(r.world().cameras[0].window);
    for (size_t i = 0; i < 4; ++i)
        EXPECT_NEAR((*r.world().cameras[0].window)[i], want[i], 1e-6) << i;
}

TEST(RiCamera, DefaultsAreThoseOfTheInterface) {
    RibWorlds r(world(""));
    EXPECT_EQ(r.picture().width, 640);
    EXPECT_EQ(r.picture().height, 480);
    EXPECT_TRUE(r.world().cameras[0].orthographic);
    expect_window(r, {-4 / 3., 4 / 3., -1, 1});
}

TEST(RiCamera, FormatKeepsWhatIsBelowZero) {
    RibWorlds r("Format 200 100 -1 " + world(""));
    EXPECT_EQ(r.picture().width, 200);
    EXPECT_EQ(r.picture().height, 100);
    EXPECT_EQ(r.picture().pixel_aspect, 1);
    expect_window(r, {-2, 2, -1, 1});
    RibWorlds size("Format -1 -1 2 " + world(""));
    EXPECT_EQ(size.picture().width, 640);
    EXPECT_EQ(size.picture().height, 480);
    expect_window(size, {-8 / 3., 8 / 3., -1, 1});
}

TEST(RiCamera, TallPicturesSpanOneAcross) {
    RibWorlds r("Format 100 200 1 " + world(""));
    expect_window(r, {-1, 1, -2, 2});
}

// Wider than the format: the width stays. Narrower: the height does.
TEST(RiCamera, FrameAspectRatioShrinksThePicture) {
    RibWorlds wide("Format 200 100 1 FrameAspectRatio 4 " + world(""));
    EXPECT_EQ(wide.picture().width, 200);
    EXPECT_EQ(wide.picture().height, 50);
    expect_window(wide, {-4, 4, -1, 1});
    RibWorlds narrow("FrameAspectRatio 1 Format 200 100 1 " + world(""));
    EXPECT_EQ(narrow.picture().width, 100);
    EXPECT_EQ(narrow.picture().height, 100);
    expect_window(narrow, {-1, 1, -1, 1});
    RibWorlds none("FrameAspectRatio 0 " + world(""));
    EXPECT_EQ(none.count("RI_RANGE"), 1);
    EXPECT_EQ(none.picture().height, 480);
}

TEST(RiCamera, ScreenWindowWinsOverTheAspect) {
    RibWorlds r("Format 100 100 1 ScreenWindow 0 4 -3 1 " + world(""));
    expect_window(r, {0, 4, -3, 1});
    EXPECT_EQ(r.picture().width, 100);
    RibWorlds no_area("ScreenWindow 1 1 -1 1 " + world(""));
    EXPECT_EQ(no_area.count("RI_RANGE"), 1);
    expect_window(no_area, {-4 / 3., 4 / 3., -1, 1});
}

// 16 pixels for 4 units: a unit square about (1, 0) covers x from 2 to 6 of pixels, and y likewise.
TEST(RiCamera, OffCentreWindowsShowWhatLiesInThem) {
    RibPicture r(kSmall + "ScreenWindow 0 4 -3 1 " + world(square(1, 0, 3, 1)));
    EXPECT_EQ(r.covered(), 16);
    EXPECT_TRUE(r.covers(2, 2) && r.covers(5, 5));
    EXPECT_FALSE(r.covers(1, 2) || r.covers(6, 5) || r.covers(2, 1) || r.covers(5, 6));
}

TEST(RiCamera, MirroredWindowsMirrorThePicture) {
    RibPicture r(kSmall + "ScreenWindow 1 -1 -1 1 " + world(square(.75, .75, 3, .5)));
    EXPECT_EQ(r.covered(), 16);
    EXPECT_TRUE(r.covers(0, 0) && r.covers(3, 3));
    RibPicture up(kSmall + "ScreenWindow -1 1 1 -1 " + world(square(.75, .75, 3, .5)));
    EXPECT_EQ(up.covered(), 16);
    EXPECT_TRUE(up.covers(12, 12) && up.covers(15, 15));
}

// RiCropWindow: from ceil(xres xmin) to ceil(xres xmax - 1).
TEST(RiCamera, CropWindowsLeaveTheirPixels) {
    RibWorlds r("Format 100 50 1 CropWindow .25 .5 .5 1 " + world(""));
    EXPECT_EQ(r.picture().left, 25);
    EXPECT_EQ(r.picture().width, 25);  // 25 .. 49
    EXPECT_EQ(r.picture().top, 25);
    EXPECT_EQ(r.picture().height, 25);
    EXPECT_EQ(r.picture().full_width, 100);
    EXPECT_EQ(r.picture().full_height, 50);
    expect_window(r, {-1, 0, -1, 0});
    RibWorlds bad("CropWindow .5 .25 0 1 " + world(""));
    EXPECT_EQ(bad.count("RI_RANGE"), 1);
    EXPECT_EQ(bad.picture().width, 640);
}

// Parts that floats do not hold exactly; together they have each pixel once.
TEST(RiCamera, CropWindowsOfTenthsMeet) {
    int next = 0;
    for (int i = 0; i < 10; ++i) {
        RibWorlds r(fmt::format("Format 640 480 1 CropWindow 0.{} {} 0 1 ", i,
                                i == 9 ? "1" : fmt::format("0.{}", i + 1)) +
                    world(""));
        EXPECT_EQ(r.picture().left, 64 * i);
        EXPECT_EQ(r.picture().left, next);
        EXPECT_EQ(r.picture().width, 64);
        next = r.picture().left + r.picture().width;
    }
}

TEST(RiCamera, ACropWindowShowsThePartOfTheWholePicture) {
    const std::string things =
        square(.25, .25, 3, .5, "1 0 0") + square(-.75, -.75, 3, .5, "0 1 0");
    RibPicture whole(kSmall + world(things));
    RibPicture part(kSmall + "CropWindow .5 1 .25 .75 " + world(things));
    ASSERT_EQ(part.film.width, 8);
    ASSERT_EQ(part.film.height, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(part.at(x, y), whole.at(x + 8, y + 4));
    EXPECT_EQ(part.covered(), 16);
}

// tan(30 deg) = 0.57735: at z = 2 the smaller side spans 2.309 units.
TEST(RiCamera, FovIsThatOfTheSmallerSide) {
    const double half = 0.5773503;
    RibWorlds wide("Format 200 100 1 Projection \"perspective\" \"fov\" 60 " + world(""));
    EXPECT_FALSE(wide.world().cameras[0].orthographic);
    expect_window(wide, {-2 * half, 2 * half, -half, half});
    RibWorlds tall("Format 100 200 1 Projection \"perspective\" \"fov\" [60] " + world(""));
    expect_window(tall, {-half, half, -2 * half, 2 * half});
    RibWorlds none("Format 100 100 1 Projection \"perspective\" " + world(""));
    expect_window(none, {-1, 1, -1, 1});  // 90 degrees
    RibWorlds window("Projection \"perspective\" \"fov\" 60 ScreenWindow -1 2 -1 1 " + world(""));
    expect_window(window, {-half, 2 * half, -half, half});
}

// At 90 degrees and z = 4 the picture spans 8 units: 2 pixels a unit.
TEST(RiCamera, PerspectiveDividesByZ) {
    RibPicture r(kSmall + "Projection \"perspective\" \"fov\" 90 " + world(square(2, 1, 4, 2)));
    EXPECT_EQ(r.covered(), 16);
    EXPECT_TRUE(r.covers(10, 4) && r.covers(13, 7));
}

TEST(RiCamera, AxesAreRightUpAndInto) {
    RibPicture r(kSmall + world(square(.75, 0, 3, .5, "1 0 0") + square(0, .75, 3, .5, "0 1 0") +
                                square(0, 0, 3, .5, "0 0 1") + square(0, 0, 4, .5, "1 1 1")));
    r.expect(14, 8, {1, 0, 0});
    r.expect(8, 1, {0, 1, 0});
    r.expect(8, 8, {0, 0, 1});  // the nearer one
    RibPicture behind(kSmall + world(square(0, 0, -3, .5)));
    EXPECT_EQ(behind.covered(), 0);
}

TEST(RiCamera, AMirrorBeforeTheWorldMirrorsThePicture) {
    RibPicture r(kSmall + "Scale -1 1 1 " + world(square(.75, .25, 3, .5)));
    EXPECT_EQ(r.covered(), 16);
    EXPECT_TRUE(r.covers(0, 4) && r.covers(3, 7));
}

TEST(RiCamera, TheTransformationAtWorldBeginPlacesTheWorld) {
    RibPicture r(kSmall + "Projection \"orthographic\" Translate .5 0 3 Rotate 90 0 0 1 " +
                 world(square(.25, 0, 0, .5)));  // to (0, .25), then to (.5, .25)
    EXPECT_EQ(r.covered(), 16);
    EXPECT_TRUE(r.covers(10, 4) && r.covers(13, 7));
}

// It stands between the camera and the screen, and the camera's own begins at the identity.
TEST(RiCamera, TheTransformationAtProjectionIsPartOfIt) {
    RibPicture r(kSmall + "Translate .5 0 0 Projection \"orthographic\" " +
                 world(square(.25, .25, 3, .5)));
    EXPECT_EQ(r.covered(), 16);
    EXPECT_TRUE(r.covers(12, 4) && r.covers(15, 7));
    RibPicture scaled(kSmall + "Scale 2 2 1 Projection \"orthographic\" " +
                      world(square(.25, .25, 3, .5)));
    EXPECT_EQ(scaled.covered(), 64);
    EXPECT_TRUE(scaled.covers(8, 0) && scaled.covers(15, 7));
}

// Mirrors and sizes of z: x / z is a third of what it was.
TEST(RiCamera, SizesAtProjectionArePartOfIt) {
    RibPicture mirrored(kSmall + "Scale -1 1 1 Projection \"orthographic\" " +
                        world(square(.75, .25, 3, .5)));
    EXPECT_EQ(mirrored.covered(), 16);
    EXPECT_TRUE(mirrored.covers(0, 4) && mirrored.covers(3, 7));
    // [3, 9] x [0, 6] at z = 4 * 3 = 12 of a picture that spans 24: 1.5 units a pixel.
    RibPicture deep(kSmall + "Scale 1 1 3 Projection \"perspective\" \"fov\" 90 " +
                    world(square(6, 3, 4, 6)));
    EXPECT_EQ(deep.covered(), 16);
    EXPECT_TRUE(deep.covers(10, 4) && deep.covers(13, 7));
    // It looks along -z.
    RibPicture back(kSmall + "Scale 1 1 -1 Projection \"orthographic\" " +
                    world(square(.75, .25, -3, .5) + square(-.75, .25, 3, .5)));
    EXPECT_EQ(back.covered(), 16);
    EXPECT_TRUE(back.covers(12, 4) && back.covers(15, 7));
}

TEST(RiCamera, TheLastProjectionCounts) {
    RibPicture r(kSmall +
                 "Projection \"perspective\" Translate 9 9 9 Projection \"orthographic\" " +
                 "Identity " + world(square(.25, .25, 3, .5)));
    EXPECT_TRUE(r.scene.imported()->description.cameras[0].orthographic);
    RibWorlds two(
        "Projection \"perspective\" \"fov\" 10 Projection \"perspective\" \"fov\" 90 "
        "Format 10 10 1 " +
        world(square(0, 0, 1, 1)));
    expect_window(two, {-1, 1, -1, 1});
    expect_near(two.primitive().center(), {0, 0, 1});
}

TEST(RiCamera, ClippingHidesWhatIsNearerOrFarther) {
    const std::string things = square(-.5, 0, 1, 1, "1 0 0") + square(.5, 0, 10, 1, "0 1 0");
    RibPicture near(kSmall + "Clipping 2 20 " + world(things));
    EXPECT_FALSE(near.covers(4, 8));
    EXPECT_TRUE(near.covers(12, 8));
    RibPicture far(kSmall + "Clipping .1 5 " + world(things));
    EXPECT_TRUE(far.covers(4, 8));
    EXPECT_FALSE(far.covers(12, 8));
    RibWorlds wrong("Clipping 5 1 " + world(""));
    EXPECT_EQ(wrong.count("RI_RANGE"), 1);
}

TEST(RiCamera, SamplesFiltersAndExposureAreKept) {
    RibWorlds r(
        "PixelSamples 3 4 PixelFilter \"mitchell\" 4 4 Exposure 2 2.2 Quantize \"rgba\" 1023 0 "
        "1023 0 Display \"a.tif\" \"file\" \"rgba\" Display \"+b.tif\" \"file\" \"z\" " +
        world(""));
    EXPECT_EQ(r.picture().samples, 12);
    EXPECT_EQ(r.picture().filter, "mitchell");
    EXPECT_EQ(r.picture().filter_width, 4);
    EXPECT_EQ(r.picture().exposure.gain, 2);
    EXPECT_NEAR(r.picture().exposure.gamma, 2.2, 1e-6);
    ASSERT_EQ(r.picture().displays.size(), 2u);
    EXPECT_EQ(r.picture().displays[0].name, "a.tif");
    EXPECT_EQ(r.picture().displays[0].quantization->one, 1023);
    EXPECT_EQ(r.picture().displays[1].name, "b.tif");
    EXPECT_EQ(r.picture().displays[1].mode, "z");
    EXPECT_EQ(r.picture().displays[1].quantization->one, 0);
}

TEST(RiCamera, ADisplayWithoutPlusReplacesThoseBefore) {
    RibWorlds r(
        "Display \"a\" \"file\" \"rgb\" Display \"+b\" \"file\" \"a\" Display \"c\" \"file\" "
        "\"rgba\" " +
        world(""));
    ASSERT_EQ(r.picture().displays.size(), 1u);
    EXPECT_EQ(r.picture().displays[0].name, "c");
}

// Before an edge at pixel 8 the integrals of Catmull and Rom's filter, which is below 0 beyond 1:
// 1/2 + the integral to 1/2, and to 3/2.
TEST(RiCamera, FiltersHaveTheirLobes) {
    RibPicture r(
        "Format 16 16 1 PixelSamples 32 32 PixelFilter \"catmull-rom\" 4 4 WorldBegin Surface "
        "\"constant\" Translate 0 0 5 Polygon \"P\" [-2 -2 0 -2 2 0 0 2 0 0 -2 0] WorldEnd");
    EXPECT_EQ(r.findings(), "");
    const double at_half = 0.5 + 0.5 - 2.5 / 24 + 1.5 / 64;
    const double at_three_halves = 0.5 + 13.0 / 24 - 0.02865;
    auto column = [&](int x) {
        double sum = 0;
        for (int y = 4; y < 12; ++y) sum += double(r.at(x, y).w) / 8;
        return sum;
    };
    EXPECT_NEAR(column(7), at_half, 0.004);
    EXPECT_NEAR(column(8), 1 - at_half, 0.004);
    EXPECT_NEAR(column(6), at_three_halves, 0.004);
    EXPECT_NEAR(column(9), 1 - at_three_halves, 0.004);
    EXPECT_NEAR(r.at(2, 8).w, 1, 1e-5);
    EXPECT_NEAR(r.at(13, 8).w, 0, 1e-5);
}

TEST(RiCamera, FiltersOfNamesThatWeDoNotHaveAreTabulated) {
    for (const char* filter : {"\"box\" 2 2", "\"gaussian\" 3 3", "\"triangle\" 2 2"})
        EXPECT_TRUE(RibWorlds(std::string("PixelFilter ") + filter + " WorldBegin WorldEnd")
                        .picture()
                        .filter_values.empty())
            << filter;
    for (const char* filter :
         {"\"box\" 1 2", "\"disk\" 3 3", "\"sinc\" 4 4", "\"bessel\" 7 7", "\"mitchell\" 4 4"}) {
        RibWorlds r(std::string("PixelFilter ") + filter + " WorldBegin WorldEnd");
        EXPECT_EQ(r.picture().filter_values.size(), 64u * 64u) << filter << r.findings();
    }
}

// (gain colour) ^ (1 / gamma): (2 * 0.125) ^ (1/2) = 0.5.
TEST(RiCamera, ExposureIsGainAndGamma) {
    RibPicture r(kSmall + "Exposure 2 2 " + world(square(0, 0, 3, 2, ".125 .5 .02")));
    r.expect(8, 8, {.5, 1, .2});
}

}  // namespace
}  // namespace kinora::ri
