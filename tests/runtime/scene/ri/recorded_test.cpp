// tests/runtime/scene/ri/recorded_test.cpp: types and counts of what is kept in objects and
// archives.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

class RiRecorded : public testing::Test {
  protected:
    RiRecorded() {
        folder_.file("heated.sl", "surface heated(varying float heat = 0;) { Oi = 1; Ci = heat; }")
            .file("tinted_so.sl",
                  "surface tinted_so(varying color heat = 0;) { Oi = 1; Ci = heat; }");
    }
    // The picture of a square that has a variable of undeclared type.
    static std::string square(const std::string& heat) {
        return "Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] \"heat\" [" + heat + "] ";
    }
    void shows(const std::string& before, const std::string& inside, dvec3 color) const {
        RibPicture r(kSmall + folder_.search() + before + "WorldBegin " + inside + "WorldEnd");
        SCOPED_TRACE(inside);
        EXPECT_EQ(r.findings(), "");
        r.expect(8, 8, color);
    }
    RibFolder folder_;
};

const std::string kFour = ".5 .5 .5 .5", kTwelve = "1 0 .5 1 0 .5 1 0 .5 1 0 .5";
const std::string kHeated = "Surface \"heated\" ", kTinted = "Surface \"tinted_so\" ";

TEST_F(RiRecorded, VariablesHaveTheTypesOfTheSurfaceThatIsKeptWithThem) {
    shows("ObjectBegin 1 " + kHeated + square(kFour) + "ObjectEnd ", "ObjectInstance 1 ",
          dvec3(.5));
    shows("ArchiveBegin \"a\" " + kTinted + square(kTwelve) + "ArchiveEnd ", "ReadArchive \"a\" ",
          {1, 0, .5});
    shows(kHeated + "ObjectBegin 1 " + kTinted + square(kTwelve) + "ObjectEnd ",
          "ObjectInstance 1 ", {1, 0, .5});
    shows(kHeated + "ObjectBegin 1 " + square(kFour) + "ObjectEnd ", "ObjectInstance 1 ",
          dvec3(.5));
}

TEST_F(RiRecorded, ASurfaceEndsWithItsBlock) {
    shows("ObjectBegin 1 " + kHeated + "AttributeBegin " + kTinted + "AttributeEnd " +
              square(kFour) + "ObjectEnd ",
          "ObjectInstance 1 ", dvec3(.5));
    shows("ObjectBegin 1 " + kHeated + "AttributeBegin " + kTinted + square(kTwelve) +
              "AttributeEnd ObjectEnd ",
          "ObjectInstance 1 ", {1, 0, .5});
}

TEST_F(RiRecorded, MotionWithinAnObjectKnowsItsSurface) {
    shows("ObjectBegin 1 " + kHeated + "MotionBegin [0 1] " + square(kFour) + square(kFour) +
              "MotionEnd ObjectEnd ",
          "ObjectInstance 1 ", dvec3(.5));
}

TEST_F(RiRecorded, LayersHaveTheParametersOfTheirShader) {
    shows("",
          "ShaderLayer \"surface\" \"heated\" \"one\" \"heat\" .25 "
          "Polygon \"P\" [-1 -1 3 -1 1 3 1 1 3 1 -1 3] ",
          dvec3(.25));
}

// A mesh of 7 by 4 points: two patches of Bezier's basis, four of a B-spline.
std::string mesh(int varying) {
    std::string points, heat;
    for (int v = 0; v < 4; ++v)
        for (int u = 0; u < 7; ++u) points += fmt::format("{} {} 3 ", u, v);
    for (int k = 0; k < varying; ++k) heat += "1 ";
    return "PatchMesh \"bicubic\" 7 \"nonperiodic\" 4 \"nonperiodic\" \"P\" [" + points +
           "] \"varying float heat\" [" + heat + "] ";
}
const std::string kSpline = "Basis \"b-spline\" 1 \"b-spline\" 1 ";

TEST_F(RiRecorded, ABasisCountsWhereItsArchiveIsRead) {
    auto findings = [](const std::string& text) { return RibWorlds(text).findings(); };
    const std::string kept = "ArchiveBegin \"a\" " + kSpline + "ArchiveEnd ";
    EXPECT_EQ(findings(kept + "WorldBegin " + mesh(6) + "WorldEnd"), "");
    EXPECT_EQ(findings(kept + "WorldBegin ReadArchive \"a\" " + mesh(10) + "WorldEnd"), "");
    EXPECT_EQ(findings("ArchiveBegin \"a\" " + kSpline + mesh(10) + "ArchiveEnd WorldBegin " +
                       mesh(6) + "WorldEnd"),
              "");
    EXPECT_EQ(findings(kept + "WorldBegin AttributeBegin ReadArchive \"a\" AttributeEnd " +
                       mesh(6) + "WorldEnd"),
              "");
    EXPECT_NE(findings(kept + "WorldBegin ReadArchive \"a\" " + mesh(6) + "WorldEnd"), "");
}

}  // namespace
}  // namespace kinora::ri
