// tests/rsl/preprocess_test.cpp: macros, conditions and includes against expansions worked by hand.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

std::string expand(const std::string& text, CompileOptions options = {}) {
    TestSource source(text);
    TokenStream tokens = preprocess(source.source, options, source.diagnostics);
    std::string out;
    for (const Token& t : tokens.tokens) {
        if (t.kind == TokenKind::End) break;
        if (!out.empty()) out += ' ';
        out += t.text;
    }
    return source.diagnostics.has_errors() ? source.messages() : out;
}

TEST(Preprocess, ReplacesObjectsAndFunctions) {
    EXPECT_EQ(expand("#define A 1\n#define F(x, y) (x + y)\nA F(A, (2, 3)) F"),
              "1 ( 1 + ( 2 , 3 ) ) F");
}

TEST(Preprocess, AMacroIsNotReplacedInsideItself) {
    EXPECT_EQ(expand("#define A B\n#define B A x\nA B"), "A x B x");
    EXPECT_EQ(expand("#define f(x) f(x + 1)\nf(f(2))"), "f ( f ( 2 + 1 ) + 1 )");
}

// C99 6.10.3.5, example 3, the lines without its strings.
TEST(Preprocess, FollowsTheExampleOfTheStandard) {
    const char* text =
        "#define x 3\n#define f(a) f(x * (a))\n#undef x\n#define x 2\n#define g f\n"
        "#define z z[0]\n#define h g(~\n#define m(a) a(w)\n#define w 0,1\n#define t(a) a\n"
        "#define p() int\n#define q(x) x\n#define r(x,y) x ## y\n"
        "f(y+1) + f(f(z)) % t(t(g)(0) + t)(1);\n"
        "p() i[q()] = { q(1), r(2,3), r(4,), r(,5), r(,) };\n";
    EXPECT_EQ(expand(text),
              "f ( 2 * ( y + 1 ) ) + f ( 2 * ( f ( 2 * ( z [ 0 ] ) ) ) ) % f ( 2 * ( 0 ) ) + t ( "
              "1 ) ; int i [ ] = { 1 , 23 , 4 , 5 , } ;");
}

TEST(Preprocess, MakesStringsAndJoinsTokens) {
    EXPECT_EQ(expand("#define S(x) #x\n#define J(a, b) a ## b\nS(a + \"b\") J(no, ise)"),
              "\"a + \\\"b\\\"\" noise");
}

TEST(Preprocess, LeavesOutMarksOfVersionControl) {
    EXPECT_EQ(expand("#ident \"@(#)a 1.2\"\n#sccs \"@(#)a 1.2\"\nx"), "x");
}

TEST(Preprocess, EvaluatesConditionsAsCDoes) {
    auto taken = [](const std::string& condition) {
        return expand("#define ONE 1\n#if " + condition + "\nyes\n#else\nno\n#endif") == "yes";
    };
    EXPECT_TRUE(taken("1 + 2 * 3 == 7 && !defined(TWO)"));
    EXPECT_TRUE(taken("defined ONE && ONE"));
    EXPECT_TRUE(taken("(2 < 1) == 0 ? 5 % 3 == 2 : 0"));
    EXPECT_TRUE(taken("-1 < 0 && ~0 == -1 && (1 << 4 | 1) == 17"));
    EXPECT_FALSE(taken("UNKNOWN_NAME"));
    EXPECT_FALSE(taken("ONE - 1 || 0"));
    EXPECT_TRUE(taken("010 == 8 && 08 == 8 && 0 == 00"));
}

TEST(Preprocess, AnOperandThatDoesNotCountMayDivideByZero) {
    EXPECT_EQ(expand("#if 0 && 100 / 0 > 3\na\n#else\nb\n#endif"), "b");
    EXPECT_EQ(expand("#if 2 || 1 % 0\na\n#else\nb\n#endif"), "a");
    EXPECT_EQ(expand("#if (1 ? 5 : 1 / 0) == 5\na\n#else\nb\n#endif"), "a");
    EXPECT_EQ(expand("#if 0 ? 1 / 0 : 4\na\n#else\nb\n#endif"), "a");
}

TEST(Preprocess, ACommaBeforeNoRestOfArgumentsGoesAway) {
    EXPECT_EQ(expand("#define PR(f, ...) printf(f, ## __VA_ARGS__)\nPR(\"y\"); PR(\"x\", 1, 2)"),
              "printf ( \"y\" ) ; printf ( \"x\" , 1 , 2 )");
}

TEST(Preprocess, TakesOneGroupOfEachCondition) {
    EXPECT_EQ(expand("#if 0\na\n#elif 1\nb\n#elif 1\nc\n#else\nd\n#endif e"), "b");
    EXPECT_EQ(expand("#ifdef A\n#if 1\na\n#else\nb\n#endif\n#else\nc\n#endif\n"), "c");
    EXPECT_EQ(expand("#if 0\n#if 1 / 0\n#error x\n\"open\n#endif\n#endif\nok"), "ok");
}

TEST(Preprocess, OptionsDefineAndUndefine) {
    CompileOptions options;
    options.defines = {{"A", "1 + 2"}, {"B", "3"}};
    options.undefines = {"B"};
    EXPECT_EQ(expand("A B", options), "1 + 2 B");
}

TEST(Preprocess, KeepsPragmasAndSkipsLineMarkers) {
    TestSource source("#pragma annotation \"a\" \"b\"\n#line 3 \"x\"\n# 4\nz");
    TokenStream tokens = preprocess(source.source, {}, source.diagnostics);
    ASSERT_EQ(tokens.pragmas.size(), 1u);
    EXPECT_EQ(tokens.pragmas[0].text, "annotation \"a\" \"b\"");
    EXPECT_EQ(tokens.tokens.size(), 2u);
    EXPECT_FALSE(source.diagnostics.has_errors());
}

TEST(Preprocess, KnowsFileAndLine) {
    EXPECT_EQ(expand("\n__LINE__ __FILE__"), "2 \"test.sl\"");
}

TEST(Preprocess, AMacroTokenStandsWhereTheMacroIsUsed) {
    TestSource source("#define A (b + c)\nx = A;");
    TokenStream tokens = preprocess(source.source, {}, source.diagnostics);
    const Token& b = tokens.tokens[3];
    EXPECT_EQ(b.text, "b");
    EXPECT_EQ(b.where.begin, source.text.rfind('A'));
    EXPECT_EQ(b.spelling.begin, source.text.find('b'));
    EXPECT_EQ(tokens.macros[b.macro].name, "A");
}

TEST(Preprocess, ExplosionsAreCutOff) {
    std::string text = "#define A0 x x\n";
    for (int i = 1; i < 60; ++i) text += fmt::format("#define A{} A{} A{}\n", i, i - 1, i - 1);
    EXPECT_NE(expand(text + "A59").find("RSL_MACRO_TOO_LARGE"), std::string::npos);
    std::string nested = "#define F(x) x\n";
    for (int i = 0; i < 5000; ++i) nested += "F(";
    expand(nested);  // ends
}

class Includes : public testing::Test {
  protected:
    Includes() {
        std::filesystem::create_directories(folder_ / "sub");
        write("a.h", "#include \"sub/b.h\"\nfrom_a");
        write("sub/b.h", "#include \"c.h\"\nfrom_b");  // beside b.h; no newline at the end
        write("sub/c.h", "#pragma once\nfrom_c\n#define C 1\n");
        write("loop.h", "#include \"loop.h\"\n");
        options_.include_directories = {folder_.string()};
    }
    ~Includes() override { std::filesystem::remove_all(folder_); }
    void write(const char* name, const char* text) { std::ofstream(folder_ / name) << text; }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / fmt::format("kinora_include_test_{}", getpid());
    CompileOptions options_;
};

TEST_F(Includes, AreFoundBesideTheirFileAndInTheDirectories) {
    EXPECT_EQ(expand("#include <a.h>\nend", options_), "from_c from_b from_a end");
    EXPECT_EQ(expand("#define H \"sub/c.h\"\n#include H\n#include H\nC", options_), "from_c 1");
}

TEST_F(Includes, AFileThatIncludesItselfIsAnError) {
    EXPECT_NE(expand("#include \"loop.h\"", options_).find("RSL_INCLUDE_TOO_DEEP"),
              std::string::npos);
}

TEST_F(Includes, FindingsNameTheIncludedFile) {
    write("bad.h", "float f() {\n return 1 +; }\n");
    TestSource source("#include \"bad.h\"\nsurface x() { Ci = 1; }");
    options_.require_implemented = false;
    compile(source.source, options_, source.diagnostics);
    EXPECT_NE(source.messages().find("bad.h:2:12: error"), std::string::npos) << source.messages();
}

}  // namespace
}  // namespace kinora::rsl
