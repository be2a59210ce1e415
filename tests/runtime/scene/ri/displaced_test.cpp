// tests/runtime/scene/ri/displaced_test.cpp: displaced curves, and surfaces whose u, v are not
// their s, t.
#include "tests/runtime/scene/ri/rib_scene.h"

namespace kinora::ri {
namespace {

const char* const kSwell =
    "displacement swell(float by = 0.25;) { P += by * normalize(N); N = calculatenormal(P); }";
const char* const kShowDs =
    "surface show_ds() { Oi = 1; Ci = color(0.25 * Du(s), 0.25 * Dv(t), u); }";

// A sphere of radius 0.5, moved out by 0.25: pixels are 1/8 wide, and what is within 0.75 of the
// middle is there.
TEST(RiDisplaced, SphereIsLarger) {
    RibFolder folder;
    folder.file("swell.sl", kSwell);
    RibPicture picture(
        folder.search() + kSmall +
        "WorldBegin Translate 0 0 2 Attribute \"displacementbound\" \"sphere\" 0.3 "
        "Displacement \"swell\" Surface \"constant\" Sphere 0.5 -0.5 0.5 360 WorldEnd");
    int inside = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            double px = (x + 0.5) / 8 - 1, py = (y + 0.5) / 8 - 1;
            bool wanted = px * px + py * py < 0.75 * 0.75;
            inside += wanted;
            EXPECT_EQ(picture.covers(x, y), wanted) << x << ',' << y;
        }
    EXPECT_EQ(inside, picture.covered());
}

// The patch spans the picture: u grows with x, v with y. s runs twice as fast, t four times.
TEST(RiDisplaced, TextureCoordinatesHaveTheirOwnSlopes) {
    RibFolder folder;
    folder.file("show_ds.sl", kShowDs).file("swell.sl", kSwell);
    for (const char* moved : {"", "Displacement \"swell\" \"by\" 0.01 "}) {
        RibPicture picture(folder.search() + kSmall + "WorldBegin Translate 0 0 2 " + moved +
                           "Surface \"show_ds\" TextureCoordinates 0 0 2 0 0 4 2 4 "
                           "Patch \"bilinear\" \"P\" [-1 -1 0 1 -1 0 -1 1 0 1 1 0] WorldEnd");
        picture.expect(3, 3, {0.5, 1, 3.5 / 16}, 1e-3);
        picture.expect(12, 8, {0.5, 1, 12.5 / 16}, 1e-3);
    }
}

}  // namespace
}  // namespace kinora::ri
