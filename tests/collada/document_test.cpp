// tests/collada/document_test.cpp: the element tree, its places, encodings and XML errors.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

const std::string kRoot =
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">";

TEST(Document, KeepsTheBytesOfElementsAttributesAndText) {
    Reading r;
    std::string text = kRoot +
                       "<asset><unit meter='0.5' name=\"a&amp;b\"/><up_axis> Z_UP "
                       "</up_axis></asset></COLLADA>";
    r.document = read_document_text("t.dae", text, r.diag);
    ASSERT_TRUE(r.document);
    const Element& asset = *r.document->root().child("asset");
    const Element& unit = *asset.child("unit");
    auto bytes = [&](ByteRange b) { return text.substr(b.begin, b.end - b.begin); };
    EXPECT_EQ(bytes(unit.bytes), "<unit meter='0.5' name=\"a&amp;b\"/>");
    EXPECT_EQ(bytes(unit.attributes[0].bytes), "meter='0.5'");
    EXPECT_EQ(bytes(unit.attributes[1].value_bytes), "a&amp;b");
    EXPECT_EQ(unit.value("name"), "a&b");
    const Element& up = *asset.child("up_axis");
    EXPECT_EQ(up.text, " Z_UP ");
    EXPECT_EQ(bytes(up.bytes), "<up_axis> Z_UP </up_axis>");
    EXPECT_EQ(bytes(up.start_tag), "<up_axis>");
    Location where = r.document->text_location(up);
    EXPECT_EQ(text.substr(where.begin, where.end - where.begin), "Z_UP");
    EXPECT_EQ(up.parent, &asset);
    EXPECT_TRUE(asset.text.empty());
}

TEST(Document, MapsDecodedTextToTheFile) {
    Reading r;
    std::string text = kRoot + "<extra>a&lt;b\r\nc<![CDATA[d<e]]>f&#65;g</extra></COLLADA>";
    r.document = read_document_text("t.dae", text, r.diag);
    ASSERT_TRUE(r.document);
    const Element& extra = *r.document->root().child("extra");
    ASSERT_EQ(extra.text, "a<b\ncd<efAg");
    SourceMap map = r.document->source_map(extra);
    for (char c : {'a', 'b', 'c', 'd', 'e', 'f', 'g'}) {
        uint32_t at = uint32_t(extra.text.find(c));
        // Unique letters of the content: the last place in the file before its end tag.
        size_t content = text.find("<extra>") + 7;
        EXPECT_EQ(map.file_offset(at), text.find(c, c == 'c' ? text.find("\n") : content)) << c;
    }
}

TEST(Document, SyntaxErrorsHaveTheirPlaceAndKeepWhatWasWhole) {
    Reading r;
    std::string text = kRoot + "\n<library_lights>\n<light id='a'/>\n<light id='b'>\n </broken>";
    r.document = read_document_text("t.dae", text, r.diag);
    ASSERT_TRUE(r.document);
    EXPECT_FALSE(r.document->whole());
    EXPECT_EQ(r.place("XML_SYNTAX"), "5:4");
    EXPECT_NE(r.document->find("a"), nullptr);
    EXPECT_EQ(r.document->find("b"), nullptr);
    EXPECT_EQ(r.diag.findings()[0].notes.size(), 1u);
}

TEST(Document, KnowsWhatIsNoXml) {
    struct {
        std::string bytes, code;
    } cases[] = {{"", "XML_EMPTY"},
                 {" \n\t", "XML_EMPTY"},
                 {"\xef\xbb\xbf", "XML_EMPTY"},
                 {"\xff\xfe", "XML_EMPTY"},
                 {"\x1f\x8b\x08...", "XML_ENCODING"},
                 {"PK\x03\x04...", "XML_ENCODING"},
                 {"version https://git-lfs.github.com/spec/v1\n", "XML_ENCODING"},
                 {"hello", "XML_SYNTAX"},
                 {"<html/>", "DOC_ROOT"}};
    for (const auto& c : cases) {
        Reading r;
        r.document = read_document_text("t.dae", c.bytes, r.diag);
        EXPECT_FALSE(r.document) << c.bytes;
        EXPECT_EQ(r.count(c.code), 1u) << c.bytes << r.all();
    }
    Reading r;
    EXPECT_FALSE(read_document("/nonexistent/x.dae", r.diag));
    EXPECT_EQ(r.count("XML_OPEN"), 1u);
}

std::string utf16(const std::string& ascii, bool big, bool bom) {
    std::string out = bom ? (big ? "\xfe\xff" : "\xff\xfe") : "";
    for (char c : ascii) {
        if (big) out += '\0';
        out += c;
        if (!big) out += '\0';
    }
    return out;
}

TEST(Document, ReadsUtf16WithPlacesInItsTranscript) {
    std::string text = kRoot + "\n<bogus/>\n</COLLADA>";
    for (bool big : {false, true})
        for (bool bom : {false, true}) {
            Reading r;
            r.document = read_document_text("t.dae", utf16(text, big, bom), r.diag);
            ASSERT_TRUE(r.document);
            check_elements(*r.document, r.diag);
            EXPECT_EQ(r.place("SCHEMA_UNKNOWN_ELEMENT"), "2:1");
        }
}

TEST(Document, ReadsBomLatin1AndBrokenUtf8) {
    Reading bom;
    bom.document = read_document_text("t.dae", "\xef\xbb\xbf" + kRoot + "</COLLADA>", bom.diag);
    EXPECT_TRUE(bom.document);
    EXPECT_TRUE(bom.diag.findings().empty()) << bom.all();
    Reading latin;
    latin.document = read_document_text(
        "t.dae",
        "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>" + kRoot + "<extra>\xe9</extra></COLLADA>",
        latin.diag);
    ASSERT_TRUE(latin.document);
    EXPECT_EQ(latin.document->root().child("extra")->text, "\xc3\xa9");
    Reading broken;
    broken.document =
        read_document_text("t.dae", kRoot + "<extra>\xe9!</extra></COLLADA>", broken.diag);
    ASSERT_TRUE(broken.document);
    EXPECT_EQ(broken.document->root().child("extra")->text, "\xc3\xa9!");
    EXPECT_EQ(broken.count("XML_RECODED"), 1u);
}

TEST(Document, EncodingsOfOneByteHaveTheirOwnCharacters) {
    struct Row {
        const char *encoding, *bytes, *text;
    };
    const Row rows[] = {{"windows-1252", "\x80\x92\x9f\xe9", "\u20ac\u2019\u0178\u00e9"},
                        {"CP1252", "\x93\x94", "\u201c\u201d"},
                        {"ISO-8859-15", "\xa4\xbd\xe9", "\u20ac\u0153\u00e9"},
                        {"ISO-8859-1", "\xa4\xbd\xe9", "\u00a4\u00bd\u00e9"}};
    for (const Row& row : rows) {
        Reading r;
        r.document =
            read_document_text("t.dae",
                               std::string("<?xml version=\"1.0\" encoding=\"") + row.encoding +
                                   "\"?>" + kRoot + "<extra>" + row.bytes + "</extra></COLLADA>",
                               r.diag);
        ASSERT_TRUE(r.document);
        EXPECT_EQ(r.document->root().child("extra")->text, row.text) << row.encoding;
    }
}

TEST(Document, ElementsAreColladasByTheirNamespaceNotTheirPrefix) {
    constexpr const char* kUri = "http://www.collada.org/2005/11/COLLADASchema";
    std::string c = std::string(" xmlns:c=\"") + kUri + "\"";
    Reading r;
    r.document = read_document_text(
        "t.dae",
        kRoot + "<c:asset" + c + "><c:unit/></c:asset><c:extra/><extra" + c +
            "><c:technique xmlns:c=\"urn:x\"><c:node/></c:technique><c:technique/></extra>" +
            "</COLLADA>",
        r.diag);
    ASSERT_TRUE(r.document) << r.all();
    const Element& root = r.document->root();
    ASSERT_TRUE(root.child("asset"));
    EXPECT_TRUE(root.child("asset")->child("unit"));
    EXPECT_TRUE(root.child("c:extra"));  // the prefix ended with <c:asset>
    const Element& extra = *root.child("extra");
    ASSERT_TRUE(extra.child("c:technique"));
    EXPECT_TRUE(extra.child("c:technique")->child("c:node"));  // hidden by another's
    EXPECT_TRUE(extra.child("technique"));
}

TEST(Document, SpaceAroundAnIdIsNoPartOfIt) {
    Reading r;
    r.document = read_document_text(
        "t.dae", kRoot + "<library_nodes id=\" g\t\"><node sid=' s '/></library_nodes></COLLADA>",
        r.diag);
    ASSERT_TRUE(r.document);
    ASSERT_TRUE(r.document->find("g"));
    EXPECT_EQ(r.document->find("g")->child("node")->value("sid"), "s");
}

TEST(Document, RefusesEntitiesAndDepth) {
    Reading r;
    std::string bomb = "<!DOCTYPE COLLADA [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]>" + kRoot +
                       "<extra>&b;</extra></COLLADA>";
    read_document_text("t.dae", bomb, r.diag);
    EXPECT_EQ(r.count("XML_ENTITY"), 1u);
    EXPECT_EQ(r.pointed("XML_ENTITY"), "b");
    Reading deep;
    std::string text = kRoot;
    for (int i = 0; i < 100000; ++i) text += "<node>";
    read_document_text("t.dae", text, deep.diag);
    EXPECT_EQ(deep.count("XML_DEPTH"), 1u);
}

// What is declared costs nothing until it is used, wherever that is; what came before is kept.
TEST(Document, StopsAtTheFirstUseOfAnEntity) {
    std::string declared =
        "<?xml version=\"1.0\"?><!-- &a; --><!DOCTYPE COLLADA [<!ENTITY a \"aaaaaa\">";
    for (int i = 0; i < 40; ++i) {
        std::string from(1, char('a' + i % 26)), to(1, char('a' + (i + 1) % 26));
        if (i) from += std::to_string(i);
        to += std::to_string(i + 1);
        declared += "<!ENTITY " + to + " \"&" + from + ";&" + from + ";&#38;\">";
    }
    declared += "]>" + kRoot + "<asset/><library_lights><light id=\"l\"/></library_lights>";
    const char* const harmless[] = {"", "<extra>&amp;&#65;&lt;</extra>",
                                    "<extra name=\"&quot;&apos;&#x41;\"><![CDATA[&o40;]]></extra>",
                                    "<!--&o40;--><?page &o40;?>"};
    for (const char* text : harmless) {
        Reading r;
        r.document = read_document_text("t.dae", declared + text + "</COLLADA>", r.diag);
        ASSERT_TRUE(r.document) << text << r.all();
        EXPECT_TRUE(r.document->whole()) << text;
        EXPECT_TRUE(r.diag.findings().empty()) << text << r.all();
    }
    const char* const uses[] = {"<extra>&o40;</extra>", "<extra id=\"x&o40;\"/>",
                                "<extra>&unknown;</extra>"};
    for (const char* text : uses) {
        Reading r;
        r.document = read_document_text("t.dae", declared + text + "</COLLADA>", r.diag);
        EXPECT_EQ(r.count("XML_ENTITY"), 1u) << text << r.all();
        ASSERT_TRUE(r.document) << text;
        EXPECT_TRUE(r.document->find("l")) << text;
        EXPECT_FALSE(r.document->whole()) << text;
    }
    Reading without;  // where nothing is declared it is no entity
    without.document =
        read_document_text("t.dae", kRoot + "<extra>&a;</extra></COLLADA>", without.diag);
    EXPECT_EQ(without.count("XML_AMPERSAND"), 1u);
    ASSERT_TRUE(without.document);
    EXPECT_EQ(without.document->root().child("extra")->text, "&a;");
}

// As the exporters meant it that wrote names and paths as they stand.
TEST(Document, ABareAmpersandIsReadAsItStands) {
    struct Row {
        const char *written, *read;
        size_t bare;
    };
    const Row rows[] = {{"Salt & Pepper", "Salt & Pepper", 1},
                        {"a&b.png", "a&b.png", 1},
                        {"?x=1&y=2&z=3", "?x=1&y=2&z=3", 2},
                        {"&", "&", 1},
                        {"R&D; &lt;&#65;&#x42;&amp;", "R&D; <AB&", 1},
                        {"&#;&#x;&#1a;&;", "&#;&#x;&#1a;&;", 4},
                        {"&nbsp;&amp", "&nbsp;&amp", 2},
                        {"&amp;&lt;&gt;&quot;&apos;&#38;", "&<>\"'&", 0}};
    for (const Row& row : rows)
        for (bool attribute : {false, true}) {
            std::string extra = attribute
                                    ? std::string("<extra id='' name=\"") + row.written + "\"/>"
                                    : std::string("<extra>") + row.written + "</extra>";
            Reading r;
            r.document = read_document_text("t.dae",
                                            kRoot + "<!-- & --><extra><![CDATA[&]]></extra>\n" +
                                                extra + "<library_lights/></COLLADA>",
                                            r.diag);
            ASSERT_TRUE(r.document) << row.written;
            EXPECT_TRUE(r.document->whole()) << r.all();
            const Element& read = *r.document->root().child("extra")->next;
            EXPECT_EQ(attribute ? read.value("name") : read.text, row.read);
            EXPECT_EQ(r.count("XML_AMPERSAND"), row.bare) << r.all();
            EXPECT_EQ(r.diag.findings().size(), row.bare) << r.all();
            if (!row.bare) continue;
            EXPECT_EQ(r.pointed("XML_AMPERSAND"), "&");
            EXPECT_EQ(r.place("XML_AMPERSAND").substr(0, 2), "2:");
            EXPECT_NE(r.all().find("write &amp;"), std::string::npos);
        }
}

TEST(Document, ABareAmpersandInLatin1IsReadToo) {
    Reading r;
    r.document =
        read_document_text("t.dae", kRoot + "<extra>\xe9 & \xe8</extra></COLLADA>", r.diag);
    ASSERT_TRUE(r.document) << r.all();
    EXPECT_EQ(r.document->root().child("extra")->text, "\xc3\xa9 & \xc3\xa8");
    EXPECT_EQ(r.count("XML_AMPERSAND") + r.count("XML_RECODED"), 2u) << r.all();
}

// XML 1.0, 2.8: the declaration stands first or not at all.
TEST(Document, ADeclarationBehindOtherThingsIsReadOver) {
    const std::string before[] = {" ",
                                  "\n\n",
                                  "\r\n\t",
                                  "<!-- made by x -->",
                                  "\n<!-- <?xml version='1.0'?> -->\n",
                                  "\xef\xbb\xbf\xef\xbb\xbf",
                                  "\xef\xbb\xbf \n",
                                  " \xef\xbb\xbf"};
    for (const std::string& text : before)
        for (const char* encoding : {"utf-8", "windows-1252"}) {
            bool utf8 = std::string_view(encoding) == "utf-8";
            if (!utf8 && text.find('\xef') != text.npos) continue;  // the mark says UTF-8
            Reading r;
            r.document = read_document_text("t.dae",
                                            text + "<?xml version=\"1.0\" encoding=\"" + encoding +
                                                "\"?>\n" + kRoot + "<extra>" +
                                                (utf8 ? "\xc3\xa9" : "\xe9") + "</extra></COLLADA>",
                                            r.diag);
            ASSERT_TRUE(r.document) << text << r.all();
            EXPECT_EQ(r.count("XML_DECLARATION"), 1u) << text << r.all();
            EXPECT_EQ(r.diag.findings().size(), 1u) << text << r.all();
            EXPECT_EQ(r.document->root().child("extra")->text, "\xc3\xa9") << text;
            auto lines = 1 + std::count(text.begin(), text.end(), '\n');
            EXPECT_EQ(r.place("XML_DECLARATION").substr(0, 2), std::to_string(lines) + ":");
        }
    for (const char* text : {"", "\xef\xbb\xbf"}) {
        Reading r;
        read_document_text(
            "t.dae", text + std::string("<?xml version=\"1.0\"?>") + kRoot + "</COLLADA>", r.diag);
        EXPECT_TRUE(r.diag.findings().empty()) << r.all();
    }
}

// What stands behind the error may hold what seems to be missing.
TEST(Document, AnErrorIsFollowedByNoFindingAboutWhatItCutOff) {
    Reading r;
    read_text(r, kRoot +
                     "<asset><created/><modified/></asset><library_materials><material id=\"m\">"
                     "<instance_effect url=\"#fx\"/></material></library_materials>"
                     "<library_visual_scenes><visual_scene id=\"v\"><node><instance_geometry "
                     "url=\"#g\"/></node></visual_scene></library_visual_scenes>"
                     "<library_effects><effect id=\"fx\"><profile_COMMON></oops>");
    ASSERT_TRUE(r.document);
    const Element& root = r.document->root();
    EXPECT_TRUE(r.document->cut(root));
    EXPECT_TRUE(r.document->cut(*root.child("library_effects")));
    EXPECT_FALSE(r.document->cut(*root.child("library_materials")));
    EXPECT_EQ(r.count("XML_SYNTAX"), 1u) << r.all();
    for (const char* code : {"SCHEMA_EMPTY_LIBRARY", "SCHEMA_MIN_OCCURS", "LINK_UNRESOLVED"})
        EXPECT_EQ(r.count(code), 0u) << r.all();
}

TEST(Document, VersionsNamespacesAndDoubleIdsAreChecked) {
    Reading r;
    r.document = read_document_text(
        "t.dae",
        "<COLLADA xmlns=\"http://www.collada.org/2008/03/COLLADASchema\" version=\"1.4.1\">"
        "<library_lights><light id=\"a\"/><light id=\"a\"/></library_lights></COLLADA>",
        r.diag);
    ASSERT_TRUE(r.document);
    EXPECT_EQ(r.pointed("DOC_NAMESPACE"), "http://www.collada.org/2008/03/COLLADASchema");
    check_elements(*r.document, r.diag);
    EXPECT_EQ(r.count("ID_DUPLICATE"), 1u);
    EXPECT_NE(r.document->find("a")->next_same_id, nullptr);
    Reading v;
    v.document = read_document_text("t.dae", "<COLLADA version=\"1.3\"/>", v.diag);
    EXPECT_EQ(v.pointed("DOC_VERSION"), "1.3");
}

TEST(Document, OfAVersionBefore14IsRefusedAtItsNumber) {
    Reading old;
    old.document =
        read_document_text("t.dae",
                           "<COLLADA\n version=\"1.3.1\"><library type=\"GEOMETRY\"/>"
                           "<scene><node><instance url=\"#g\"/></node></scene></COLLADA>",
                           old.diag);
    EXPECT_FALSE(old.document);
    EXPECT_EQ(old.place("DOC_TOO_OLD"), "2:11");
    EXPECT_NE(old.all().find("error: COLLADA 1.3.1 is not read"), std::string::npos) << old.all();
    EXPECT_EQ(old.count("DOC_VERSION"), 0u);
}

TEST(Document, TheElementTableIsClosedUnderItsOwnNames) {
    // Every file of ours uses only what the table knows.
    for (const char* name : {"matte.dae", "skinned.dae", "common.dae"}) {
        Reading r;
        r.document = read_document(test_file(name), r.diag);
        ASSERT_TRUE(r.document);
        check_elements(*r.document, r.diag);
        for (const char* code : {"SCHEMA_UNKNOWN_ELEMENT", "SCHEMA_UNKNOWN_ATTRIBUTE",
                                 "SCHEMA_UNEXPECTED", "SCHEMA_VERSION"})
            EXPECT_EQ(r.count(code), 0u) << r.all();
    }
}

}  // namespace
}  // namespace kinora::collada
