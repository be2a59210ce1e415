// tests/collada/write_test.cpp: read, write, read gives an equal document, and the same bytes.
#include "collada/document/write.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>

#include "collada/document/edit.h"
#include "tests/collada/reading.h"
#include "tests/folders.h"
#include "tests/shared.h"

namespace kinora::collada {
namespace {

namespace fs = std::filesystem;

std::string written(const std::string& text) {
    Diagnostics diag;
    auto document = read_document_text("t.dae", text, diag);
    EXPECT_TRUE(document && document->whole()) << text;
    return document ? write(*document, diag.files) : "";
}

std::string root(const std::string& content) {
    return "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">" +
           content + "</COLLADA>";
}

// Reads, writes, reads and writes again; "" or what went wrong.
std::string round_trip(const Document& document, const SourceFiles& files) {
    std::string once = write(document, files);
    Diagnostics diag;
    auto again = read_document_text(document.path(), once, diag);
    if (!again || !again->whole()) return "cannot be read again";
    std::string difference;
    if (!equal(document, *again, &difference)) return difference;
    if (!equal(*again, document, &difference)) return difference;
    return write(*again, diag.files) == once ? "" : "the second text is another";
}

TEST(Write, GivesEachElementItsLineAndKeepsAllThatIsInTheFile) {
    EXPECT_EQ(
        written("<?xml version=\"1.0\"?>\n<!-- head -->" +
                root("<asset ><unit meter = '1'   name='a\"b'/><up_axis>Y_UP</up_axis></asset>"
                     "<!-- two\r\nlines --><?tool x?><extra></extra>") +
                "<!--end-->"),
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- head -->\n"
        "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
        "  <asset>\n    <unit meter=\"1\" name=\"a&quot;b\"/>\n"
        "    <up_axis>Y_UP</up_axis>\n  </asset>\n"
        "  <!-- two\nlines -->\n  <?tool x?>\n  <extra/>\n</COLLADA>\n<!--end-->\n");
}

TEST(Write, NumbersAreShortestWithTheSameValue) {
    EXPECT_EQ(shortest_number("1.500"), "1.5");
    EXPECT_EQ(shortest_number("+007"), "7");
    EXPECT_EQ(shortest_number("-0"), "-0");
    EXPECT_EQ(shortest_number("0"), "0");
    EXPECT_EQ(shortest_number("100000000"), "100000000");  // an int knows no exponent
    EXPECT_EQ(shortest_number("12345678901234567890"), "12345678901234567890");
    EXPECT_EQ(shortest_number("0.1000000000000000055511151231257827"), "0.1");
    for (const char* kept : {"NaN", "INF", "1,5", "1e999", "-1.#QNAN", "+-2", "abc", ""})
        EXPECT_EQ(shortest_number(kept), kept);
    uint64_t state = 1;
    for (int i = 0; i < 20000; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        double value;
        std::memcpy(&value, &state, 8);
        if (value - value != 0) continue;
        char digits[64];
        std::snprintf(digits, sizeof digits, "%.25e", value);
        if (std::strtod(digits, nullptr) != value || std::abs(value) < 1e-300) continue;
        EXPECT_EQ(std::strtod(shortest_number(digits).c_str(), nullptr), value) << digits;
    }
}

TEST(Write, NumberListsOfPrivateDataAndTextStay) {
    std::string text = written(
        root("<extra><technique profile=\"x\"><float>1.50  2</float></technique></extra>"
             "<library_nodes><node id=\"n\"><translate>1.50 \n 2.0\t3</translate>"
             "<extra><technique profile=\"y\"><matrix>01</matrix></technique></extra></node>"
             "</library_nodes><asset><title>007  1.50</title></asset>"));
    EXPECT_NE(text.find("<float>1.50  2</float>"), text.npos);
    EXPECT_NE(text.find("<translate>1.5 2 3</translate>"), text.npos);
    EXPECT_NE(text.find("<matrix>01</matrix>"), text.npos);
    EXPECT_NE(text.find("<title>007  1.50</title>"), text.npos);
}

TEST(Write, MixedContentAndPreservedSpaceAreCopied) {
    for (const char* part :
         {"<extra><technique profile=\"h\"><b xmlns=\"h\">one <i>two</i> three &amp; "
          "four</b></technique></extra>",
          "<extra xml:space=\"preserve\">  <x/> <y>  </y> </extra>",
          "<asset><title>a <!-- c --> b</title></asset>"}) {
        std::string text = written(root(part));
        std::string inner = part;
        size_t content = inner.find(inner.find("<b") != inner.npos    ? "<b"
                                    : inner.find("<ti") != inner.npos ? "<title"
                                                                      : "<extra xml");
        size_t end = inner.find(inner.find("</b>") != inner.npos   ? "</b>"
                                : inner.find("</ti") != inner.npos ? "</title>"
                                                                   : "</extra>");
        EXPECT_NE(text.find(inner.substr(content, end - content)), text.npos) << text;
    }
}

TEST(Write, TextSurvivesWhateverItHolds) {
    const std::string texts[] = {"a]]>b",
                                 "if (a < b && c > d)\n    x = \"]]>\";\n",
                                 "one line & more",
                                 " leading and trailing ",
                                 "tab\tand return \r in it <x>\n",
                                 "<!-- no comment -->\n<?no pi?>",
                                 "\xC3\xA9\xE2\x82\xAC"};
    for (const std::string& text : texts) {
        Diagnostics diag;
        auto document = read_document_text(
            "t.dae",
            root("<extra " + attribute_text("name", text) + "><technique profile=\"p\"><c>" +
                 escape_text(text) + "</c></technique></extra>"),
            diag);
        ASSERT_TRUE(document && document->whole());
        EXPECT_EQ(document->root().child("extra")->child("technique")->child("c")->text, text);
        EXPECT_EQ(round_trip(*document, diag.files), "") << write(*document, diag.files);
    }
}

TEST(Write, CodeInCdataStaysReadable) {
    std::string code = "surface s() {\n    if (1 < 2 && 3 > 2) Ci = 1; <!-- x -->\n}\n";
    std::string text =
        written(root("<library_effects><effect id=\"e\"><profile_RSL><technique "
                     "sid=\"t\"><code><![CDATA[" +
                     code +
                     "]]></code></technique></profile_RSL></effect>"
                     "</library_effects>"));
    EXPECT_NE(text.find("<code><![CDATA[" + code + "]]></code>"), text.npos) << text;
}

TEST(Write, PrefixesStay) {
    std::string text =
        "<c:COLLADA xmlns:c=\"http://www.collada.org/2005/11/COLLADASchema\" "
        "xmlns:f=\"urn:f\" version=\"1.4.1\"><c:extra><c:technique profile=\"f\">"
        "<f:thing f:a=\"1\"/><plain xmlns=\"urn:g\"/></c:technique></c:extra></c:COLLADA>";
    std::string out = written(text);
    for (const char* part : {"<c:COLLADA xmlns:c=", "<c:technique profile=\"f\">",
                             "<f:thing f:a=\"1\"/>", "<plain xmlns=\"urn:g\"/>", "</c:COLLADA>"})
        EXPECT_NE(out.find(part), out.npos) << out;
}

TEST(Write, EqualTellsDifferences) {
    Diagnostics diag;
    auto read = [&](const std::string& content) {
        return *read_document_text("t.dae", root(content), diag);
    };
    Document a = read(
        "<extra id=\"e\" type=\"t\"><technique profile=\"x\"><n>1</n></technique>"
        "</extra>");
    std::string where;
    EXPECT_TRUE(equal(a,
                      read("<extra type='t' id='e'> <technique profile=\"x\"><n>1</n>\n"
                           "</technique></extra>"),
                      &where))
        << where;
    const char* kOthers[] = {
        "<extra id=\"e\"><technique profile=\"x\"><n>1</n></technique></extra>",
        "<extra id=\"e\" type=\"u\"><technique profile=\"x\"><n>1</n></technique></extra>",
        "<extra id=\"e\" type=\"t\"><technique profile=\"x\"><n>1.0</n></technique></extra>",
        "<extra id=\"e\" type=\"t\"><technique profile=\"x\"><m>1</m></technique></extra>",
        "<extra id=\"e\" type=\"t\"><technique profile=\"x\"><n>1</n><n/></technique></extra>",
        "<extra id=\"e\" type=\"t\"><technique profile=\"x\"/></extra>"};
    for (const char* other : kOthers) {
        where.clear();
        EXPECT_FALSE(equal(a, read(other), &where)) << other;
        EXPECT_NE(where, "");
    }
}

// --- over files
// ------------------------------------------------------------------------------------

std::vector<std::string> documents_below(const fs::path& folder) {
    std::vector<std::string> paths;
    if (!fs::exists(folder)) return paths;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".dae") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::vector<std::string> own_documents() {
    std::vector<std::string> paths;
    for (const char* folder : {"/assets", "/tests/collada/files", "/tests/runtime"})
        for (std::string& path : documents_below(project_folder() + std::string(folder)))
            paths.push_back(std::move(path));
    return paths;
}

// Returns how many of the files were read whole.
size_t expect_round_trips(const std::vector<std::string>& paths) {
    size_t whole = 0;
    for (const std::string& path : paths) {
        Diagnostics diag;
        auto document = read_document(path, diag);
        if (!document || !document->whole()) continue;
        ++whole;
        EXPECT_EQ(round_trip(*document, diag.files), "") << path;
    }
    return whole;
}

TEST(Write, EveryFileReadsBackEqualAndWritesTheSameAgain) {
    EXPECT_GT(expect_round_trips(own_documents()), 0u);
}
TEST(Write, EverySharedFileReadsBackEqualAndWritesTheSameAgain) {
    if (!fs::exists(shared_scenes())) GTEST_SKIP() << "no ../shared/scenes";
    EXPECT_GT(expect_round_trips(documents_below(shared_scenes())), 10u);
}

// xmllint's verdict by Debian's XSD, which needs the schema of xml: attributes by a catalog.
class Xmllint {
  public:
    Xmllint() : folder_(fs::temp_directory_path() / ("kinora-xml-" + std::to_string(getpid()))) {
        fs::create_directories(folder_);
        std::ofstream(folder_ / "xml.xsd")
            << "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\" "
               "targetNamespace=\"http://www.w3.org/XML/1998/namespace\">"
               "<xs:attribute name=\"base\" type=\"xs:anyURI\"/>"
               "<xs:attribute name=\"lang\" type=\"xs:language\"/></xs:schema>";
        std::ofstream(folder_ / "catalog.xml")
            << "<catalog xmlns=\"urn:oasis:names:tc:entity:xmlns:xml:catalog\">"
               "<system systemId=\"http://www.w3.org/2001/03/xml.xsd\" uri=\"xml.xsd\"/>"
               "<system systemId=\"http://www.w3.org/2001/xml.xsd\" uri=\"xml.xsd\"/>"
               "<uri name=\"http://www.w3.org/2001/03/xml.xsd\" uri=\"xml.xsd\"/>"
               "<uri name=\"http://www.w3.org/2001/xml.xsd\" uri=\"xml.xsd\"/></catalog>";
    }
    ~Xmllint() { fs::remove_all(folder_); }
    static bool present() {
        return fs::exists(kSchema) && std::system("xmllint --version >/dev/null 2>&1") == 0;
    }
    // Which of the files are valid; the schema is read once for all.
    std::vector<bool> valid(const std::vector<std::string>& paths) const {
        std::ofstream list(file("list"));
        for (const std::string& path : paths) list << path << '\n';
        list.close();
        std::string command = "XML_CATALOG_FILES=" + file("catalog.xml") +
                              " xargs -d '\\n' xmllint" + " --nonet --noout --huge --schema " +
                              kSchema + " < " + file("list") + " 2>&1 | grep ' validates$' > " +
                              file("valid");
        std::set<std::string> good;
        if (std::system(command.c_str()) != 0) return std::vector<bool>(paths.size());
        std::ifstream lines(file("valid"));
        for (std::string line; std::getline(lines, line);)
            good.insert(line.substr(0, line.size() - std::strlen(" validates")));
        std::vector<bool> result;
        for (const std::string& path : paths) result.push_back(good.count(path) > 0);
        return result;
    }
    std::string file(const std::string& name) const { return folder_ / name; }

  private:
    static constexpr const char* kSchema = "/usr/lib/opencollada/collada_schema_1_4_1.xsd";
    fs::path folder_;
};

// Returns how many of the files the official schema accepts.
size_t expect_valid_when_written(const std::vector<std::string>& paths) {
    Xmllint lint;
    std::vector<std::string> inputs, outputs;
    std::vector<bool> valid = lint.valid(paths);
    for (size_t i = 0; i < paths.size(); ++i) {
        if (!valid[i]) continue;
        Diagnostics diag;
        auto document = read_document(paths[i], diag);
        EXPECT_TRUE(document && document->whole()) << paths[i];
        if (!document) continue;
        inputs.push_back(paths[i]);
        outputs.push_back(lint.file(std::to_string(i) + ".dae"));
        std::ofstream(outputs.back()) << write(*document, diag.files);
    }
    std::vector<bool> still = lint.valid(outputs);
    for (size_t i = 0; i < inputs.size(); ++i) EXPECT_TRUE(still[i]) << inputs[i];
    return inputs.size();
}

TEST(Write, WhatTheOfficialSchemaAcceptsItAcceptsWhenWritten) {
    if (!Xmllint::present()) GTEST_SKIP() << "no xmllint or no XSD (opencollada-tools)";
    expect_valid_when_written(own_documents());
}
TEST(Write, WhatTheOfficialSchemaAcceptsOfSharedFilesItAcceptsWhenWritten) {
    if (!Xmllint::present()) GTEST_SKIP() << "no xmllint or no XSD (opencollada-tools)";
    if (!fs::exists(shared_scenes())) GTEST_SKIP() << "no ../shared/scenes";
    EXPECT_GT(expect_valid_when_written(documents_below(shared_scenes())), 3u);
}

}  // namespace
}  // namespace kinora::collada
