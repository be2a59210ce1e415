// tests/collada/fix_test.cpp: repairs remove their findings, keep the scene and all other bytes.
#include <gtest/gtest.h>

#include "collada/document/findings.h"
#include "collada/validate/fix.h"
#include "tests/collada/reading.h"

namespace kinora::collada {

namespace {

bool every(const FindingInfo&, const void*) {
    return true;
}

FixResult fixed(const std::string& text) {
    return fix_text("test.dae", text, {}, every, nullptr);
}

size_t count_of(const std::string& text, const FindingInfo& code) {
    Reading r;
    r.document = read_document_text("test.dae", text, r.diag);
    if (r.document) validate(*r.document, r.diag);
    return r.count(code.code);
}

// One deviation: the code it gives, the text, what of it is replaced by what.
struct Case {
    const FindingInfo* code;
    std::string text, old, repaired;
};

std::string triangle(const std::string& primitives) {
    return with_mesh("0 0 0 1 0 0 0 1 0", 3, primitives);
}

const char* kTriangle =
    "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p>"
    "</triangles>";

std::string replaced(std::string text, const std::string& old, const std::string& by) {
    size_t at = text.find(old);
    EXPECT_NE(at, text.npos) << old;
    return at == text.npos ? text : text.replace(at, old.size(), by);
}

std::vector<Case> cases() {
    std::string good = triangle(kTriangle);
    return {
        {&Code::SRC_COUNT, replaced(good, "count=\"9\"", "count='8'"), "count='8'", "count='9'"},
        {&Code::SRC_ACCESSOR_COUNT, replaced(good, "count=\"3\"", "count=\"4\""), "count=\"4\"",
         "count=\"3\""},
        {&Code::SRC_STRIDE, replaced(good, "stride=\"3\"", "stride=\"1\""), "stride=\"1\"",
         "stride=\"3\""},
        {&Code::PRIM_COUNT, replaced(good, "<triangles count=\"1\"", "<triangles  count=\"7\""),
         "count=\"7\"", "count=\"1\""},
        {&Code::SRC_COMMA_DECIMAL, replaced(good, "0 0 0 1 0 0", "0 0 0 1,25 0 0"), "1,25", "1.25"},
        {&Code::SRC_COMMA_DECIMAL,
         replaced(good, "</modified>", "</modified><unit name=\"centimeter\" meter=\"0,010\"/>"),
         "0,010", "0.010"},
        {&Code::LINK_NO_HASH, replaced(good, "url=\"#g\"", "url=\"g\""), "url=\"g\"", "url=\"#g\""},
        {&Code::UPAXIS_SPELLING,
         replaced(good, "</modified>", "</modified><up_axis> z_up </up_axis>"), "z_up", "Z_UP"},
        {&Code::XML_AMPERSAND, replaced(good, "<geometry ", "<geometry name=\"a & b\" "), "a & b",
         "a &amp; b"},
        {&Code::SCHEMA_EMPTY_LIBRARY,
         replaced(good, "<library_geometries>", "<library_lights/>\n<library_geometries>"),
         "\n<library_lights/>", ""},
    };
}

}  // namespace

TEST(Fix, RemovesTheFindingAndChangesNoOtherByte) {
    for (const Case& c : cases()) {
        SCOPED_TRACE(c.code->code);
        ASSERT_GT(count_of(c.text, *c.code), 0u);
        FixResult result = fixed(c.text);
        EXPECT_EQ(result.text, replaced(c.text, c.old, c.repaired));
        EXPECT_EQ(count_of(result.text, *c.code), 0u);
        ASSERT_EQ(result.fixes.size(), 1u);
        EXPECT_STREQ(result.fixes[0].info->code, c.code->code);
        EXPECT_TRUE(fixed(result.text).fixes.empty());
    }
}

TEST(Fix, OrdersChildrenAtEveryDepthWithTheirComments) {
    std::string text = with_scene(
        "<library_nodes><node id=\"a\">\n"
        "  <node id=\"b\">\n    <extra/>\n    <!-- of c -->\n    <node id=\"c\"/>\n  </node>\n"
        "  <!-- moves it -->\n  <translate>1 2 3</translate>\n</node></library_nodes>",
        "<node id=\"n\"><instance_node url=\"#a\"/></node>");
    FixResult result = fixed(text);
    EXPECT_EQ(count_of(result.text, Code::SCHEMA_ORDER), 0u);
    EXPECT_LT(result.text.find("<!-- moves it -->\n  <translate>"),
              result.text.find("<node id=\"b\">"));
    EXPECT_LT(result.text.find("<!-- of c -->\n    <node id=\"c\"/>"), result.text.find("<extra"));
    EXPECT_TRUE(fixed(result.text).fixes.empty());
    // Sorted or not: the same bytes, elsewhere.
    std::string before = text, after = result.text;
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    EXPECT_EQ(before, after);
}

TEST(Fix, KeepsWhatTheSceneMeans) {
    std::string text = triangle(kTriangle);
    for (const Case& c : cases())
        if (text.find(c.repaired) != text.npos && !c.repaired.empty() && c.repaired != "1.25")
            text = replaced(text, c.repaired, c.old);
    Reading before, after;
    read_text(before, text);
    read_text(after, fixed(text).text);
    ASSERT_TRUE(before.scene && after.scene);
    ASSERT_EQ(before.scene->geometries.size(), after.scene->geometries.size());
    EXPECT_EQ(before.scene->geometries[0].positions, after.scene->geometries[0].positions);
    EXPECT_EQ(before.scene->geometries[0].groups[0].indices,
              after.scene->geometries[0].groups[0].indices);
    EXPECT_EQ(before.scene->nodes.size(), after.scene->nodes.size());
}

// Three columns a step of one: were the count made to fit the step, the mesh would fall apart.
TEST(Fix, AnAccessorIsAsWideAsItsParams) {
    std::string good = triangle(kTriangle), accessor = "count=\"3\" stride=\"3\"";
    for (const char* wrong : {"count=\"20\" stride=\"1\"", "count=\"20\""}) {
        FixResult result = fixed(replaced(good, accessor, wrong));
        EXPECT_NE(result.text.find("count=\"3\""), std::string::npos) << result.text;
        EXPECT_NE(result.text.find("stride=\"3\""), std::string::npos) << result.text;
    }
    // Numbers of one column that were given three names are read one by one: they stay.
    std::string single = replaced(good, accessor, "count=\"9\" stride=\"1\"");
    EXPECT_EQ(fixed(single).text, single);
}

TEST(Fix, LeavesWhatIsOthersOrNoDeviation) {
    std::string good = triangle(kTriangle);
    for (const char* library : {"<library_lights><?keep me?></library_lights>",
                                "<library_lights>\n<?keep me?><!-- mine --></library_lights>",
                                "<library_lights><!-- mine --></library_lights>"}) {
        std::string text =
            replaced(good, "<library_geometries>", std::string(library) + "\n<library_geometries>");
        EXPECT_EQ(fixed(text).text, text);
    }
    std::string word = replaced(good, "0 0 0 1 0 0", "0 0 0 1,25 x,5 0");
    EXPECT_EQ(fixed(word).text, replaced(word, "1,25", "1.25"));
    std::string extra = replaced(
        good, "</mesh>",
        "<extra><technique profile=\"X\"><input source=\"pos\"/></technique></extra></mesh>");
    std::string both = replaced(extra, "source=\"#pos\"", "source=\"pos\"");
    EXPECT_EQ(fixed(both).text, extra);
}

TEST(Fix, LeavesATextThatIsNoWholeXmlAlone) {
    std::string text = triangle(kTriangle);
    text.resize(text.size() - 20);
    FixResult result = fixed(text);
    EXPECT_EQ(result.text, text);
    EXPECT_TRUE(result.fixes.empty());
}

TEST(Fix, DoesOnlyWhatIsWanted) {
    std::string text = replaced(replaced(triangle(kTriangle), "url=\"#g\"", "url=\"g\""),
                                "count=\"9\"", "count=\"8\"");
    auto counts_only = [](const FindingInfo& info, const void*) {
        return std::string_view(info.code) == "SRC_COUNT";
    };
    EXPECT_EQ(fix_text("test.dae", text, {}, counts_only, nullptr).text,
              replaced(text, "count=\"8\"", "count=\"9\""));
}

TEST(Fix, EveryCodeItKnowsHasARow) {
    for (const FindingInfo* info : fixable_findings()) {
        bool known = false;
        for (auto row = all_findings(); *row; ++row) known = known || *row == info;
        EXPECT_TRUE(known) << info->code;
    }
}

}  // namespace kinora::collada
