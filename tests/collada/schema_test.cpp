// tests/collada/schema_test.cpp: the element table: its rows, its automata, its simple types, and
// what it says of a document.
#include "collada/schema/schema.h"
#include "collada/text/words_p.h"

#include <expat.h>
#include <gtest/gtest.h>

#include <random>

#include "collada/schema/element_types_p.h"
#include "collada/validate/validate.h"
#include "runtime/base/text_encoding.h"
#include "tests/collada/reading.h"

namespace kinora::collada {
namespace {

// Every row of both versions is parsed: CHECKs stop at one that is not written as it should be.
TEST(ElementTable, IsClosedUnderItsOwnNames) {
    for (Version version : {Version::V1_4_1, Version::V1_5_0}) {
        const ElementTypes& types = ElementTypes::of(version);
        size_t rows = 0;
        for (const ElementRow& row : element_rows()) {
            if (!holds_for(row.versions, version)) continue;
            const ElementType* type = types.find(row.type);
            ASSERT_TRUE(type && type->row == &row) << row.type << " has two rows";
            EXPECT_FALSE(type->rules().content.positions.empty());
            ++rows;
        }
        EXPECT_GT(rows, 300u);
        for (const SimpleRow& row : simple_rows())
            if (holds_for(row.versions, version)) parse_simple(row.name, version);
    }
}

// A model in which two positions of one name may follow the same one could not be walked by one
// state.
TEST(ElementTable, ContentModelsAreDeterministic) {
    for (Version version : {Version::V1_4_1, Version::V1_5_0})
        for (const ElementRow& row : element_rows()) {
            if (!holds_for(row.versions, version)) continue;
            const ContentModel& model = ElementTypes::of(version).find(row.type)->rules().content;
            for (const ContentModel::Position& position : model.positions) {
                std::vector<std::string_view> names;
                for (uint16_t next : position.next) names.push_back(model.positions[next].name);
                std::sort(names.begin(), names.end());
                EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << row.type;
            }
        }
}

// The oracle is a backtracking matcher of the parsed cell.
bool matches(const Particle& p, std::string_view word, const std::vector<Particle>& rest);
bool matches_rest(std::string_view word, const std::vector<Particle>& rest) {
    if (rest.empty()) return word.empty();
    return matches(rest.front(), word, {rest.begin() + 1, rest.end()});
}
bool matches(const Particle& p, std::string_view word, const std::vector<Particle>& rest) {
    if (p.low == 0 && matches_rest(word, rest)) return true;
    if (p.high == 0) return false;
    std::vector<Particle> then = rest;
    if (p.high > 1 && word.size() < 8) {
        Particle again = p;
        again.low = p.low ? p.low - 1 : 0;
        if (p.high != Particle::kMany) --again.high;
        then.insert(then.begin(), again);
    } else if (p.low > 1) {
        return false;
    }
    if (p.kind == Particle::Kind::Element)
        return !word.empty() && word.substr(0, 1) == p.name && matches_rest(word.substr(1), then);
    if (p.kind == Particle::Kind::Choice) {
        for (const Particle& part : p.parts)
            if (matches(part, word, then)) return true;
        return false;
    }
    then.insert(then.begin(), p.parts.begin(), p.parts.end());
    return matches_rest(word, then);
}

TEST(ContentModel, AcceptsWhatItsCellSays) {
    const char* cells[] = {"a? b c*",       "(a | b)* c?",    "a{2,} b{0,2}", "(a b)+ c",
                           "a (b | (c a))", "(a? b) a* b? c", "a{3,3}",       "",
                           "(a | (b c?))+", "b (a b)* c?"};
    for (std::string_view cell : cells) {
        ContentModel model = build_model(cell, Version::V1_4_1);
        Particle parsed = parse_content(cell);
        for (int n = 0; n < 3 * 3 * 3 * 3 * 3 * 4; ++n) {
            std::string word;
            for (int rest = n, k = n % 6; k > 0; --k, rest /= 3) word += char('a' + rest % 3);
            uint16_t at = 0;
            bool walked = true;
            for (char c : word) walked = walked && (at = model.step(at, std::string(1, c)));
            walked = walked && model.positions[at].last;
            EXPECT_EQ(walked, matches_rest(word, {parsed})) << "'" << cell << "' on " << word;
        }
    }
}

struct Value {
    const char* type;
    const char* text;
    bool fits;
};

TEST(SimpleType, WordsAreAsXmlSchemaWritesThem) {
    const Value values[] = {
        {"double", "1", true},
        {"double", "-1.", true},
        {"double", ".5", true},
        {"double", "+1.5e-7", true},
        {"double", "NaN", true},
        {"double", "-INF", true},
        {"double", " 1 ", true},
        {"double", ".", false},
        {"double", "1,5", false},
        {"double", "", false},
        {"double", "1 2", false},
        {"double", "+INF", false},
        {"double", "1e", false},
        {"double", "nan", false},
        {"double", "1.#QNAN", false},
        {"double", "0x1", false},
        {"double", "1.2.3", false},
        {"double[3]", "1 2 3", true},
        {"double[3]", "1 2", false},
        {"double[]", "", true},
        {"double[]", "1 +INF", false},
        {"unsignedLong", "18446744073709551615", true},
        {"unsignedLong", "18446744073709551616", false},
        {"unsignedLong", "-1", false},
        {"long", "-9223372036854775808", true},
        {"long", "9223372036854775808", false},
        {"long", "1.0", false},
        {"byte", "-128", true},
        {"byte", "128", false},
        {"integer", "123456789012345678901234567890", true},
        {"nonNegativeInteger", "+0", true},
        {"positiveInteger", "0", false},
        {"positiveInteger", "10", true},
        {"boolean", "TRUE", false},
        {"boolean", "1", true},
        {"NCName", "a-b.c", true},
        {"NCName", "1a", false},
        {"NCName", "a:b", false},
        {"Name", "a:b", true},
        {"NMTOKEN", "1a:", true},
        {"NMTOKEN", "a b", false},
        {"anyURI", "a b.png", true},
        {"anyURI", "#a#b", false},
        {"anyURI", "", true},
        {"anyURI", "file:///C|/x", true},
        {"anyURI", "http://h:p/", false},
        {"anyURI", "%zz", false},
        {"anyURI", "1:/x", false},
        {"anyURI", "//u@h:80/p?q#f", true},
        {"dateTime", "2008-02-29T24:00:00Z", true},
        {"dateTime", "2008-02-29", false},
        {"dateTime", "2007-02-29T00:00:00", false},
        {"dateTime", "2008-01-01T00:00:00.5+14:00", true},
        {"dateTime", "2008-01-01T00:00:00+14:01", false},
        {"dateTime", "02008-01-01T00:00:00", false},
        {"hexBinary", "0aF", false},
        {"hexBinary", "0aFF", true},
        {"fragment", "#a", true},
        {"fragment", "a", false},
        {"sidref", "a/b/c(1)(2)", true},
        {"sidref", "./b.X", true},
        {"sidref", "a", false},
        {"sidref", "a/b(1)(2)(3)", false},
        {"email", "a.b@c", true},
        {"email", "a..b@c", false},
        {"up_axis", "Z_UP", true},
        {"up_axis", " Z_UP", false},
        {"node", "BONE", false},
    };
    for (const Value& v : values) {
        SimpleType type = parse_simple(v.type, Version::V1_5_0);
        bool fits = check_value(type, v.text).fault == ValueFault::None;
        EXPECT_EQ(fits, v.fits) << v.type << " '" << v.text << "'";
    }
}

// Long texts are scanned in four parts at once: the same verdict as word by word.
// expat's tables of names are those of XML 1.0's fourth edition, too: a tag that it reads.
TEST(SimpleType, NamesBeyondAsciiAreThoseOfXml) {
    for (uint32_t c = 0x80; c < 0x11000; ++c) {
        if (c >= 0xD800 && c < 0xE000) continue;
        std::string letter;
        append_utf8(letter, c);
        for (const std::string& name : {letter, "a" + letter, "a" + letter + "b"}) {
            std::string text = "<" + name + "/>";
            XML_Parser parser = XML_ParserCreate("UTF-8");
            bool tag = XML_Parse(parser, text.data(), int(text.size()), 1) == XML_STATUS_OK;
            XML_ParserFree(parser);
            ASSERT_EQ(is_ncname(name), tag) << std::hex << c;
            ASSERT_EQ(is_name(name), tag) << std::hex << c;
        }
    }
    for (const char* cut : {"a\xc3", "\xe4\xb8", "a\x80", "\xf0\x90\x80\x80"})
        EXPECT_FALSE(is_ncname(cut));
}

TEST(SimpleType, ListsAreCheckedAsTheirWordsAre) {
    std::mt19937 random(5);
    const char* words[] = {"1", "-2.5", "3e7", ".25", "1.e-3", "NaN", "12", "+7", "INF", "-INF"};
    const char* bad[] = {"1.2.3", "x", "1e", "--1", "1,5", "+INF", ".", "e5", "1-2", "I"};
    SimpleType reals = parse_simple("double[]", Version::V1_4_1);
    for (int round = 0; round < 400; ++round) {
        std::string text;
        size_t wrong = round % 2 ? random() % 300 : ~size_t(0);
        std::pair<size_t, size_t> place;
        for (size_t i = 0; i < 300; ++i) {
            std::string word = i == wrong ? bad[random() % 10] : words[random() % 10];
            if (i == wrong) place = {text.size(), text.size() + word.size()};
            text += word + (random() % 5 ? " " : "\n\t ");
        }
        ValueCheck check = check_value(reals, text);
        EXPECT_EQ(check.fault == ValueFault::None, round % 2 == 0) << text;
        if (round % 2) {
            EXPECT_EQ(std::make_pair(check.begin, check.end), place);
        }
    }
}

std::string said(const std::string& content, const std::string& version = "1.4.1") {
    Reading r;
    std::string uri = version == "1.5.0" ? "2008/03" : "2005/11";
    r.document = read_document_text("test.dae",
                                    "<COLLADA xmlns=\"http://www.collada.org/" + uri +
                                        "/COLLADASchema\" version=\"" + version + "\">" + content +
                                        "</COLLADA>",
                                    r.diag);
    check_elements(*r.document, r.diag);
    std::string out;
    for (const Finding& f : r.diag.findings())
        out += (out.empty() ? "" : "; ") + std::string(f.info->code) + ": " + f.message;
    return out;
}

const std::string kAsset =
    "<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></"
    "asset>";

TEST(CheckElements, SaysWhatIsMissing) {
    EXPECT_EQ(said(""), "SCHEMA_MIN_OCCURS: <COLLADA> lacks <asset>");
    EXPECT_EQ(said("<asset><modified>2026-01-01T00:00:00Z</modified></asset>"),
              "SCHEMA_MIN_OCCURS: <asset> lacks <created> before <modified>");
    EXPECT_EQ(said(kAsset + "<library_cameras><camera><optics><technique_common/></optics></camera>"
                            "</library_cameras>"),
              "SCHEMA_MIN_OCCURS: <technique_common> lacks one of <orthographic>, <perspective>");
    EXPECT_EQ(said(kAsset + "<library_animations><animation><source id=\"s\"/></animation>"
                            "</library_animations>"),
              "SCHEMA_MIN_OCCURS: <animation> lacks <animation>");
}

TEST(CheckElements, ASwapIsOneFindingOfOrder) {
    EXPECT_EQ(said("<asset><modified>2026-01-01T00:00:00Z</modified>"
                   "<created>2026-01-01T00:00:00Z</created></asset>"),
              "SCHEMA_ORDER: <created> must stand before <modified>");
    EXPECT_EQ(said(kAsset + "<scene/><library_lights><light><technique_common><ambient><color>1 1 1"
                            "</color></ambient></technique_common></light></library_lights>"),
              "SCHEMA_ORDER: <library_lights> must stand before <scene>");
}

TEST(CheckElements, KnowsTheOtherVersion) {
    EXPECT_EQ(said(kAsset + "<scene><instance_kinematics_scene url=\"#a\"/></scene>"),
              "SCHEMA_VERSION: <instance_kinematics_scene> does not belong to version 1.4; "
              "INFO_UNSUPPORTED: <instance_kinematics_scene> is read but not rendered");
    EXPECT_EQ(said(kAsset + "<library_nodes><node name=\"a name\"/></library_nodes>", "1.5.0"), "");
    EXPECT_NE(said(kAsset + "<library_nodes><node name=\"a name\"/></library_nodes>"), "");
}

TEST(CheckElements, AProfileHoldsADocumentToItsVersion) {
    auto codes = [](Profile profile) {
        Reading r;
        read_text(r,
                  with_scene("<library_nodes><node id=\"spare\" name=\"a name\"/></library_nodes>",
                             "<node id=\"n\"/>"));
        r.diag.clear();
        ValidateOptions options;
        options.profile = profile;
        validate(*r.document, r.diag, options);
        std::string out;
        for (const Finding& f : r.diag.findings())
            if (std::string_view(f.info->code).starts_with("SCHEMA_")) out += f.message;
        return out;
    };
    EXPECT_EQ(codes(Profile::V1_5), "");
    EXPECT_EQ(codes(Profile::V1_4_1), codes(Profile::Default));
    EXPECT_NE(codes(Profile::V1_4_1).find("'a name'"), std::string::npos);
}

TEST(CheckElements, NamespacesAreTheirOwn) {
    std::string extra = "<extra><technique profile=\"x\">";
    std::string end = "</technique></extra>";
    // What COLLADA does not know is free, what it knows by name is checked.
    EXPECT_EQ(said(kAsset + extra + "<thing a=\"1\">text<node/></thing>" + end), "");
    EXPECT_EQ(said(kAsset + extra + "<thing><node bogus=\"1\"/></thing>" + end),
              "SCHEMA_UNKNOWN_ATTRIBUTE: <node> has no attribute 'bogus'");
    EXPECT_EQ(said(kAsset + extra + "<node xmlns=\"urn:x\" bogus=\"1\"/>" + end),
              "SCHEMA_FOREIGN: elements of the namespace 'urn:x' are not checked");
    EXPECT_EQ(said(kAsset + "<x:extra xmlns:x=\"urn:x\"/>").substr(0, 17), "SCHEMA_UNEXPECTED");
}

TEST(CheckElements, MathIsOpaque) {
    std::string formula =
        "<library_formulas><formula><target><param>a</param></target><technique_common>"
        "<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><apply><any/></apply></math>"
        "</technique_common></formula></library_formulas>";
    EXPECT_EQ(said(kAsset + formula, "1.5.0"), "");
}

TEST(CheckElements, AHabitIsReportedOnce) {
    std::string nodes;
    for (int i = 0; i < 50; ++i) nodes += "<node visible=\"1\"><translate>1 2</translate></node>";
    EXPECT_EQ(said(kAsset + "<library_nodes>" + nodes + "</library_nodes>"),
              "SCHEMA_UNKNOWN_ATTRIBUTE: <node> has no attribute 'visible'; "
              "SCHEMA_LENGTH: <translate> holds 2 numbers, expected 3");
}

TEST(SchemaOrder, PutsChildrenWhereTheTableWantsThem) {
    Reading r;
    read_text(r, with_scene("",
                            "<node id=\"n\"><extra/><node id=\"a\"/><own/><scale/>"
                            "<instance_light url=\"#l\"/><rotate/><asset/><node id=\"b\"/>"
                            "</node>"));
    std::string order;
    for (const Element* e : schema_order(*r.document, *r.document->find("n")))
        order += std::string(e->name) + std::string(e->value("id")) + " ";
    EXPECT_EQ(order, "asset scale rotate instance_light nodea own nodeb extra ");
}

TEST(PrintSchema, IsTheSameEachTimeAndNamesItsVersion) {
    for (Version version : {Version::V1_4_0, Version::V1_4_1, Version::V1_5_0}) {
        std::string text = print_schema(version);
        EXPECT_EQ(text, print_schema(version));
        bool is_15 = version == Version::V1_5_0;
        EXPECT_EQ(text.find("2008/03") != std::string::npos, is_15);
        EXPECT_NE(text.find("name=\"profile_RSL\""), std::string::npos);
    }
}

}  // namespace
}  // namespace kinora::collada
