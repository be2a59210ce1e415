// tests/runtime/points_test.cpp: bake3d writes, texture3d and photon maps read; files on their own.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "runtime/scene/images/point_store.h"
#include "scene_text.h"

namespace kinora {
namespace {

class Points : public testing::Test {
  protected:
    std::string path(const std::string& name) {
        auto folder = std::filesystem::temp_directory_path() /
                      fmt::format("kinora_points_{}_{}", getpid(),
                                  testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder);
        folder_ = folder;
        return (folder / name).string();
    }
    void TearDown() override {
        if (!folder_.empty()) std::filesystem::remove_all(folder_);
    }
    std::filesystem::path folder_;
};

std::string bakes(const std::string& file) {
    return fmt::format(
        "surface s() {{ Oi = 1; point w = transform(\"world\", P); color c = color(xcomp(w), "
        "ycomp(w), 0.5); Ci = bake3d(\"{}\", \"\", P, normalize(N), \"_area\", 3 * xcomp(w), "
        "\"_tint\", c, \"interpolate\", 1) * c; }}",
        file);
}

PointFile read(const std::string& path) {
    PointFile file;
    EXPECT_EQ(read_point_file(path, file), "");
    return file;
}

TEST_F(Points, AreOneAPixelInPictureOrderInWorldSpace) {
    std::string file = path("a.pts");
    Rendering r(floor_scene(bakes(file)).text());
    r.settings.integrator.samples_per_pixel = 4;
    r.frame(8, 8);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    PointFile points = read(file);
    ASSERT_EQ(points.channels.size(), 2u);
    EXPECT_EQ(points.channels[0], (PointChannel{"_area", 'f', 7}));
    EXPECT_EQ(points.channels[1], (PointChannel{"_tint", 'c', 8}));
    ASSERT_EQ(points.count(), 64u);
    for (size_t i = 0; i < 64; ++i) {
        const float* p = points.point(i);
        dvec2 pixel = r.place(int(i % 8), int(i / 8));
        EXPECT_NEAR(p[0], pixel.x, 0.126) << i;  // somewhere in the pixel
        EXPECT_NEAR(p[1], pixel.y, 0.126) << i;
        EXPECT_NEAR(p[2], 0, 1e-5);
        EXPECT_NEAR(p[5], 1, 1e-6);                      // the normal
        EXPECT_NEAR(p[6], 0.25 * std::sqrt(0.5), 1e-4);  // half a pixel's diagonal
        EXPECT_FLOAT_EQ(p[7], 3 * p[8]);
        EXPECT_NEAR(p[8], p[0], 1e-6);
        EXPECT_NEAR(p[9], p[1], 1e-6);
    }
}

TEST_F(Points, AreTheSameBytesForAnyThreadsAndTiles) {
    std::vector<std::string> bytes;
    for (int threads : {1, 2}) {
        Threads count(threads);
        std::string file = path(fmt::format("{}.pts", threads));
        Rendering r(floor_scene(bakes(file)).text());
        if (threads == 2) {
            r.settings.integrator.tile = 4;
            r.settings.integrator.chunk_rays = 16;
        }
        r.frame(21, 13);
        std::ifstream in(file, std::ios::binary);
        bytes.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    EXPECT_GT(bytes[0].size(), 1000u);
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);  // no rests
}

TEST_F(Points, ComeBackWhereTheyWereBaked) {
    std::string file = path("a.pts");
    SceneText scene = floor_scene(
        fmt::format("surface s() {{ Oi = 1; color c = 7; float a = 0, none = 5;"
                    " float ok = texture3d(\"{0}\", P, normalize(N), \"_tint\", c, \"_area\", a);"
                    " float not = texture3d(\"{0}\", P, N, \"_gone\", none);"
                    " Ci = color(comp(c, 0), a + 10 * ok, none + not); }}",
                    file));
    Rendering(floor_scene(bakes(file)).text()).frame();
    Rendering r(scene.text());
    r.frame();
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            double at = r.place(x, y).x;
            ASSERT_NEAR(r.color(x, y).x, at, 2e-6) << x << "," << y;
            ASSERT_NEAR(r.color(x, y).y, 3 * at + 10, 1e-5);
            ASSERT_EQ(r.color(x, y).z, 5.0f);
        }
    // Between the points their values are mixed.
    r.frame(31, 31);
    for (int x = 2; x < 29; ++x) EXPECT_NEAR(r.color(x, 15).x, r.place(x, 15).x, 0.07) << x;
}

// A node at half the scale: its lengths are half as long in the file, too.
TEST_F(Points, LieInTheSpaceThatCoordsystemNames) {
    std::string file = path("o.pts");
    const char* code =
        "surface s() {{ Oi = 1; point o = transform(\"object\", P); color c = color(xcomp(o), "
        "ycomp(o), zcomp(o)); {} Ci = c; }}";
    auto frame = [&](const std::string& body, const char* place, auto&& judge) {
        SceneText scene;
        scene.square("sheet", 1.5).look("look", fmt::format(fmt::runtime(code), body));
        scene.place("sheet", "look", std::string(place) + "<scale>2 2 2</scale>");
        Rendering r(scene.text());
        r.frame(8, 8);
        ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
        judge(r);
    };
    struct Row {
        const char* pairs;
        double radius;
    };
    const double pixel = 0.25 * std::sqrt(0.5) / 2;
    for (const Row& row :
         {Row{"", pixel}, Row{", \"radius\", 0.5", 0.25}, Row{", \"radiusscale\", 3", 3 * pixel}}) {
        std::string bake =
            fmt::format("bake3d(\"{}\", \"\", P, N, \"_o\", c, \"coordsystem\", \"object\"{});",
                        file, row.pairs);
        frame(bake, "<translate>0.25 0.125 0</translate>", [&](Rendering& r) {
            PointFile points = read(file);
            ASSERT_EQ(points.count(), 64u) << r.findings();
            for (size_t i = 0; i < 64; ++i) {
                const float* p = points.point(i);
                dvec2 at = r.place(int(i % 8), int(i / 8));
                EXPECT_NEAR(p[0], (at.x - 0.25) / 2, 1e-6);
                EXPECT_NEAR(p[1], (at.y - 0.125) / 2, 1e-6);
                EXPECT_NEAR(p[2], 0, 1e-6);
                EXPECT_NEAR(p[5], 1, 1e-6);
                EXPECT_NEAR(p[6], row.radius, 1e-5);
            }
        });
    }
    // Seen two pixels farther left: its points go with the node.
    std::string look = fmt::format(
        "color k = -1; texture3d(\"{}\", P, N, \"_o\", k, \"coordsystem\", \"object\");"
        " c = k - c;",
        file);
    frame(look, "<translate>-0.25 0.125 0</translate>", [&](Rendering& r) {
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 6; ++x)
                for (int k = 0; k < 3; ++k) EXPECT_NEAR(r.color(x, y)[k], 0, 2e-6);
    });
}

// bake() puts its value at s, t, wherever the surface and the camera are.
TEST_F(Points, OfBakeLieAtTheirCoordinates) {
    std::string file = path("a.pts");
    Rendering r(floor_scene(fmt::format("surface s() {{ Oi = 1; Ci = 0; bake(\"{}\", s, 2 * t, "
                                        "color(s, t, 0.5)); }}",
                                        file))
                    .text());
    r.frame(8, 8);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.findings();
    PointFile points = read(file);
    ASSERT_EQ(points.channels.size(), 1u);
    EXPECT_EQ(points.channels[0], (PointChannel{"value", 'c', 7}));
    ASSERT_EQ(points.count(), 64u);
    for (size_t i = 0; i < 64; ++i) {
        const float* p = points.point(i);
        dvec2 pixel = r.place(int(i % 8), int(i / 8));
        EXPECT_NEAR(p[0], (pixel.x + 1.5) / 3, 0.05) << i;
        EXPECT_EQ(p[0], p[7]);
        EXPECT_EQ(p[1], 2 * p[8]);
        EXPECT_EQ(p[2], 0);
        EXPECT_EQ(p[9], 0.5f);
        EXPECT_NEAR(p[6], 0.5 / 12, 0.5 / 12 + 1e-4);  // about half of what a pixel spans
    }
    // Read at the same coordinates, from a camera elsewhere.
    SceneText reader = floor_scene(
        fmt::format("surface s() {{ Oi = 1; color c = 7; float ok = texture3d(\"{}\", point "
                    "\"world\" (s, 2 * t, 0), normal(0), \"value\", c); Ci = c * ok; }}",
                    file));
    reader.camera_node =
        "<node id=\"eye-node\"><translate>0 0 7</translate><instance_camera url=\"#eye\"/></node>";
    Rendering back(reader.text());
    back.frame(8, 8);
    ASSERT_FALSE(back.diagnostics.has_errors()) << back.findings();
    for (int k = 1; k < 7; ++k)
        EXPECT_NEAR(back.color(k, k).x, (back.place(k, k).x + 1.5) / 3, 0.05) << k;
}

TEST_F(Points, OfAMissingOrBrokenFileAreAFindingAndNothing) {
    std::string missing = path("missing.pts"), broken = path("broken.pts");
    Rendering(floor_scene(bakes(broken)).text()).frame();
    std::filesystem::resize_file(broken, std::filesystem::file_size(broken) - 5);
    for (const std::string& file : {missing, broken}) {
        Rendering r(floor_scene(fmt::format("surface s() {{ Oi = 1; float a = 4; float ok = "
                                            "texture3d(\"{0}\", P, N, \"_area\", a);"
                                            " Ci = color(a, ok, comp(photonmap(\"{0}\", P, N), 0));"
                                            " }}",
                                            file))
                        .text());
        r.frame();
        r.frame();
        EXPECT_EQ(r.count("POINT_FILE_UNREADABLE"), 1) << r.findings();
        EXPECT_NE(r.findings().find(file), std::string::npos);
        EXPECT_EQ(r.color(3, 3), vec3(4, 0, 0));
    }
}

// A parameter for the file that is not filled in.
TEST_F(Points, WithoutAFileNameAreNotBakedAndNotFound) {
    Rendering r(floor_scene("surface s(string file = \"\";) { float a = 3; Oi = 1;"
                            " bake3d(file, \"\", P, N, \"a\", a);"
                            " Ci = texture3d(file, P, N, \"a\", a) + a; }")
                    .text());
    r.frame();
    EXPECT_EQ(r.findings(), "");
    EXPECT_EQ(r.color(8, 8), vec3(3));
}

TEST_F(Points, CannotBeWrittenIntoNowhereAndSayIt) {
    Rendering r(floor_scene(bakes("/no/such/folder/a.pts")).text());
    r.frame();
    EXPECT_EQ(r.count("FRAME_UNWRITABLE"), 1) << r.findings();
}

TEST_F(Points, OfPhotonsGiveTheirPowerByArea) {
    // A regular lattice of photons, each with the power of its cell under irradiance (2, 1, 0.5).
    std::string file = path("photons.pts");
    PointFile photons;
    photons.channel("power", 'c');
    const double step = 0.02;
    for (double y = -1.4; y < 1.4; y += step)
        for (double x = -1.4; x < 1.4; x += step) {
            float cell = float(step * step);
            for (float v :
                 {float(x), float(y), 0.0f, 0.0f, 0.0f, 1.0f, 0.01f, 2 * cell, cell, 0.5f * cell})
                photons.points.push_back(v);
        }
    ASSERT_EQ(write_point_file(file, photons), "");
    Rendering r(floor_scene(fmt::format("surface s() {{ Oi = 1; Ci = photonmap(\"{}\", P, "
                                        "normalize(N), \"estimator\", 60); }}",
                                        file))
                    .text());
    r.frame();
    for (int k = 0; k < 16; ++k) {
        EXPECT_NEAR(r.color(k, k).x, 2, 0.2) << r.findings();
        EXPECT_NEAR(r.color(k, k).z, 0.5, 0.05);
    }
}

TEST(PointCloud, FindsTheNearestAsBruteForceDoes) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    PointFile file;
    const size_t count = 3000;
    for (size_t i = 0; i < count; ++i)
        for (int k = 0; k < kPointHead; ++k)
            file.points.push_back(i % 10 == 0 && k < 3 ? 0.25f : unit(random));  // many together
    PointCloud cloud(file);
    for (int query = 0; query < 200; ++query) {
        vec3 P(unit(random), unit(random), unit(random)), N(0.0f);
        if (query % 2) N = vec3(unit(random), unit(random), unit(random));
        std::vector<PointCloud::Near> all;
        for (size_t i = 0; i < count; ++i) {
            const float* p = file.point(i);
            vec3 d(p[0] - P.x, p[1] - P.y, p[2] - P.z);
            bool faces = query % 2 == 0 || p[3] * N.x + p[4] * N.y + p[5] * N.z >= 0;
            if (faces) all.push_back({d.x * d.x + d.y * d.y + d.z * d.z, uint32_t(i)});
        }
        std::sort(all.begin(), all.end());
        PointCloud::Near near[12];
        ASSERT_EQ(cloud.nearest(P, N, near), 12u);
        for (size_t k = 0; k < 12; ++k) EXPECT_EQ(near[k].point, all[k].point) << query << " " << k;
    }
}

TEST(PointFiles, RejectWhatIsNone) {
    std::string path =
        (std::filesystem::temp_directory_path() / fmt::format("kinora_pf_{}", getpid())).string();
    PointFile file;
    EXPECT_NE(read_point_file(path + ".none", file), "");
    for (std::string text : {std::string(), std::string("KNPOINT1"), std::string("hello world"),
                             std::string("KNPOINT1\xff\xff\xff\x7f\0\0\0\0\0\0\0\0", 20),
                             std::string("KNPOINT1\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\x7f", 20),
                             std::string("KNPOINT1\1\0\0\0\1\0\0\0\0\0\0\0q\0\0\0\1\0\0\0x", 29)}) {
        std::ofstream(path, std::ios::binary) << text;
        EXPECT_NE(read_point_file(path, file), "") << text.size();
    }
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace kinora
