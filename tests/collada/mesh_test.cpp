// tests/collada/mesh_test.cpp: sources, inputs and primitives become triangles.
#include <gtest/gtest.h>

#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

using Indices = std::vector<uint32_t>;

const std::string kSquare = "0 0 0 1 0 0 1 1 0 0 1 0";
const std::string kVertex = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";

const Indices& positions_of(const Reading& r, size_t group = 0) {
    return r.scene->geometries.at(0).groups.at(group).indices.at(0);
}

TEST(Mesh, ReadsEveryKindOfPrimitive) {
    struct {
        std::string primitive;
        Indices expected;
    } cases[] = {
        {"<triangles count=\"2\">" + kVertex + "<p>0 1 2 0 2 3</p></triangles>",
         {0, 1, 2, 0, 2, 3}},
        {"<polylist count=\"2\">" + kVertex + "<vcount>3 4</vcount><p>0 1 2 0 1 2 3</p></polylist>",
         {0, 1, 2, 0, 1, 2, 0, 2, 3}},
        {"<polygons count=\"1\">" + kVertex + "<p>0 1 2 3</p></polygons>", {0, 1, 2, 0, 2, 3}},
        {"<tristrips count=\"1\">" + kVertex + "<p>0 1 3 2</p></tristrips>", {0, 1, 3, 3, 1, 2}},
        {"<trifans count=\"1\">" + kVertex + "<p>0 1 2 3</p></trifans>", {0, 1, 2, 0, 2, 3}},
    };
    for (const auto& c : cases) {
        Reading r;
        read_text(r, with_mesh(kSquare, 4, c.primitive));
        ASSERT_TRUE(r.scene && r.scene->geometries.size() == 1) << r.all();
        EXPECT_EQ(positions_of(r), c.expected) << c.primitive;
        EXPECT_EQ(r.diag.count(Severity::Warning), 0) << r.all();
    }
}

TEST(Mesh, InputsShareListsByOffset) {
    Reading r;
    read_file(r, test_file("common.dae"));
    ASSERT_TRUE(r.scene) << r.all();
    const Geometry& g = r.scene->geometries.at(0);
    ASSERT_EQ(g.groups.size(), 2u);
    const PrimitiveGroup& group = g.groups[0];
    EXPECT_EQ(group.material, "m");
    ASSERT_EQ(group.inputs.size(), 3u);  // TEXCOORD of <vertices>, NORMAL, TEXCOORD set 3
    EXPECT_EQ(group.inputs[0].list, 0u);
    EXPECT_EQ(group.inputs[1].semantic, "NORMAL");
    EXPECT_EQ(group.inputs[1].list, 1u);
    EXPECT_EQ(group.inputs[2].set, 3u);
    EXPECT_EQ(group.inputs[2].list, 0u);
    EXPECT_EQ(group.inputs[0].source, group.inputs[2].source);
    EXPECT_EQ(g.sources[group.inputs[2].source].stride, 2u);
    EXPECT_EQ(group.indices.size(), 2u);
    EXPECT_EQ(group.indices[1], Indices(6, 0));
}

TEST(Mesh, AccessorsPickColumnsOffsetsAndStrides) {
    std::string source =
        "<source id=\"t\"><float_array id=\"ta\" count=\"9\">9 1 2 0 3 4 0 5 6</float_array>"
        "<technique_common><accessor source=\"#ta\" count=\"3\" stride=\"3\"><param "
        "type=\"float\"/>"
        "<param name=\"S\" type=\"float\"/><param name=\"T\" type=\"float\"/></accessor>"
        "</technique_common></source>";
    Reading r;
    read_text(r, with_mesh("0 0 0 1 0 0 1 1 0", 3,
                           "<triangles count=\"1\">" + kVertex +
                               "<input semantic=\"TEXCOORD\" source=\"#t\" offset=\"0\"/>"
                               "<p>0 1 2</p></triangles>",
                           source));
    ASSERT_TRUE(r.scene);
    const FloatSource& t = r.scene->geometries.at(0).sources.at(0);
    EXPECT_EQ(t.stride, 2u);
    EXPECT_EQ(t.values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST(Mesh, IndicesOutOfRangeAreNamedAndTheirPrimitiveSkipped) {
    Reading r;
    read_text(r, with_mesh(kSquare, 4,
                           "<triangles count=\"3\">" + kVertex +
                               "<p>\n0 1 4\n0 1 2\n0 -1 2</p></triangles>"));
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(positions_of(r), (Indices{0, 1, 2}));
    EXPECT_EQ(r.pointed("PRIM_INDEX_RANGE"), "4");
    EXPECT_EQ(r.place("PRIM_INDEX_RANGE"), "3:5");
    Reading negative;
    read_text(negative, with_mesh(kSquare, 4,
                                  "<polylist count=\"1\">" + kVertex +
                                      "<vcount>4</vcount><p>0 -1 2 3</p></polylist>"));
    EXPECT_EQ(negative.pointed("PRIM_INDEX_NEGATIVE"), "-1");
    EXPECT_TRUE(negative.scene->geometries.at(0).groups.empty());
}

TEST(Mesh, CountsAreCheckedBeforeMemoryIsTaken) {
    std::string text =
        with_mesh("0 0 0 1 0 0 1 1 0", 3,
                  "<triangles count=\"4000000000\">" + kVertex + "<p>0 1 2</p></triangles>");
    auto replace = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    replace("count=\"9\"", "count=\"4000000000\"");
    replace("count=\"3\" stride", "count=\"18446744073709551615\" stride");
    Reading r;
    read_text(r, text);
    EXPECT_EQ(r.count("SRC_COUNT"), 1u);
    EXPECT_EQ(r.count("SRC_OVERFLOW"), 1u);
    text = with_mesh("0 0 0 1 0 0 1 1 0", 3,
                     "<triangles count=\"1\">" + kVertex + "<p>0 1 2</p></triangles>");
    replace("stride=\"3\"", "stride=\"0\"");
    Reading zero;
    read_text(zero, text);
    EXPECT_EQ(zero.count("SRC_STRIDE"), 1u);
    EXPECT_EQ(positions_of(zero), (Indices{0, 1, 2}));
}

TEST(Mesh, PositionsThatAreNotFiniteTakeTheirTrianglesAlong) {
    Reading r;
    read_text(r, with_mesh("0 0 0 1 0 0 1 1 0 NaN 0 0", 4,
                           "<triangles count=\"2\">" + kVertex + "<p>0 1 2 0 2 3</p></triangles>"));
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(positions_of(r), (Indices{0, 1, 2}));
    EXPECT_EQ(r.pointed("SRC_NAN_INF"), "NaN");
}

TEST(Mesh, EmptyAndShortPrimitivesAreSkipped) {
    for (const char* primitive :
         {"<triangles count=\"0\"/>", "<triangles count=\"0\"><p></p></triangles>",
          "<polylist count=\"1\"><vcount>2</vcount><p>0 1</p></polylist>",
          "<polylist count=\"1\"><vcount>9</vcount><p>0 1</p></polylist>",
          "<polylist count=\"1\"><p>0 1 2</p></polylist>",
          "<trifans count=\"1\"><p>0 1</p></trifans>"}) {
        std::string p = primitive;
        size_t end = p.find('>');
        if (p[end - 1] != '/') p.insert(end + 1, kVertex);
        Reading r;
        read_text(r, with_mesh(kSquare, 4, p));
        ASSERT_TRUE(r.scene);
        EXPECT_TRUE(r.scene->geometries.at(0).groups.empty()) << p;
        EXPECT_GT(r.diag.count(Severity::Warning) + r.diag.count(Severity::Error), 0) << p;
    }
}

TEST(Mesh, LinesAreCountedAndNotShaded) {
    Reading r;
    read_text(r,
              with_mesh(kSquare, 4,
                        "<lines count=\"2\">" + kVertex + "<p>0 1 2 3</p></lines>" +
                            "<linestrips count=\"1\">" + kVertex + "<p>0 1 2 3</p></linestrips>"));
    ASSERT_TRUE(r.scene);
    EXPECT_EQ(r.scene->geometries.at(0).line_count, 5u);
    EXPECT_TRUE(r.scene->geometries.at(0).groups.empty());
}

TEST(Mesh, PolygonsWithHolesKeepTheHoleOpen) {
    Reading r;
    read_text(r, with_mesh("0 0 0 4 0 0 4 4 0 0 4 0 1 1 0 1 3 0 3 3 0 3 1 0", 8,
                           "<polygons count=\"1\">" + kVertex +
                               "<ph><p>0 1 2 3</p><h>4 5 6 7</h></ph></polygons>"));
    ASSERT_TRUE(r.scene) << r.all();
    const Geometry& g = r.scene->geometries.at(0);
    const Indices& i = positions_of(r);
    double area = 0;
    for (size_t t = 0; t < i.size(); t += 3) {
        dvec3 a = g.positions[i[t]], b = g.positions[i[t + 1]], c = g.positions[i[t + 2]];
        double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        EXPECT_GE(twice, 0);  // wound like the outline
        area += twice / 2;
    }
    EXPECT_DOUBLE_EQ(area, 16 - 4);
    EXPECT_EQ(i.size(), 3u * 8);
}

}  // namespace
}  // namespace kinora::collada
