// tests/runtime/scene/ri/geometry_test.cpp: what primitives cover, and where their normals
// point.
#include "rib_scene.h"

namespace kinora::ri {
namespace {

RibPicture drawn(const std::string& primitive, const std::string& before = "") {
    return RibPicture(kSmall + before + "WorldBegin Surface \"constant\" Translate 0 0 5 " +
                      primitive + " WorldEnd");
}

// Pixels whose middles, in [-1,1] squared, fulfil f. Those nearer to the border than 0.35 pixels
// may do what they want: curves are fine to a quarter.
template <class F>
void expect_shape(const RibPicture& r, F&& inside) {
    constexpr double kBorder = .35 / 8;
    std::string got, want;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const double px = -1 + (x + .5) / 8, py = 1 - (y + .5) / 8;
            int around = 0;
            for (int i = 0; i < 8; ++i)
                around += inside(px + kBorder * std::cos(i * kPi / 4),
                                 py + kBorder * std::sin(i * kPi / 4));
            const bool border = around % 8 != 0;
            want += border ? '?' : inside(px, py) ? '#' : '.';
            got += border ? '?' : r.covers(x, y) ? '#' : '.';
        }
        want += '\n', got += '\n';
    }
    EXPECT_NE(want.find('#'), want.npos);
    EXPECT_EQ(got, want) << r.findings();
}

// z of the object is up in the picture, and y is into it.
const std::string kUpright = "ConcatTransform [1 0 0 0  0 0 1 0  0 1 0 0  0 0 0 1] ";

TEST(RiQuadrics, SphereAndItsParts) {
    expect_shape(drawn("Sphere .8 -.8 .8 360"),
                 [](double x, double y) { return x * x + y * y < .64; });
    expect_shape(drawn(kUpright + "Sphere .8 -.3 .4 360"),
                 [](double x, double y) { return x * x + y * y < .64 && y > -.3 && y < .4; });
    // A quarter: x, y > 0.
    expect_shape(drawn("Sphere .8 -.8 .8 90"),
                 [](double x, double y) { return x * x + y * y < .64 && x > 0 && y > 0; });
    expect_shape(drawn("Sphere .8 -.8 .8 -90"),
                 [](double x, double y) { return x * x + y * y < .64 && x > 0 && y < 0; });
}

TEST(RiQuadrics, ConeCylinderParaboloidAndHyperboloid) {
    expect_shape(drawn(kUpright + "Cone .7 .6 360"), [](double x, double y) {
        return y > 0 && y < .7 && std::abs(x) < .6 * (1 - y / .7);
    });
    expect_shape(drawn(kUpright + "Cylinder .6 -.3 .7 360"),
                 [](double x, double y) { return std::abs(x) < .6 && y > -.3 && y < .7; });
    expect_shape(drawn(kUpright + "Paraboloid .6 .2 .8 360"), [](double x, double y) {
        return y > .2 && y < .8 && std::abs(x) < .6 * std::sqrt(y / .8);
    });
    // A line from (.6, 0, -.7) to (.2, 0, .7), turned: a cone's part.
    expect_shape(drawn(kUpright + "Hyperboloid .6 0 -.7 .2 0 .7 360"), [](double x, double y) {
        return std::abs(y) < .7 && std::abs(x) < .4 - y * .2 / .7;
    });
    // A skew line: r^2 = .25 + .16 (y / .7)^2.
    expect_shape(drawn(kUpright + "Hyperboloid .5 -.4 -.7 .5 .4 .7 360"), [](double x, double y) {
        return std::abs(y) < .7 && x * x < .25 + .16 * y * y / .49;
    });
}

TEST(RiQuadrics, DiskAndTorus) {
    expect_shape(drawn("Disk 1 .8 360"), [](double x, double y) { return x * x + y * y < .64; });
    expect_shape(drawn("Disk 1 .8 180"),
                 [](double x, double y) { return x * x + y * y < .64 && y > 0; });
    expect_shape(drawn("Torus .6 .25 0 360 360"), [](double x, double y) {
        double r = std::sqrt(x * x + y * y);
        return r > .35 && r < .85;
    });
    expect_shape(drawn("Torus .6 .25 0 360 90"), [](double x, double y) {
        double r = std::sqrt(x * x + y * y);
        return r > .35 && r < .85 && x > 0 && y > 0;
    });
    // The outer half alone: phi from -90 to 90 degrees.
    expect_shape(drawn("Torus .6 .25 -90 90 360"), [](double x, double y) {
        double r = std::sqrt(x * x + y * y);
        return r > .6 && r < .85;
    });
    // The side of +z is the far one.
    RibPicture far = drawn("Disk 3 .8 360 Color 1 0 0 Disk 1 .8 360");
    far.expect(8, 8, {1, 0, 0});
}

TEST(RiPolygons, ConcaveAndHoled) {
    // An L.
    expect_shape(drawn("Polygon \"P\" [-.8 -.8 0 .8 -.8 0 .8 -.3 0 -.3 -.3 0 -.3 .8 0 -.8 .8 0]"),
                 [](double x, double y) {
                     return x > -.8 && y > -.8 && x < .8 && y < .8 && (x < -.3 || y < -.3);
                 });
    const std::string outline = "-.8 -.8 0 .8 -.8 0 .8 .8 0 -.8 .8 0 ";
    for (const char* hole :
         {"-.3 -.3 0 .3 -.3 0 .3 .3 0 -.3 .3 0", "-.3 -.3 0 -.3 .3 0 .3 .3 0 .3 -.3 0"})
        expect_shape(drawn("GeneralPolygon [4 4] \"P\" [" + outline + hole + "]"), [](double x,
                                                                                      double y) {
            return std::abs(x) < .8 && std::abs(y) < .8 && !(std::abs(x) < .3 && std::abs(y) < .3);
        });
    expect_shape(drawn("GeneralPolygon [4 3 4] \"P\" [" + outline +
                       "-.6 -.6 0 -.2 -.6 0 -.6 -.2 0  .1 .1 0 .1 .6 0 .6 .6 0 .6 .1 0]"),
                 [](double x, double y) {
                     bool corner = x > -.6 && y > -.6 && x + y < -.8;
                     bool box = x > .1 && x < .6 && y > .1 && y < .6;
                     return std::abs(x) < .8 && std::abs(y) < .8 && !corner && !box;
                 });
}

TEST(RiPolygons, OfSharedPoints) {
    expect_shape(
        drawn(
            "PointsPolygons [4 3] [0 1 2 3 1 4 2] \"P\" [-.8 -.8 0 0 -.8 0 0 0 0 -.8 0 0 .8 0 0]"),
        [](double x, double y) {
            bool box = x > -.8 && x < 0 && y > -.8 && y < 0;
            bool corner = x > 0 && y < 0 && x - y < .8 && y > x - .8;
            return box || corner;
        });
    expect_shape(drawn("PointsGeneralPolygons [2 1] [4 4 3] [0 1 2 3 4 5 6 7 8 9 10] \"P\" [-.8 "
                       "-.8 0 .3 -.8 0 .3 .3 0 "
                       "-.8 .3 0 -.5 -.5 0 0 -.5 0 0 0 0 -.5 0 0 .4 .4 0 .9 .4 0 .9 .9 0]"),
                 [](double x, double y) {
                     bool box = x > -.8 && x < .3 && y > -.8 && y < .3;
                     bool hole = x > -.5 && x < 0 && y > -.5 && y < 0;
                     bool triangle = x > .4 && x < .9 && y > .4 && y < x;
                     return (box && !hole) || triangle;
                 });
}

TEST(RiPolygons, UniformVariablesAreOfPolygonsWithHoles) {
    RibPicture r = drawn(
        "PointsGeneralPolygons [2 1] [3 3 3] [0 1 2 3 4 5 6 7 8] \"P\" [-.9 -.9 0 0 -.9 0 -.9 .9 0 "
        "-.8 -.8 0 -.7 -.8 0 -.8 -.7 0  .1 -.9 0 .9 -.9 0 .9 .9 0] \"uniform color Cs\" [1 0 0 0 1 "
        "0]");
    r.expect(3, 12, {1, 0, 0});
    r.expect(13, 12, {0, 1, 0});
}

TEST(RiPatches, BicubicOnesReachTheirCorners) {
    std::string points;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) points += fmt::format("{} {} 0 ", -.8 + x * .4, -.6 + y * .4);
    auto box = [](double left, double right, double low, double high) {
        return [=](double x, double y) { return x > left && x < right && y > low && y < high; };
    };
    expect_shape(drawn("Patch \"bicubic\" \"P\" [" + points + "]"), box(-.8, .4, -.6, .6));
    // The inner four points.
    expect_shape(
        drawn("Basis \"b-spline\" 1 \"b-spline\" 1 Patch \"bicubic\" \"P\" [" + points + "]"),
        box(-.4, 0, -.2, .2));
    expect_shape(
        drawn("Basis \"catmull-rom\" 1 \"bezier\" 3 Patch \"bicubic\" \"P\" [" + points + "]"),
        box(-.4, 0, -.6, .6));
}

// Eight points around: a B-spline's tube.
std::string ring(double radius, double z) {
    std::string points;
    for (int i = 0; i < 8; ++i)
        points += fmt::format("{} {} {} ", radius * std::cos(i * kPi / 4),
                              radius * std::sin(i * kPi / 4), z);
    return points;
}

TEST(RiPatches, PeriodicMeshesClose) {
    // Bilinear: an octagon's ring, from .4 to .8 of the corners' radius.
    RibPicture r = drawn("PatchMesh \"bilinear\" 8 \"periodic\" 2 \"nonperiodic\" \"P\" [" +
                         ring(.8, 0) + ring(.4, 0) + "]");
    expect_shape(r, [](double x, double y) {
        double out = 0;  // the octagon's norm: 1 on the outer
        for (int i = 0; i < 8; ++i) {
            double angle = (i + .5) * kPi / 4;
            out = std::max(out,
                           (x * std::cos(angle) + y * std::sin(angle)) / (.8 * std::cos(kPi / 8)));
        }
        return out < 1 && out > .5;
    });
    // Cubic B-splines around: at the points the curve has (4 + 2 cos 45 deg) / 6 = 0.9024 of their
    // radius, and next to that between them.
    RibPicture cubic = drawn(
        "Basis \"b-spline\" 1 \"bezier\" 3 PatchMesh \"bicubic\" 8 \"periodic\" 4 \"nonperiodic\" "
        "\"P\" [" +
        ring(.9, 0) + ring(.7, 0) + ring(.5, 0) + ring(.3, 0) + "]");
    expect_shape(cubic, [](double x, double y) {
        double radius = std::sqrt(x * x + y * y);
        return radius > .27 && radius < .812;
    });
}

// A Bezier mesh of so many points, the first along u, and what it is told.
struct MeshRow {
    int points;
    std::string basis, wrap;
    bool good;
};

TEST(RiPatches, MeshesOfALeftOverPointAreLeftOut) {
    const std::string bezier = "Basis \"bezier\" 3 \"bezier\" 3 ",
                      spline = "Basis \"b-spline\" 1 \"bezier\" 3 ",
                      hermite = "Basis \"hermite\" 2 \"bezier\" 3 ";
    for (const MeshRow& row : std::vector<MeshRow>{{4, bezier, "nonperiodic", true},
                                                   {5, bezier, "nonperiodic", false},
                                                   {6, bezier, "nonperiodic", false},
                                                   {7, bezier, "nonperiodic", true},
                                                   {6, bezier, "periodic", true},
                                                   {7, bezier, "periodic", false},
                                                   {5, spline, "nonperiodic", true},
                                                   {5, spline, "periodic", true},
                                                   {6, hermite, "nonperiodic", true},
                                                   {7, hermite, "nonperiodic", false}}) {
        std::string heights;
        for (int k = 0; k < 4 * row.points; ++k) heights += k % row.points % 2 ? " 1" : " 0";
        RibWorlds r("WorldBegin " + row.basis + "PatchMesh \"bicubic\" " +
                    std::to_string(row.points) + " \"" + row.wrap +
                    "\" 4 \"nonperiodic\" \"Pz\" [" + heights + "] Sphere 1 -1 1 360 WorldEnd");
        EXPECT_EQ(r.count("RI_COUNTS"), row.good ? 0 : 1) << row.points << row.basis << row.wrap;
        EXPECT_EQ(r.diagnostics.findings().size(), row.good ? 0u : 1u) << r.findings();
        EXPECT_EQ(r.primitives().size(), row.good ? 2u : 1u) << row.points << row.basis << row.wrap;
    }
}

TEST(RiPatches, HeightsStandOverTheUnitSquare) {
    RibPicture r = drawn("Translate -.5 -.5 0 Patch \"bilinear\" \"Pz\" [0 0 1 1]");
    expect_shape(r, [](double x, double y) { return std::abs(x) < .5 && std::abs(y) < .5; });
}

// A quarter of a circle by weights 1, sqrt(1/2), 1, and the line to its centre.
TEST(RiNurbs, RationalOnesAreExact) {
    RibPicture r = drawn(
        "NuPatch 3 3 [0 0 0 1 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"Pw\" [.8 0 0 1 .5656854 .5656854 0 "
        ".7071068 0 "
        ".8 0 1  0 0 0 1 0 0 0 .7071068 0 0 0 1]");
    expect_shape(r, [](double x, double y) { return x > 0 && y > 0 && x * x + y * y < .64; });
}

TEST(RiNurbs, TheirDomainIsWhatIsDrawn) {
    const std::string square = " \"P\" [-.8 -.8 0 .8 -.8 0 -.8 .8 0 .8 .8 0]";
    expect_shape(drawn("NuPatch 2 2 [0 0 4 4] 0 4 2 2 [0 0 1 1] 0 1" + square),
                 [](double x, double y) { return std::abs(x) < .8 && std::abs(y) < .8; });
    expect_shape(drawn("NuPatch 2 2 [0 0 4 4] 1 2 2 2 [0 0 1 1] .5 1" + square),
                 [](double x, double y) { return x > -.4 && x < 0 && y > 0 && y < .8; });
}

// A hole in the middle: what lies left of the curve's travel stays.
TEST(RiNurbs, TrimsCutThem) {
    const std::string square =
        "NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [-.8 -.8 0 .8 -.8 0 -.8 .8 0 .8 .8 0]";
    const std::string loop =
        "TrimCurve [1] [2] [0 0 1 2 3 4 4] [0] [4] [5] [.25 .75 .75 .25 .25] [.25 .25 .75 .75 .25] "
        "[1 1 1 1 1] ";
    auto inner = [](double x, double y) { return std::abs(x) < .4 && std::abs(y) < .4; };
    expect_shape(drawn(loop + square), inner);
    auto outer = [&](double x, double y) {
        return std::abs(x) < .8 && std::abs(y) < .8 && !inner(x, y);
    };
    expect_shape(drawn("Attribute \"trimcurve\" \"string sense\" \"outside\" " + loop + square),
                 outer);
    expect_shape(drawn(loop + "TrimCurve [] [] [] [] [] [] [] [] [] " + square),
                 [](double x, double y) { return std::abs(x) < .8 && std::abs(y) < .8; });
    expect_shape(drawn("AttributeBegin " + loop + "AttributeEnd " + square),
                 [](double x, double y) { return std::abs(x) < .8 && std::abs(y) < .8; });
}

TEST(RiTeapot, HasItsBounds) {
    RibWorlds r("WorldBegin Geometry \"teapot\" WorldEnd");
    dvec3 low(1e9), high(-1e9);
    for (const Described& one : r.primitives())
        for (const dvec3& p : one.mesh->positions) low = glm::min(low, p), high = glm::max(high, p);
    EXPECT_NEAR(low.x, -3, .05);
    EXPECT_GT(high.x, 3.3);
    EXPECT_LT(high.x, 3.525);
    EXPECT_NEAR(low.y, -2, .01);
    EXPECT_NEAR(high.y, 2, .01);
    EXPECT_NEAR(low.z, 0, 1e-6);
    EXPECT_NEAR(high.z, 3.15, 1e-6);
    EXPECT_EQ(r.findings(), "");
}

TEST(RiTeapot, HasNormalsOutwards) {
    RibFolder folder;
    folder.file(
        "away.sl",
        "surface away() { Oi = 1; normal n = normalize(N); Ci = (n . normalize(I) < 0) ? 1 : 0; }");
    // From four sides: what is nearest shows its outside.
    for (int turn = 0; turn < 4; ++turn) {
        RibPicture r(
            fmt::format("{}ScreenWindow -4 4 -4 4 {}WorldBegin Surface \"away\" Translate 0 -1.5 "
                        "20 Rotate -90 1 0 0 Rotate "
                        "{} 0 0 1 Geometry \"teapot\" WorldEnd",
                        kSmall, folder.search(), 90 * turn));
        EXPECT_GT(r.covered(), 25);
        int inwards = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) inwards += r.covers(x, y) && r.at(x, y).x < .5f;
        EXPECT_EQ(inwards, 0) << turn;
    }
}

}  // namespace
}  // namespace kinora::ri
