// tests/runtime/player/film_test.cpp: a RIB file with several pictures plays as a film.
#include <algorithm>
#include <filesystem>

#include "jit/compiler.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/player/clock.h"
#include "runtime/player/scene_maker.h"
#include "tests/runtime/player/played.h"

namespace kinora {
namespace {

std::string frame(int number, const std::string& camera, const std::string& look) {
    return "FrameBegin " + std::to_string(number) + "\n" + camera + "\nWorldBegin\n" + look +
           " Sphere 1 -1 1 360\nWorldEnd\nFrameEnd\n";
}

constexpr const char* kHead =
    "Format 64 36 1 PixelSamples 2 2 Projection \"perspective\" \"fov\" [40]\n";
constexpr const char* kMap = "Display \"map\" \"zfile\" \"z\" Translate 0 0 5";
constexpr const char* kAhead = "Translate 0 0 5";
constexpr const char* kAside = "Translate 0.5 0 5";
constexpr const char* kPlain = "surface plain() { Ci = Cs; Oi = 1; }";

// A map, and three pictures: red 3, green 7, blue 8, which is seen from another place.
std::string three_colors() {
    return kHead + frame(2, kMap, "Surface \"plain\"") +
           frame(3, kAhead, "Color [1 0 0] Surface \"plain\"") +
           frame(7, kAhead, "Color [0 1 0] Surface \"constant\"") +
           frame(8, kAside, "Color [0 0 1] Surface \"plain\"");
}

// A film in a folder of its own.
class FilmFile {
  public:
    explicit FilmFile(const std::string& text) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = testing::TempDir() + "kinora_film_" + test->name() + "/";
        std::filesystem::create_directories(folder_);
        write(shader(), kPlain);
        write(path(), text);
    }
    ~FilmFile() { std::filesystem::remove_all(folder_); }
    FilmFile(const FilmFile&) = delete;

    std::string path() const { return folder_ + "film.rib"; }
    std::string shader() const { return folder_ + "plain.sl"; }
    SceneRequest request() const {
        SceneRequest request = small_request(path());
        request.width = request.height = 0;
        return request;
    }

  private:
    std::string folder_;
};

Played played_in_time(const FilmFile& film) {
    return Played(film.request(), {true, true, nullptr});
}

// In the middle of the picture: "red", as far as the colors above go.
std::string color_in(Played& played) {
    EXPECT_TRUE(played.player.wait_idle(kLong));
    const std::shared_ptr<const Picture> picture = played.player.picture();
    if (!picture) return "none";
    const size_t middle = size_t(picture->height / 2 * picture->width + picture->width / 2);
    const uint8_t* rgb = &picture->rgba[4 * middle];
    std::string found;
    for (int c = 0; c < 3; ++c)
        if (rgb[c] > 128) found += "rgb"[c];
    return found.empty() ? "black" : found;
}

TEST(Film, OpensWithTheFirstPictureInColorsAndStepsOverGaps) {
    FilmFile film(three_colors());
    Played played(film.request());
    EXPECT_EQ(played.script("expect time 3; expect pixel 32 18 255 0 0; next; expect time 7; "
                            "expect pixel 32 18 0 255 0; next; expect pixel 36 18 0 0 255; next; "
                            "expect time 2; previous; expect time 8; first; expect time 2; last; "
                            "expect time 8; previous; expect pixel 32 18 0 255 0"),
              "");
    EXPECT_EQ(played.player.state().time.first, 2);
    EXPECT_EQ(played.player.state().time.last, 8);
}

TEST(Film, ScrubbingGoesToTheFrameThatIsSeenThen) {
    FilmFile film(three_colors());
    Played played(film.request());
    EXPECT_EQ(played.script("seek 6; expect time 3; expect pixel 32 18 255 0 0; seek 7.9; "
                            "expect time 7; expect pixel 32 18 0 255 0; seek 1000; expect time 8; "
                            "seek -4; expect time 2; previous_key; next_key"),
              "test:11:2: error: there is no key before this frame");
}

TEST(Film, PlaysToItsEndAndRefinesWhatStands) {
    FilmFile film(three_colors());
    Played played(film.request());
    EXPECT_EQ(played.script("loop once; play; wait 0.06; pause; expect time 7; "
                            "expect pixel 32 18 0 255 0; play; wait 1; expect time 8; "
                            "expect playback stands; expect pixel 36 18 0 0 255"),
              "");
    EXPECT_TRUE(played.player.picture()->refined);
    EXPECT_EQ(played.player.picture()->frame, 8);
}

TEST(Film, ByTheClockEveryFrameIsShown) {
    FilmFile film(three_colors());
    Played played = played_in_time(film);
    EXPECT_EQ(played.script("every_frame; seek 3; loop once; wait refined; play"), "");
    std::vector<double> seen;
    ASSERT_TRUE(played.until(
        [&] {
            const double frame = played.player.picture()->frame;
            if (seen.empty() || seen.back() != frame) seen.push_back(frame);
            return !played.player.state().time.playing && frame == 8;
        },
        0.01));
    EXPECT_EQ(seen, (std::vector<double>{3, 7, 8}));
    EXPECT_EQ(color_in(played), "b");
    EXPECT_TRUE(played.player.picture()->refined);
}

TEST(Film, OfManyOrdersTheLastCounts) {
    FilmFile film(three_colors());
    Played played = played_in_time(film);
    ASSERT_TRUE(played.player.wait_idle(kLong));
    const uint64_t before = played.player.made().scenes;
    for (int k = 0; k < 20; ++k) EXPECT_EQ(played.script("seek 2; seek 3; seek 8; seek 7"), "");
    EXPECT_TRUE(played.player.picture());  // the last one stays meanwhile
    EXPECT_EQ(color_in(played), "g");
    EXPECT_LT(played.player.made().scenes - before, 80u);
}

TEST(Film, ATextStaysWhereTheShaderIsTheSame) {
    FilmFile film(three_colors());
    Played played(film.request());
    EXPECT_EQ(played.script("select_material plain; edit"), "");
    Player& player = played.player;
    ASSERT_TRUE(player.run("set_text", {"surface plain() { Ci = 1 - Cs; Oi = 1; }"}).done);
    EXPECT_EQ(color_in(played), "gb");
    EXPECT_EQ(played.script("next"), "");
    EXPECT_EQ(color_in(played), "g");
    EXPECT_EQ(played.script("next"), "");
    EXPECT_EQ(color_in(played), "rg");
    EXPECT_EQ(played.script("undo"), "");
    EXPECT_EQ(color_in(played), "b");
    EXPECT_TRUE(player.findings().empty());
}

TEST(Film, ReloadsWithItsFrame) {
    FilmFile film(three_colors());
    Played played = played_in_time(film);
    EXPECT_EQ(played.script("seek 8; wait refined"), "");
    ASSERT_EQ(color_in(played), "b");
    const auto shows = [&](const std::string& color) {
        return played.until([&] { return played.player.idle() && color_in(played) == color; });
    };
    write(film.shader(), "surface plain() { Ci = color(1, Cs[1], 0); Oi = 1; }");
    EXPECT_TRUE(shows("r"));
    EXPECT_EQ(played.player.observe(Observable::Time), "frame 8");
    // Frame 8 goes, and 9 comes.
    write(film.path(), kHead + frame(3, kAhead, "Color [0 1 0] Surface \"constant\"") +
                           frame(9, kAhead, "Color [0 0 1] Surface \"constant\""));
    EXPECT_TRUE(shows("g"));
    EXPECT_EQ(played.player.observe(Observable::Time), "frame 3");
    EXPECT_EQ(played.script("next; expect time 9"), "");
    EXPECT_EQ(color_in(played), "b");
}

TEST(Film, TheUsersCameraStaysInTheWorldOfTheFile) {
    FilmFile film(three_colors());
    Played played(film.request());
    EXPECT_EQ(played.script("seek 7; orbit 30 20"), "");
    const FreeCamera before = played.player.state().camera.own;
    EXPECT_EQ(played.script("next; wait refined"), "");
    const CameraState& camera = played.player.state().camera;
    ASSERT_TRUE(camera.free);
    // The file's world lies 0.5 more to the right of its camera.
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(camera.own.pivot[c], before.pivot[c] + (c == 0 ? 0.5 : 0), 1e-9);
        EXPECT_NEAR(camera.own.axes[2][c], before.axes[2][c], 1e-9);
    }
    EXPECT_EQ(played.script("camera; wait refined"), "");
    EXPECT_EQ(color_in(played), "b");
}

TEST(Film, AWorldThatIsShearedGivesTheFilesCameraBack) {
    const std::string sheared = "Skew 30 0 1 0 1 0 0 Translate 0 0 5";
    FilmFile film(kHead + frame(1, kAhead, "Surface \"plain\"") +
                  frame(2, sheared, "Surface \"plain\""));
    Played played(film.request());
    EXPECT_EQ(played.script("orbit 30 20; next; wait refined; expect camera \"its own\""), "");
}

TEST(Film, AFrameThatCannotBeMadeLeavesThePicture) {
    FilmFile film(kHead + frame(1, kAhead, "Color [1 0 0] Surface \"constant\"") +
                  frame(2, kAhead, "Color [0 1 0] Surface \"broken\""));
    write(std::filesystem::path(film.path()).parent_path() / "broken.sl", "surface broken( {");
    Played played(film.request());
    ASSERT_EQ(color_in(played), "r");
    EXPECT_EQ(played.script("next; wait refined"), "");
    EXPECT_EQ(played.player.load_state(), LoadState::Ready);
    EXPECT_FALSE(played.player.findings().empty());
    EXPECT_EQ(played.script("previous; expect time 1"), "");
    EXPECT_EQ(color_in(played), "r");
}

// A mesh of 3200 triangles, which a film keeps.
std::string ground() {
    std::string text = "PointsPolygons [";
    for (int k = 0; k < 1600; ++k) text += "4 ";
    text += "] [";
    for (int k = 0; k < 1600; ++k) {
        const int at = k / 40 * 41 + k % 40;
        text += fmt::format("{} {} {} {} ", at, at + 1, at + 42, at + 41);
    }
    text += "] \"P\" [";
    for (int k = 0; k < 41 * 41; ++k)
        text += fmt::format("{} {} 0 ", (k % 41 - 20) / 10.0, (k / 41 - 20) / 10.0);
    return text + "]\n";
}

// What a scene maker made of a film's frames, in this order.
struct MadeFrames {
    int trees_built = 0, trees_kept = 0;
    size_t kernels = 0;  // compiled, from the second on
};
MadeFrames make_frames(const FilmFile& film, const std::vector<double>& frames) {
    News news;
    SceneMaker maker(news.bell(), false, false);
    MadeFrames all;
    std::unique_ptr<MadeScene> before;
    size_t first_kernels = 0;
    for (double frame : frames) {
        if (before)
            maker.show_frame(film.request(), {}, frame);
        else
            maker.open(film.request(), {}, true, StartTime{frame});
        std::unique_ptr<MadeScene> made;
        EXPECT_TRUE(news.await([&] { return (made = maker.take()) != nullptr; }));
        if (!made->shown) return all;
        FrameStats stats;
        EXPECT_TRUE(pose_frame(*made->shown->scene, *made->pose, 0, made->shown->settings, stats,
                               *made->diagnostics));
        all.trees_built += stats.rebuilds;
        all.trees_kept += stats.kept_trees;
        const size_t kernels = jit::cache_stats().kernels;
        if (!before) first_kernels = kernels;
        all.kernels = kernels - first_kernels;
        before = std::move(made);
    }
    return all;
}

TEST(Film, KeepsTreesAndKernelsFromFrameToFrame) {
    std::string text = kHead;
    for (int k = 1; k <= 6; ++k)
        text += frame(k, fmt::format("Translate 0 {} 5", 0.1 * k), "Surface \"plain\" " + ground());
    FilmFile film(text);
    const MadeFrames once = make_frames(film, {1});
    EXPECT_GT(once.trees_built, 0);
    EXPECT_EQ(once.trees_kept, 0);
    const MadeFrames all = make_frames(film, {1, 2, 3, 4, 5, 6, 1, 4});
    EXPECT_EQ(all.trees_built, once.trees_built);
    EXPECT_EQ(all.trees_kept, 7 * once.trees_built);
    EXPECT_EQ(all.kernels, 0u);
}

TEST(Film, MakesMapsOfEarlierWorldsOnce) {
    const std::string made = "MakeTexture \"map.tif\" \"map.tx\" \"clamp\" \"clamp\" \"box\" 1 1\n";
    const std::string wall =
        "Surface \"mapped\" \"map\" \"map.tx\" Polygon \"P\" [-2 -2 1 2 -2 1 2 2 1 -2 2 1] \"st\" "
        "[0 1 1 1 1 0 0 0]";
    std::string text = kHead +
                       frame(1, "Display \"map.tif\" \"file\" \"rgb\" Translate 0 0 5",
                             "Color [0 1 0] Surface \"constant\"") +
                       made;
    for (int k = 2; k <= 5; ++k)
        text += fmt::format(
            "FrameBegin {}\nTranslate 0 0 3\nWorldBegin Color [1 {} 1] {}\nWorldEnd\nFrameEnd\n", k,
            k % 2, wall);
    FilmFile film(text);
    write(std::filesystem::path(film.path()).parent_path() / "mapped.sl",
          "surface mapped(string map = \"\";) { Ci = Cs * color texture(map, s, t); Oi = 1; }");
    Played played(film.request());
    EXPECT_EQ(played.script("seek 3"), "");
    EXPECT_EQ(color_in(played), "g");
    EXPECT_EQ(played.script("next; wait refined"), "");
    EXPECT_EQ(color_in(played), "black");
    EXPECT_EQ(played.script("next; wait refined; previous; wait refined; last; wait refined"), "");
    EXPECT_EQ(color_in(played), "g");
    EXPECT_EQ(played.player.made().maps, 1u);
}

TEST(Film, BeginsAtAFrameOrATime) {
    FilmFile film(three_colors());
    const auto frame_of = [&](StartTime start) {
        Player player({false, false, nullptr});
        player.open(film.request(), std::nullopt, start);
        EXPECT_TRUE(player.wait_loaded(kLong));
        return player.state().time.frame;
    };
    EXPECT_EQ(frame_of({7}), 7);
    EXPECT_EQ(frame_of({5}), 3);
    EXPECT_EQ(frame_of({8 / 24.0, true}), 8);
}

// A film whose frames are 3, 4, 10.
TimeState film_time(LoopMode loop) {
    TimeState time;
    auto film = std::make_shared<FilmFrames>();
    film->frames = {{3, 0, true}, {4, 1, true}, {10, 2, true}};
    time.film = film;
    time.first = time.frame = 3;
    time.last = 10;
    time.loop = loop;
    time.playing = true;
    return time;
}

TEST(FilmClock, AGapTakesAsLongAsAnyStep) {
    TimeState time = film_time(LoopMode::Loop);
    const double expected[] = {3.5, 4, 4.5, 10, 10.5, 3};
    for (double frame : expected) {
        advance_time(time, 1, 0.5);
        EXPECT_NEAR(time.frame, frame, 1e-9);
    }
    time = film_time(LoopMode::Once);
    advance_time(time, 24, 1);
    EXPECT_EQ(time.frame, 10);
    EXPECT_FALSE(time.playing);
}

TEST(FilmClock, PlacesAndFramesAreEachOthersInverse) {
    const TimeState time = film_time(LoopMode::Loop);
    for (double place : {0.0, 0.25, 1.0, 1.75, 2.0, 2.5})
        EXPECT_NEAR(place_of(time, frame_at(time, place)), place, 1e-12);
    EXPECT_EQ(whole_frame(time, 9.9), 4);
    EXPECT_EQ(frame_at(time, 99), 11);
}

}  // namespace
}  // namespace kinora
