// tests/runtime/scene/ri/maps_test.cpp: maps that a file makes of pictures.
#include "rib_scene.h"
#include "runtime/scene/images/image_io.h"

namespace kinora::ri {
namespace {

// A face of 4 by 4 pixels of one colour; its lower left quarter is dark.
raytrace::Film face_picture(dvec3 color) {
    raytrace::Film film;
    film.width = film.height = 4;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            bool dark = x < 2 && y >= 2;
            film.rgba.push_back(vec4(vec3(color * (dark ? .25 : 1)), 1));
        }
    return film;
}

const dvec3 kFaceColors[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
const char* const kFaceFiles[6] = {"px.exr", "nx.exr", "py.exr", "ny.exr", "pz.exr", "nz.exr"};

class RiMaps : public testing::Test {
  protected:
    RiMaps() {
        folder_
            .file("seen.sl",
                  "surface seen(string map = \"\"; vector way = vector \"world\" (0, 0, 1);)"
                  "{ Oi = 1; Ci = environment(map, vtransform(\"world\", way)); }")
            .file("mapped.sl",
                  "surface mapped(string map = \"\"; float s1 = 0, t1 = 0;)"
                  "{ Oi = 1; Ci = texture(map, s1, t1, \"filter\", \"nearest\"); }");
        for (int face = 0; face < 6; ++face)
            write(kFaceFiles[face], face_picture(kFaceColors[face]));
    }
    void write(const std::string& name, const raytrace::Film& film) {
        EXPECT_EQ(
            write_image_and_folder(folder_.path() + "/" + name, film, ColorEncoding::Linear, {}),
            "");
    }
    // The colour of a wall that shows what the map `m` has, after a request that makes it.
    dvec3 shown(const std::string& made, const std::string& surface) {
        RibPicture r(kSmall + folder_.search() + folder_.search("texture") + made +
                     "WorldBegin Surface " + surface +
                     " Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] WorldEnd");
        EXPECT_EQ(r.findings(), "") << surface;
        return dvec3(vec3(r.at(8, 7)));
    }
    dvec3 along(dvec3 way, const std::string& fov = "90", const std::string& suffix = ".exr") {
        std::string made = "MakeCubeFaceEnvironment ";
        for (std::string file : kFaceFiles) made += "\"" + file.substr(0, 2) + suffix + "\" ";
        return shown(made + "\"m.env\" " + fov + " \"box\" 1 1 ",
                     fmt::format("\"seen\" \"map\" \"m.env\" \"vector way\" [{} {} {}]", way.x,
                                 way.y, way.z));
    }
    RibFolder folder_;
};

TEST_F(RiMaps, FacesOfACubeAreAlongTheAxes) {
    const dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    // The upper right of each picture is light, the lower left dark.
    const dvec3 right[6] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
    const dvec3 up[6] = {{0, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
    for (int face = 0; face < 6; ++face) {
        SCOPED_TRACE(kFaceFiles[face]);
        expect_near(along(axes[face] + .75 * right[face] + .75 * up[face]), kFaceColors[face],
                    1e-3);
        expect_near(along(axes[face] - .75 * right[face] + .75 * up[face]), kFaceColors[face],
                    1e-3);
        expect_near(along(axes[face] + .75 * right[face] - .75 * up[face]), kFaceColors[face],
                    1e-3);
        expect_near(along(axes[face] - .75 * right[face] - .75 * up[face]), .25 * kFaceColors[face],
                    1e-3);
    }
}

// At 90 degrees a quarter from the edge is 0.5, at 126.87, of which the tangent of the half is
// 2, 1.
TEST_F(RiMaps, PicturesOfWiderAnglesHaveEdgesInCommon) {
    expect_near(along({-.3, -.3, 1}), .25 * kFaceColors[4], 1e-2);
    raytrace::Film wide;
    wide.width = wide.height = 8;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            wide.rgba.push_back(x >= 2 && x < 6 && y >= 2 && y < 6 ? vec4(1) : vec4(0, 0, 0, 1));
    for (const char* file : kFaceFiles) write(file, wide);
    expect_near(along({.7, .7, 1}, "126.8699"), dvec3(1), 1e-3);
    expect_near(along({.7, .7, 1}), dvec3(0), 1e-3);
}

TEST_F(RiMaps, DisplaysAreFoundUnderTheNamesThatTheyGot) {
    expect_near(along({.5, .5, 1}, "90", ".tif"), kFaceColors[4], 1e-3);
}

TEST_F(RiMaps, TexturesWrapAsTheyWereMade) {
    auto at = [&](const std::string& modes, double s, double t) {
        return shown("MakeTexture \"px.exr\" \"m.tx\" " + modes + " \"box\" 1 1 ",
                     fmt::format("\"mapped\" \"map\" \"m.tx\" \"s1\" {} \"t1\" {}", s, t));
    };
    // t runs down: the dark quarter has s below and t above one half.
    expect_near(at("\"periodic\" \"periodic\"", .25, .75), {.25, 0, 0}, 1e-3);
    expect_near(at("\"periodic\" \"periodic\"", .25, .25), {1, 0, 0}, 1e-3);
    expect_near(at("\"periodic\" \"periodic\"", 1.25, .75), {.25, 0, 0}, 1e-3);
    expect_near(at("\"clamp\" \"periodic\"", 1.25, .75), {1, 0, 0}, 1e-3);
    expect_near(at("\"black\" \"periodic\"", 1.25, .75), {0, 0, 0}, 1e-3);
    expect_near(at("\"periodic\" \"black\"", .75, -.25), {0, 0, 0}, 1e-3);
    expect_near(at("\"periodic\" \"clamp\"", .25, 1.25), {.25, 0, 0}, 1e-3);
}

TEST_F(RiMaps, WhatIsMissingIsTold) {
    RibPicture r(
        kSmall + folder_.search() +
        "MakeCubeFaceEnvironment \"a\" \"b\" \"c\" \"d\" \"e\" \"f\" \"m.env\" 70 \"box\" 1 1 "
        "WorldBegin Surface \"seen\" \"map\" \"m.env\" "
        "Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] WorldEnd");
    EXPECT_EQ(r.count("RI_RANGE"), 1) << r.findings();
    EXPECT_EQ(r.count("IMAGE_UNREADABLE"), 1) << r.findings();
}

}  // namespace
}  // namespace kinora::ri
