// tests/runtime/scene/ri/film_test.cpp: world blocks as the frames of a film.
#include "runtime/scene/ri/import/film.h"

#include "rib_scene.h"

namespace kinora::ri {
namespace {

std::string frame(int number, const std::string& mode) {
    return "FrameBegin " + std::to_string(number) + " Display \"a\" \"file\" \"" + mode +
           "\" WorldBegin WorldEnd FrameEnd ";
}

// "number:world" of each frame; a * shows colors.
std::string frames_of(const std::string& text) {
    std::string found;
    for (const FilmFrame& frame : film_of({"x.rib", text}).frames)
        found += std::to_string(frame.number) + ":" + std::to_string(frame.world) +
                 (frame.colors ? "* " : " ");
    return found;
}

TEST(RiFilm, WorldsWithoutAFrameAreCounted) {
    EXPECT_EQ(frames_of("WorldBegin WorldEnd WorldBegin WorldEnd"), "1:0* 2:1* ");
    EXPECT_EQ(frames_of("Sphere 1 -1 1 360"), "");
}

TEST(RiFilm, FramesStandInTheOrderOfTheirNumbers) {
    EXPECT_EQ(frames_of(frame(20, "rgb") + frame(-3, "rgba") + frame(5, "z")), "-3:1* 5:2 20:0* ");
}

TEST(RiFilm, OfOneNumberTheLastPictureWithColorsCounts) {
    EXPECT_EQ(frames_of(frame(1, "z") + frame(1, "rgb") + frame(1, "rgba") + frame(1, "z")),
              "1:2* ");
    EXPECT_EQ(frames_of(frame(1, "z") + frame(1, "z")), "1:1 ");
    EXPECT_EQ(frames_of("FrameBegin 4 Display \"m\" \"zfile\" \"z\" WorldBegin WorldEnd Display "
                        "\"a\" \"file\" \"rgb\" WorldBegin WorldEnd FrameEnd"),
              "4:1* ");
}

TEST(RiFilm, ADisplayBesideAMapShowsColors) {
    EXPECT_EQ(frames_of("Display \"m\" \"zfile\" \"z\" Display \"+a\" \"file\" \"rgb\" WorldBegin "
                        "WorldEnd"),
              "1:0* ");
}

TEST(RiFilm, BeginsWithItsFirstColorsAndHoldsAFrameThroughAGap) {
    const FilmFrames film =
        film_of({"x.rib", frame(2, "z") + frame(3, "rgb") + frame(9, "rgb") + frame(10, "z")});
    EXPECT_EQ(film.beginning(), 1u);
    EXPECT_EQ(film_of({"x.rib", frame(2, "z") + frame(3, "z")}).beginning(), 1u);
    const std::pair<double, size_t> expected[] = {{-5, 0}, {2, 0}, {2.9, 0},  {3, 1},
                                                  {8, 1},  {9, 2}, {10.5, 3}, {1e9, 3}};
    for (auto [time, at] : expected) EXPECT_EQ(film.at(time), at) << time;
}

// So that an edit finds them in the next picture.
TEST(RiFilm, ShadersHaveTheSameNamesInEachPicture) {
    const std::string ball = "Sphere 1 -1 1 360 ", matte = "Surface \"matte\" ",
                      metal = "Surface \"metal\" ", low = "Surface \"matte\" \"float Kd\" [0.5] ";
    RibWorlds r("WorldBegin LightSource \"pointlight\" 7 " + matte + ball + low + ball +
                "WorldEnd WorldBegin LightSource \"ambientlight\" 1 LightSource \"pointlight\" 2 " +
                metal + ball + matte + ball + "WorldEnd");
    const auto ids = [&](size_t world) {
        std::string found;
        for (const MaterialDefinition& one : r.world(world).materials) found += one.id + ", ";
        for (const LightDefinition& one : r.world(world).lights) found += one.id + ", ";
        return found;
    };
    EXPECT_EQ(ids(0), "matte, matte 2, pointlight, ");
    EXPECT_EQ(ids(1), "metal, matte, ambientlight, pointlight, ");
}

}  // namespace
}  // namespace kinora::ri
