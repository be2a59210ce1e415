// tests/runtime/scene/ri/objects_test.cpp: objects, archives and their recursion.
#include <ctime>

#include "rib_scene.h"

namespace kinora::ri {
namespace {

const std::string kSphere = "Sphere 1 -1 1 360 ";

// Of the processor, whatever else runs.
double seconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

TEST(RiObjects, AttributesInsideHoldOthersAreTheInstances) {
    RibWorlds r("WorldBegin ObjectBegin 1 " + kSphere + "Color 1 0 0 " + kSphere +
                "ObjectEnd Color 0 1 0 ObjectInstance 1 Color 0 0 1 ObjectInstance 1 " + kSphere +
                "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 5u) << r.findings();
    std::vector<dvec3> colors;
    for (const NodeDefinition& node : r.world().nodes)
        for (const MeshUse& use : node.meshes) {
            Described one{dmat4(1.0), nullptr, &r.world().materials[use.materials[0].material], {}};
            colors.push_back(color_of(r.world(), one));
        }
    EXPECT_EQ(colors, (std::vector<dvec3>{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}}));
}

TEST(RiObjects, TheirMatricesComeBeforeTheInstances) {
    RibWorlds r("WorldBegin ObjectBegin \"o\" Translate 1 0 0 " + kSphere +
                "ObjectEnd Scale 2 2 2 ObjectInstance \"o\" " + kSphere + "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u);
    expect_near(r.primitive(0).place({}), {2, 0, 0});
    expect_near(r.primitive(1).place({}), {0, 0, 0});  // the instance changed nothing
}

TEST(RiObjects, HaveHandlesOfNumbersAndStrings) {
    RibWorlds r("WorldBegin ObjectBegin 3 " + kSphere +
                "ObjectEnd ObjectBegin \"3rd\" Translate 5 0 0 " + kSphere +
                "ObjectEnd ObjectInstance \"3rd\" ObjectInstance 3 ObjectInstance 4 WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u);
    expect_near(r.primitive(0).place({}), {5, 0, 0});
    EXPECT_EQ(r.count("RIB_HANDLE"), 1) << r.findings();
}

TEST(RiObjects, MayStandBeforeTheWorldAndWithinEachOther) {
    RibWorlds r(
        "ObjectBegin 1 Translate 1 0 0 " + kSphere +
        "ObjectEnd ObjectBegin 2 ObjectInstance 1 "
        "Translate 0 1 0 ObjectInstance 1 ObjectEnd WorldBegin Translate 0 0 5 ObjectInstance 2 "
        "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    std::vector<dvec3> places;
    for (const Described& one : r.primitives()) places.push_back(one.place({}));
    expect_near(places[0], {1, 0, 5});
    expect_near(places[1], {1, 1, 5});
    EXPECT_EQ(r.findings(), "");
}

TEST(RiObjects, ADefinitionDrawsNothing) {
    RibWorlds r("WorldBegin ObjectBegin 1 Color 1 0 0 Translate 9 0 0 " + kSphere + "ObjectEnd " +
                kSphere + "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 1u);
    expect_near(r.primitive().place({}), {0, 0, 0});
    EXPECT_EQ(color_of(r.world(), r.primitive()), dvec3(1, 1, 1));
}

// What is kept for the next instance depends on attributes of the instance too.
TEST(RiObjects, InstancesHaveTheirOwnTextureCoordinates) {
    RibFolder folder;
    folder.file("show_s_t.sl", kShowSt);
    RibPicture r(kSmall + folder.search() +
                 "WorldBegin Surface \"show_s_t\" ObjectBegin 1 Patch \"bilinear\" \"P\" "
                 "[-1 -1 3 0 -1 3 -1 1 3 0 1 3] ObjectEnd ObjectInstance 1 TextureCoordinates 1 1 "
                 "1 1 1 1 1 1 "
                 "Translate 1 0 0 ObjectInstance 1 WorldEnd");
    // At (4, 8): u = 9/16, v = 15/32.
    r.expect(4, 8, {9 / 16., 15 / 32., 0});
    r.expect(12, 8, {1, 1, 0});
}

TEST(RiObjects, InstancesHaveTheirOwnBasis) {
    // A ramp of 16 points: a Bezier patch reaches the outer ones, a B-spline the inner.
    std::string points;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) points += fmt::format("{} {} 3 ", x, y);
    RibWorlds r("WorldBegin ObjectBegin 1 Patch \"bicubic\" \"P\" [" + points +
                "] ObjectEnd ObjectInstance 1 Basis \"b-spline\" 1 \"b-spline\" 1 "
                "Attribute \"identifier\" \"name\" \"another\" ObjectInstance 1 WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    double high[2] = {-9, -9};
    for (size_t i = 0; i < 2; ++i)
        for (const dvec3& p : r.primitive(i).mesh->positions) high[i] = std::max(high[i], p.x);
    EXPECT_NEAR(high[0], 3, 1e-6);
    EXPECT_NEAR(high[1], 2, 1e-6);
}

TEST(RiObjects, NearInstancesAreAsFineAsTheyMustBe) {
    RibWorlds r("Format 400 400 1 WorldBegin ObjectBegin 1 " + kSphere +
                "ObjectEnd TransformBegin Scale .005 .005 .005 ObjectInstance 1 TransformEnd "
                "ObjectInstance 1 "
                "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 2u);
    // A sphere of 200 pixels: between its triangles and it a quarter of one, so that the angle of
    // an edge is at most 2 acos(1 - 0.25 / 200) = 0.1 and there are 63 around at least.
    EXPECT_GT(r.primitive(1).mesh->groups[0].triangles.size() / 3, 1000u);
}

TEST(RiArchives, InlineOnesArePasted) {
    RibWorlds r("ArchiveBegin \"a\" Color 1 0 0 Translate 1 0 0 " + kSphere +
                "ArchiveEnd WorldBegin ReadArchive \"a\" ReadArchive \"a\" " + kSphere +
                "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 3u) << r.findings();
    EXPECT_EQ(color_of(r.world(), r.primitive(2)), dvec3(1, 0, 0));
    expect_near(r.primitive(2).place({}), {2, 0, 0});
}

TEST(RiArchives, InlineOnesMayBeMadeAnew) {
    std::string text = "Format 16 16 1 WorldBegin ";
    for (int i = 1; i <= 20; ++i)
        text += fmt::format(
            "ArchiveBegin \"a\" Sphere {0} -{0} {0} 360 ArchiveEnd ReadArchive \"a\" ", i);
    RibWorlds r(text + "WorldEnd");
    ASSERT_EQ(r.primitives().size(), 20u) << r.findings();
    for (int i = 1; i <= 20; ++i) {
        double high = 0;
        for (const dvec3& p : r.primitive(size_t(i - 1)).mesh->positions)
            high = std::max(high, p.z);
        EXPECT_NEAR(high, i, 1e-6);
    }
}

TEST(RiArchives, MayHoldOptionsAndWorlds) {
    RibFolder folder;
    folder.file("sub/two.rib",
                "Format 20 20 1 WorldBegin WorldEnd WorldBegin " + kSphere + "WorldEnd");
    const std::string text =
        "Option \"searchpath\" \"archive\" [\"" + folder.path() + "/sub\"] ReadArchive \"two.rib\"";
    RibWorlds r(text);
    ASSERT_EQ(r.worlds.size(), 2u) << r.findings();
    EXPECT_EQ(r.picture(1).width, 20);
    Diagnostics diagnostics;
    auto last = import_rib({"x.rib", text}, {}, diagnostics);
    ASSERT_TRUE(last);
    EXPECT_EQ(last->meshes.size(), 1u);
}

TEST(RiArchives, AreFoundBesideTheFileAndAlongTheSearchPath) {
    RibFolder folder;
    folder.file("near.rib", kSphere)
        .file("far/way.rib", "Translate 1 0 0 " + kSphere)
        .file("far/nested.rib", "ReadArchive \"near.rib\" ReadArchive \"way.rib\"");
    const std::string path = folder.path() + "/x.rib";
    RibWorlds beside("WorldBegin ReadArchive \"near.rib\" ReadArchive \"far/way.rib\" WorldEnd",
                     path);
    EXPECT_EQ(beside.primitives().size(), 2u) << beside.findings();
    RibWorlds along(
        "Option \"searchpath\" \"archive\" [\"far\"] WorldBegin ReadArchive \"way.rib\" "
        "ReadArchive \"nested.rib\" ReadArchive \"/lost/elsewhere/way.rib\" WorldEnd",
        path);
    EXPECT_EQ(along.primitives().size(), 4u) << along.findings();
    EXPECT_EQ(along.findings(), "");
}

// The file's folder is tried, then that of the first.
TEST(RiArchives, AreFoundBesideTheArchiveThatNamesThem) {
    RibFolder folder;
    folder.file("sub/outer.rib", "ReadArchive \"inner.rib\"").file("sub/inner.rib", kSphere);
    RibWorlds r("WorldBegin ReadArchive \"sub/outer.rib\" WorldEnd", folder.path() + "/x.rib");
    EXPECT_EQ(r.primitives().size(), 1u) << r.findings();
}

TEST(RiArchives, MissingOnesAreReported) {
    RibWorlds r("WorldBegin ReadArchive \"lost.rib\" " + kSphere + "WorldEnd");
    EXPECT_EQ(r.count("RI_ARCHIVE"), 1) << r.findings();
    EXPECT_EQ(r.primitives().size(), 1u);
}

TEST(RiArchives, DelayedOnesAreReadInTheirPlace) {
    RibFolder folder;
    folder.file("a.rib", "Color 1 0 0 Translate 1 0 0 " + kSphere);
    RibWorlds r("WorldBegin Procedural \"DelayedReadArchive\" [\"a.rib\"] [-1 1 -1 1 -1 1] " +
                    kSphere +
                    "Procedural \"RunProgram\" [\"touch\" \"x\"] [-1 1 -1 1 -1 1] WorldEnd",
                folder.path() + "/x.rib");
    ASSERT_EQ(r.primitives().size(), 2u) << r.findings();
    EXPECT_EQ(color_of(r.world(), r.primitive(0)), dvec3(1, 0, 0));
    EXPECT_EQ(color_of(r.world(), r.primitive(1)), dvec3(1, 1, 1));
    expect_near(r.primitive(1).place({}), {0, 0, 0});
    EXPECT_EQ(r.count("RI_NOT_DONE"), 1);
}

// Each reads itself twice.
TEST(RiRecursion, OfArchivesEnds) {
    RibFolder folder;
    folder.file("loop.rib", "ReadArchive \"loop.rib\" " + kSphere + "ReadArchive \"loop.rib\" ");
    const double begin = seconds();
    RibWorlds r("WorldBegin ReadArchive \"loop.rib\" WorldEnd", folder.path() + "/x.rib");
    EXPECT_LT(seconds() - begin, 20);
    EXPECT_EQ(r.worlds.size(), 1u);
    EXPECT_NE(r.findings(), "");
}

TEST(RiRecursion, OfInlineArchivesEnds) {
    const double begin = seconds();
    RibWorlds r(
        "ArchiveBegin \"a\" ReadArchive \"a\" Color 1 0 0 ReadArchive \"a\" ArchiveEnd WorldBegin "
        "ReadArchive \"a\" " +
        kSphere + "WorldEnd");
    EXPECT_LT(seconds() - begin, 20);
    EXPECT_EQ(r.primitives().size(), 1u);
    EXPECT_EQ(r.count("RI_RANGE"), 1) << r.findings();
}

TEST(RiRecursion, OfObjectsEnds) {
    const double begin = seconds();
    RibWorlds r(
        "WorldBegin ObjectBegin 1 ObjectInstance 1 Color 1 0 0 ObjectInstance 1 ObjectEnd "
        "ObjectInstance 1 " +
        kSphere + "WorldEnd");
    EXPECT_LT(seconds() - begin, 20);
    EXPECT_EQ(r.primitives().size(), 1u);
    EXPECT_EQ(r.count("RI_RANGE"), 1) << r.findings();
}

// 10^8 spheres by eight levels of ten instances each.
TEST(RiRecursion, OfTooManyInstancesEnds) {
    std::string text = "WorldBegin ObjectBegin 0 Sphere .1 -.1 .1 360 ObjectEnd ";
    for (int level = 1; level <= 8; ++level) {
        text += fmt::format("ObjectBegin {} ", level);
        for (int i = 0; i < 10; ++i) text += fmt::format("ObjectInstance {} ", level - 1);
        text += "ObjectEnd ";
    }
    const double begin = seconds();
    RibWorlds r(text + "ObjectInstance 8 WorldEnd");
    EXPECT_LT(seconds() - begin, 20);
    EXPECT_EQ(r.worlds.size(), 1u);
    EXPECT_EQ(r.count("RI_RANGE"), 1);
}

constexpr const char* kStripes =
    "surface stripes() { point p = transform(\"object\", P); Ci = color(xcomp(p) > 0, 0, 0); }";

// Small primitives of one look join, but not where their shader asks where their own space is.
TEST(RiObjects, SmallPrimitivesJoinWhereNoShaderSeesIt) {
    const std::string two =
        "Translate -.5 0 3 Polygon \"P\" [-.4 -.4 0 -.4 .4 0 .4 .4 0 .4 -.4 0] "
        "Color 1 0 0 Scale -1 1 1 Translate -1 0 0 "
        "Polygon \"P\" [-.4 -.4 0 -.4 .4 0 .4 .4 0 .4 -.4 0] WorldEnd";
    RibPicture joined(kSmall + "WorldBegin Surface \"constant\" " + two);
    EXPECT_EQ(joined.scene.scene().shapes.size(), 1u);
    joined.expect(4, 8, {1, 1, 1});
    joined.expect(12, 8, {1, 0, 0});
    RibFolder folder;
    folder.file("stripes.sl", kStripes);
    RibPicture apart(kSmall + folder.search() + "WorldBegin Surface \"stripes\" " + two);
    EXPECT_EQ(apart.scene.scene().shapes.size(), 2u);
    apart.expect(2, 8, {0, 0, 0});
    apart.expect(5, 8, {1, 0, 0});
    apart.expect(10, 8, {1, 0, 0});  // mirrored
    apart.expect(13, 8, {0, 0, 0});
}

// A mirror among them turns its normals and sides with it.
TEST(RiObjects, MirrorsJoinWithTheirSides) {
    const std::string polygon = "Polygon \"P\" [-.4 -.4 0 -.4 .4 0 .4 .4 0 .4 -.4 0] ";
    RibPicture r(kSmall + "WorldBegin Sides 1 Surface \"constant\" Translate -.5 0 3 " + polygon +
                 "Translate 1 0 0 Scale -1 1 1 " + polygon +
                 "ReverseOrientation Translate 0 .8 0 " + polygon + "WorldEnd");
    EXPECT_EQ(r.scene.scene().shapes.size(), 1u);
    EXPECT_TRUE(r.covers(4, 8));
    EXPECT_TRUE(r.covers(12, 8));   // its orientation turned with the mirror
    EXPECT_FALSE(r.covers(12, 2));  // turned round
}

// Of a sphere by the options that the picture is made with.
size_t triangles_of_sphere(const ImportOptions& options) {
    Diagnostics diagnostics;
    auto world =
        import_rib({"x.rib", "Format 100 100 1 WorldBegin Translate 0 0 5 " + kSphere + "WorldEnd"},
                   options, diagnostics);
    return world ? world->meshes[0].groups[0].triangles.size() / 3 : 0;
}

// Triangles grow as pixels do, and shrink as the error allowed grows.
TEST(RiObjects, CurvesSuitThePictureThatIsMade) {
    const double plain = double(triangles_of_sphere({}));
    ImportOptions large, scaled, coarse;
    large.width = 800;
    scaled.scale = 8;
    coarse.curve_error = 2 * kCurveError;
    EXPECT_GT(double(triangles_of_sphere(large)), 5 * plain);
    EXPECT_LT(double(triangles_of_sphere(large)), 12 * plain);
    EXPECT_EQ(triangles_of_sphere(scaled), triangles_of_sphere(large));
    EXPECT_LT(double(triangles_of_sphere(coarse)), 0.8 * plain);
}

}  // namespace
}  // namespace kinora::ri
