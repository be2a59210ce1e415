// tests/collada/id_path_test.cpp: places in words; what profiles make of severities.
#include "collada/document/id_path.h"

#include <gtest/gtest.h>

#include "collada/document/findings.h"
#include "collada/validate/profile.h"
#include "tests/collada/reading.h"

namespace kinora::collada {

namespace {

const char* kText =
    "<COLLADA version=\"1.4.1\"><a><b/><b id=\"x\"/><c sid=\"it's\"><d>text</d></c></a> </COLLADA>";

std::string path_at(const Document& document, const char* what) {
    ElementIndex index(document);
    return index.path(index.at(uint32_t(std::string_view(kText).find(what))));
}

}  // namespace

TEST(IdPath, NamesIdSidOrNumber) {
    Reading r;
    read_text(r, kText);
    ASSERT_TRUE(r.document);
    EXPECT_EQ(path_at(*r.document, "<COLLADA"), "COLLADA");
    EXPECT_EQ(path_at(*r.document, "<a>"), "a");
    EXPECT_EQ(path_at(*r.document, "<b/>"), "a/b[1]");
    EXPECT_EQ(path_at(*r.document, "\"x\""), "a/b[@id='x']");
    EXPECT_EQ(path_at(*r.document, "text"), "a/c[@sid=\"it's\"]/d");
    EXPECT_EQ(path_at(*r.document, "</c>"), "a/c[@sid=\"it's\"]");
    EXPECT_EQ(path_at(*r.document, " </COLLADA>"), "COLLADA");
}

TEST(IdPath, EveryElementIsFoundByEachOfItsBytes) {
    Reading r;
    read_file(r, test_file("skinned.dae"));
    ASSERT_TRUE(r.document);
    ElementIndex index(*r.document);
    EXPECT_EQ(index.all().size(), r.document->element_count());
    for (const Element* element : index.all()) {
        EXPECT_EQ(&index.at(element->bytes.begin), element);
        EXPECT_EQ(&index.at(element->start_tag.end - 1), element);
        EXPECT_EQ(&index.at(element->bytes.end - 1), element);
    }
}

TEST(IdPath, OfWhatAnErrorCutOff) {
    Reading r;
    read_text(r, "<COLLADA version=\"1.4.1\"><a id=\"q\"><b></a>");
    ASSERT_TRUE(r.document);
    std::vector<Finding> findings = r.diag.findings();
    add_id_paths(*r.document, r.diag.files, findings);
    for (const Finding& finding : findings) EXPECT_FALSE(finding.id_path.empty());
}

TEST(Profile, StrictMakesDeparturesErrorsAndLenientIsQuiet) {
    auto weigh = [](const FindingInfo& info, Profile profile) {
        return profile_severity(info, info.severity, profile);
    };
    EXPECT_EQ(weigh(Code::SCHEMA_ORDER, Profile::Default), Severity::Warning);
    EXPECT_EQ(weigh(Code::SCHEMA_ORDER, Profile::Strict), Severity::Error);
    EXPECT_EQ(weigh(Code::SCHEMA_UNKNOWN_ATTRIBUTE, Profile::Strict), Severity::Error);
    EXPECT_EQ(weigh(Code::LINK_NO_HASH, Profile::Strict), Severity::Error);
    EXPECT_EQ(weigh(Code::DOC_OLD_VERSION, Profile::Strict), Code::DOC_OLD_VERSION.severity);
    EXPECT_EQ(weigh(Code::INFO_UNSUPPORTED, Profile::Strict), Code::INFO_UNSUPPORTED.severity);
    EXPECT_EQ(weigh(Code::SCHEMA_UNKNOWN_ATTRIBUTE, Profile::Lenient), Severity::Off);
    EXPECT_EQ(weigh(Code::SCHEMA_ORDER, Profile::Lenient), Severity::Warning);
    EXPECT_EQ(weigh(Code::XML_SYNTAX, Profile::Lenient), Severity::Error);
}

}  // namespace kinora::collada
