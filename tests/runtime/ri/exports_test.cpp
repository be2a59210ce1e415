// tests/runtime/ri/exports_test.cpp: the library has the names of ri.h, and no others.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "ri.h"

namespace {

std::string header() {
    std::ifstream in(KINORA_RI_HEADER);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    return std::regex_replace(text, std::regex(R"(/\*[^]*?\*/)"), " ");
}

// Functions, and what stands behind extern.
std::set<std::string> declared() {
    std::set<std::string> names;
    std::string text = header();
    auto add = [&](const std::string& in, const char* pattern) {
        std::regex name(pattern);
        for (std::sregex_iterator at(in.begin(), in.end(), name), end; at != end; ++at)
            names.insert((*at)[1]);
    };
    add(text, R"(\n\w+\*? (Ri[A-Z]\w*)\()");
    std::regex line(R"(\nextern ([^;{"]*);)");
    for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at)
        add((*at)[1], R"(\b(R[iI]_?[A-Z]\w*)\b)");
    return names;
}

std::set<std::string> exported() {
    std::set<std::string> names;
    std::FILE* nm = popen("nm -D --defined-only " KINORA_RI_LIBRARY, "r");
    char line[1000], name[1000], kind;
    while (nm && std::fgets(line, sizeof line, nm))
        if (std::sscanf(line, "%*s %c %999s", &kind, name) == 2) names.insert(name);
    if (nm) pclose(nm);
    return names;
}

TEST(RiLibrary, ExportsTheNamesOfItsHeader) {
    std::set<std::string> wanted = declared();
    EXPECT_GT(wanted.size(), 250u);
    EXPECT_TRUE(wanted.contains("RiTransformPoints") && wanted.contains("RI_Z") &&
                wanted.contains("RiLastError") && wanted.contains("RiPowerBasis"));
    EXPECT_EQ(exported(), wanted);
}

}  // namespace
