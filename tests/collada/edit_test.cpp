// tests/collada/edit_test.cpp: edits of a document's bytes.
#include "collada/document/edit.h"

#include <gtest/gtest.h>

#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

TEST(Edit, MakesAllInWhateverOrderTheyCome) {
    std::string_view text = "0123456789";
    EXPECT_EQ(apply_edits(text, {{{8, 9}, "eight"}, {{2, 4}, ""}, {{0, 0}, "<"}, {{10, 10}, ">"}}),
              "<014567eight9>");
    EXPECT_EQ(apply_edits(text, {}), text);
}

TEST(Edit, InsertsAtOnePlaceKeepTheirOrderAndStandBeforeWhatFollows) {
    EXPECT_EQ(apply_edits("abc", {{{1, 1}, "1"}, {{1, 2}, "B"}, {{1, 1}, "2"}}), "a12Bc");
}

TEST(Edit, OfTwoThatOverlapTheFirstGivenIsMade) {
    size_t left_out = 9;
    EXPECT_EQ(apply_edits("abcdef", {{{2, 4}, "X"}, {{3, 5}, "Y"}, {{5, 6}, "Z"}}, &left_out),
              "abXeZ");
    EXPECT_EQ(left_out, 1u);
    EXPECT_EQ(apply_edits("abcdef", {{{0, 6}, ""}, {{3, 3}, "lost"}, {{2, 3}, "lost"}}, &left_out),
              "");
    EXPECT_EQ(left_out, 2u);
    EXPECT_EQ(apply_edits("abcdef", {{{1, 1}, "+"}, {{3, 3}, "-"}, {{1, 4}, "?"}}, &left_out),
              "a+bc-def");
    EXPECT_EQ(left_out, 1u);
    EXPECT_EQ(apply_edits("abcdef", {{{1, 3}, "."}, {{3, 4}, ":"}, {{3, 3}, "|"}}, &left_out),
              "a.|:ef");
    EXPECT_EQ(left_out, 0u);
}

TEST(Edit, SameAsReplacingOneAtATimeFromTheEnd) {
    // Disjoint random edits against std::string::replace.
    uint32_t state = 7;
    auto random = [&](uint32_t n) { return (state = state * 1664525 + 1013904223) / 65536 % n; };
    for (int round = 0; round < 200; ++round) {
        std::string text;
        for (int i = 0; i < 60; ++i) text += char('a' + random(26));
        std::vector<Edit> edits;
        for (uint32_t at = random(5); at + 4 < 60; at += 5 + random(4))
            edits.push_back({{at, at + random(4)}, std::string(random(4), '#')});
        std::string expected = text;
        for (size_t i = edits.size(); i-- > 0;)
            expected.replace(edits[i].bytes.begin, edits[i].bytes.end - edits[i].bytes.begin,
                             edits[i].text);
        for (size_t i = edits.size(); i > 1; --i) std::swap(edits[i - 1], edits[random(i)]);
        EXPECT_EQ(apply_edits(text, edits), expected);
    }
}

TEST(Edit, EscapedTextReadsAsItWas) {
    std::string nasty = "a < b && c > \"d\" 'e' ]]> \t\n \xC3\xA9";
    Reading r;
    read_text(r, with_scene("<extra><technique profile=\"x\"><t " + attribute_text("v", nasty) +
                                ">" + escape_text(nasty) + "</t><c>" + cdata(nasty) +
                                "</c></technique></extra>",
                            ""));
    ASSERT_TRUE(r.document && r.document->whole()) << r.all();
    const Element* technique = r.document->root().child("extra")->child("technique");
    EXPECT_EQ(technique->child("t")->text, nasty);
    EXPECT_EQ(technique->child("t")->value("v"), nasty);
    EXPECT_EQ(technique->child("c")->text, nasty);
}

TEST(Edit, MarkupTakesAPrefixWhereItHasNone) {
    EXPECT_EQ(prefixed("<a b=\"<\"/>", ""), "<a b=\"<\"/>");
    EXPECT_EQ(prefixed("x<a b='1'><c/></a ><d>1 2</d>", "p:"),
              "x<p:a b='1'><p:c/></p:a ><p:d>1 2</p:d>");
    EXPECT_EQ(prefixed("<p:a/><q:b/><!-- <c> --><d><![CDATA[if (a<b)]]></d><?e <f ?>", "p:"),
              "<p:a/><q:b/><!-- <c> --><p:d><![CDATA[if (a<b)]]></p:d><?e <f ?>");
}

TEST(Edit, ATextIsDeclaredUtf8) {
    EXPECT_EQ(declared_utf8("<?xml version=\"1.0\" encoding='ISO-8859-1'?><a encoding=\"x\"/>"),
              "<?xml version=\"1.0\" encoding='utf-8'?><a encoding=\"x\"/>");
    for (const char* as_is : {"<a encoding=\"x\"/>", "<?xml version='1.0'?><a/>"})
        EXPECT_EQ(declared_utf8(as_is), as_is);
}

TEST(Edit, ElementsAreErasedAppendedToAndGivenAttributes) {
    const std::string text =
        "<COLLADA version='1.4.1'>\n  <asset/>\n  <extra type=\"t\" ><technique/><x>1</x></extra>\n"
        "</COLLADA>\n";
    Reading r;
    r.document = read_document_text("t.dae", text, r.diag);
    ASSERT_TRUE(r.document);
    const Element& root = r.document->root();
    const Element& extra = *root.child("extra");
    auto edited = [&](Edit e) { return apply_edits(text, {std::move(e)}); };
    EXPECT_EQ(edited(erase_element(text, *root.child("asset"))),
              "<COLLADA version='1.4.1'>\n  <extra type=\"t\" ><technique/><x>1</x></extra>\n"
              "</COLLADA>\n");
    EXPECT_EQ(edited(erase_element(text, *extra.child("x"))),
              "<COLLADA version='1.4.1'>\n  <asset/>\n  <extra type=\"t\" ><technique/></extra>\n"
              "</COLLADA>\n");
    EXPECT_NE(
        edited(append_child(text, *root.child("asset"), "<unit/>")).find("<asset><unit/></asset>"),
        std::string::npos);
    EXPECT_NE(edited(append_child(text, extra, "<y/>")).find("<x>1</x><y/></extra>"),
              std::string::npos);
    EXPECT_NE(edited(set_attribute(text, extra, "id", "a\"b"))
                  .find("<extra type=\"t\" id=\"a&quot;b\" >"),
              std::string::npos);
    EXPECT_NE(edited(set_attribute(text, *extra.child("technique"), "profile", "p"))
                  .find("<technique profile=\"p\"/>"),
              std::string::npos);
    EXPECT_NE(edited(set_attribute(text, root, "version", "it's")).find("version='it&apos;s'"),
              std::string::npos);
}

}  // namespace
}  // namespace kinora::collada
