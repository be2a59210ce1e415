// tests/collada/plain_xml_test.cpp: the fast reader of plain XML is held against expat.
#include "collada/document/plain_xml_p.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "collada/document/document_reader_p.h"
#include "tests/folders.h"
#include "tests/mutate.h"
#include "tests/shared.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> texts;
    if (!fs::exists(folder)) return texts;
    for (const auto& at : fs::recursive_directory_iterator(folder))
        if (at.path().extension() == ".dae") texts.push_back(bytes_of(at.path()));
    return texts;
}

bool same(ByteRange a, ByteRange b) {
    return a.begin == b.begin && a.end == b.end;
}

// What differs between two elements and all below them; "" for nothing.
std::string difference(const Element& a, const Element& b) {
    std::string where = "<" + std::string(a.name) + "> at " + std::to_string(a.bytes.begin) + ": ";
    if (a.name != b.name || a.index != b.index) return where + "name or number";
    if (!same(a.bytes, b.bytes) || !same(a.start_tag, b.start_tag)) return where + "place";
    if (a.text != b.text) return where + "text";
    if (a.text_map.size() != b.text_map.size()) return where + "parts of the text";
    for (size_t i = 0; i < a.text_map.size(); ++i)
        if (a.text_map[i].text_offset != b.text_map[i].text_offset ||
            a.text_map[i].file_offset != b.text_map[i].file_offset)
            return where + "place of the text";
    if (a.attributes.size() != b.attributes.size()) return where + "count of attributes";
    for (size_t i = 0; i < a.attributes.size(); ++i) {
        const Attribute &x = a.attributes[i], &y = b.attributes[i];
        if (x.name != y.name || x.value != y.value) return where + "an attribute";
        if (!same(x.bytes, y.bytes) || !same(x.value_bytes, y.value_bytes))
            return where + "an attribute's place";
    }
    const Element *x = a.first_child, *y = b.first_child;
    for (; x && y; x = x->next, y = y->next) {
        std::string inner = difference(*x, *y);
        if (!inner.empty()) return inner;
    }
    return x || y ? where + "count of children" : "";
}

enum class Outcome { Refused, Same };

// Reads a text in both ways. Whatever the fast reader accepts, expat must accept and see alike.
Outcome compare(const std::string& text) {
    Diagnostics diag;
    FileId file = diag.files.add("a.dae", text);
    DocumentBuilder plain("a.dae", file, diag.files.text(file));
    if (!read_plain_xml(diag.files.text(file), plain)) return Outcome::Refused;
    std::optional<Document> document = DocumentReader("a.dae", file, diag).read_by_expat();
    for (const Finding& finding : diag.findings()) {
        EXPECT_FALSE(std::string_view(finding.info->code).starts_with("XML_"))
            << finding.message << " in\n"
            << text;
        if (finding.info == &Code::DOC_ROOT || finding.info == &Code::DOC_TOO_OLD)
            return Outcome::Same;
    }
    EXPECT_TRUE(document && document->whole()) << text;
    if (document) {
        EXPECT_EQ(difference(*plain.root(), document->root()), "") << text;
    }
    return Outcome::Same;
}

std::string in_root(const std::string& content) {
    return "<COLLADA version=\"1.4.1\">" + content + "</COLLADA>";
}

TEST(PlainXml, SeesWhatExpatSees) {
    const char* const contents[] = {
        "",
        "<a/>",
        "<a />",
        "<a\n\tb = '1'  c=\"2\"\r\n></a >",
        "<a b='&lt;&#65;&#x42;\t\r\n&amp;&quot;&apos;&gt; \"'/>",
        "<a b=\"it's ]]> fine\" _c.d-e:f=''/>",
        "<a>text</a>",
        "<a> 1 2 3\n4 5 6\r\n7\r8 </a>",
        "<a>one<!-- - comment with <b> & ]]> \xc3\xa9 \r\n -->two</a>",
        "<a>&lt;b&gt; &amp;&amp; &#x20AC;&#128512;&#10;x</a>",
        "<a><![CDATA[]]></a>",
        "<a><![CDATA[ if (a < b && c[d[0]] > 1)\r\n ]] > x; ]]></a>",
        "<a>before<![CDATA[ in ]]>behind</a>",
        "<a> ] ]] ]> x]</a>",
        "<a>\xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80 \xef\xbf\xbd \x7f</a>",
        "<a b='\xc3\xa4 \xf0\x9f\x98\x80'/>",
        "\n  <a>\r\n    <b>\t1 </b>\r\n   <c/> \n </a>\n",
        "<a>text, then<b/></a>",
        "<a>text, then<b/> \n &#32;</a>",
        "<a>a text that is longer than sixteen bytes, with an umlaut \xc3\xa4 and more &lt; </a>",
    };
    for (const char* content : contents)
        EXPECT_EQ(compare(in_root(content)), Outcome::Same) << content;
    EXPECT_EQ(compare("<?xml version='1.0' encoding=\"UTF-16\" standalone='yes' ?>\r\n"
                      "<!-- a --> <COLLADA/> <!-- b -->\n"),
              Outcome::Same);
    EXPECT_EQ(compare("<c:COLLADA c:a='1'><c:b d='2'>3</c:b ></c:COLLADA>"), Outcome::Same);
}

TEST(PlainXml, LeavesTheRestToExpat) {
    const char* const contents[] = {
        "<a>",
        "</a>",
        "<a></b>",
        "<a/",
        "<a",
        "<",
        "<1/>",
        "< a/>",
        "<a b/>",
        "<a b=1/>",
        "<a b='1/>",
        "<a b='1'c='2'/>",
        "<a b='1' b='2'/>",
        "<a b='<'/>",
        "<a b='&'/>",
        "<a b='&no;'/>",
        "<a b='&lt'/>",
        "<a/ >",
        "<a></a b='1'>",
        "<a>&no;</a>",
        "<a>&#0;</a>",
        "<a>&#xD800;</a>",
        "<a>&#x110000;</a>",
        "<a>&#99999999999;</a>",
        "<a>&#;</a>",
        "<a>&#x;</a>",
        "<a>& b</a>",
        "<a>]]></a>",
        "<a>\x01</a>",
        "<a>\xc3</a>",
        "<a>\xc0\x80</a>",
        "<a>\xed\xa0\x80</a>",
        "<a>\xef\xbf\xbf</a>",
        "<a>\xf4\x90\x80\x80</a>",
        "<a>\xe0\x80\x80</a>",
        "<a b='\x02'/>",
        "<a b='\xff'/>",
        "<!-- -- -->",
        "<!-- \x01 -->",
        "<!-- ",
        "<!--->",
        "<![CDATA[ \x01 ]]>",
        "<![CDATA[ ]]",
        "<![CDATA ]]>",
        "<!a>",
        "<?pi?>",
        "<a><b/>text</a>",
        "<\xc3\xa4/>",
        "<a \xc3\xa4='1'/>",
        "</COLLADA><COLLADA>",
        "</COLLADA>x<COLLADA>",
    };
    for (const char* content : contents)
        EXPECT_EQ(compare(in_root(content)), Outcome::Refused) << content;
    const char* const texts[] = {
        "",
        " ",
        "x",
        " <?xml version='1.0'?><COLLADA/>",
        "<?xml?><COLLADA/>",
        "<?xml version='1.1'?><COLLADA/>",
        "<?xml encoding='a'?><COLLADA/>",
        "<?xml version='1.0' encoding=''?><COLLADA/>",
        "<?xml version='1.0' encoding='1'?><COLLADA/>",
        "<?xml version='1.0' standalone='maybe'?><COLLADA/>",
        "<?xml version='1.0'><COLLADA/>",
        "<!DOCTYPE COLLADA><COLLADA/>",
        "<COLLADA/><COLLADA/>",
        "<COLLADA/>x",
        "<![CDATA[x]]><COLLADA/>",
        "<COLLADA/></COLLADA>",
    };
    for (const char* text : texts) EXPECT_EQ(compare(text), Outcome::Refused) << text;
    EXPECT_EQ(compare(in_root(std::string("a\0b", 3))), Outcome::Refused);
    EXPECT_EQ(compare(in_root("<a/>") + std::string(1, '\0')), Outcome::Refused);
}

TEST(PlainXml, AnyBytesAmidAText) {
    for (int a = 0; a < 256; ++a)
        for (int b : {0, 0x20, 0x41, 0x80, 0x8f, 0x90, 0x9f, 0xa0, 0xbe, 0xbf, 0xc0})
            for (int c : {0x41, 0x80, 0xbe, 0xbf}) {
                std::string bytes = {char(a), char(b), char(c)};
                for (const std::string& text : {bytes, bytes + "\x80"}) {
                    compare(in_root("<a>" + text + "</a>"));
                    compare(in_root("<a b='" + text + "'/>"));
                    compare(in_root("<a" + text + "='1'/>"));
                    compare(in_root("<!--" + text + "-->"));
                    compare(in_root("<a><![CDATA[" + text + "]]></a>"));
                }
            }
}

TEST(PlainXml, ReadsNearlyAllFilesOfTheProject) {
    size_t plain = 0, all = 0;
    for (const std::string& text : files_below(project_folder() + "/assets")) {
        ++all;
        plain += compare(text) == Outcome::Same;
    }
    ASSERT_GT(all, 0u);
    EXPECT_EQ(plain, all);
    plain = all = 0;
    for (const std::string& text : files_below(shared_scenes())) {
        ++all;
        plain += compare(text) == Outcome::Same;
    }
    if (all == 0) GTEST_SKIP() << "no ../shared/scenes";
    EXPECT_GE(plain, all * 9 / 10);
}

TEST(PlainXml, DamagedFilesAreRefusedOrReadAsExpatDoes) {
    std::vector<std::string> corpus;
    for (const std::string& folder :
         {test_data_folder() + "/rules", test_data_folder() + "/deviations"})
        for (const std::string& text : files_below(folder))
            if (text.size() < 8000) corpus.push_back(text);
    ASSERT_GT(corpus.size(), 400u);
    const std::vector<std::string> words = {"<a>",
                                            "</a>",
                                            "<a/>",
                                            "<!--",
                                            "-->",
                                            "<![CDATA[",
                                            "]]>",
                                            "&amp;",
                                            "&#65;",
                                            "&#x0;",
                                            "&a;",
                                            "\r",
                                            "\r\n",
                                            "\t",
                                            "<?a?>",
                                            "<!DOCTYPE a>",
                                            "\"",
                                            "'",
                                            "=",
                                            "--",
                                            "b='1'",
                                            "]",
                                            "\xc3\xa9",
                                            "\xff",
                                            ">",
                                            "<",
                                            "/",
                                            "x:",
                                            std::string(1, '\0')};
    Mutator mutator(corpus, words, 17, 2);
    size_t plain = 0, all = 20000;
    for (size_t i = 0; i < all && !HasFailure(); ++i)
        plain += compare(mutator.next()) == Outcome::Same;
    EXPECT_GT(plain, all / 20);  // damage that leaves XML
    EXPECT_LT(plain, all * 9 / 10);
}

}  // namespace
}  // namespace kinora::collada
