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
    EXPECT_TRUE(taken("0x10 == 16 && 0xFFu == 255 && 1ull == 1L"));
}

// C11 6.3.1.8: if one operand is unsigned, so is the other.
TEST(Preprocess, UnsignedNumbersMakeConditionsUnsigned) {
    const char* kTrue[] = {"-1 < 0",
                           "-1 > 0u",
                           "-1 / 2u > 0",
                           "(-1 >> 1) == -1",
                           "(-1u >> 1) > 0",
                           "(0 ? 0u : -1) > 0",
                           "~0u > 0",
                           "-5 % 3 == -2",
                           "0xFFFFFFFFFFFFFFFF == -1",
                           "18446744073709551615 > 0",
                           "(-1 && 1u) == 1",
                           "-9223372036854775807 - 1 < 0"};
    for (std::string condition : kTrue)
        EXPECT_EQ(expand("#if " + condition + "\nyes\n#else\nno\n#endif"), "yes") << condition;
    const char* kFalse[] = {"-1 < 0u", "-1 <= 1u", "(1 ? -1 : 0u) < 0", "-(1u) < 0", "!0u < 0"};
    for (std::string condition : kFalse)
        EXPECT_EQ(expand("#if " + condition + "\nyes\n#else\nno\n#endif"), "no") << condition;
}

TEST(Preprocess, ConditionsKnowCharacters) {
    const char* kTrue[] = {"'a' == 97",      "' ' == 32",    "'\\n' == 10",  "'\\'' == 39",
                           "'\"' == 34",     "'\\\"' == 34", "'\\\\' == 92", "'\\x41' == 'A'",
                           "'\\101' == 'A'", "'\\0' == 0",   "'\\a' == 7",   "LETTER == 'L'",
                           "'a' < 'b'"};
    for (std::string condition : kTrue)
        EXPECT_EQ(expand("#define LETTER 'L'\n#define a 3\n#if " + condition +
                         "\nyes\n#else\nno\n#endif"),
                  "yes")
            << condition;
    EXPECT_NE(expand("#if 'ab' == 1\n#endif").find("RSL_BAD_CONDITION"), std::string::npos);
    // Elsewhere quotes mean nothing, and macros apply between two of them.
    EXPECT_EQ(expand("#define a 3\n#if 0\ndon't 'a'\n#endif\nisn't a can't"), "isn ' t 3 can ' t");
    EXPECT_EQ(expand("#define S(x) #x\nS('\"' + '\\n')"), "\"'\\\"' + '\\\\n'\"");
}

TEST(Preprocess, MacrosMayAskWhatIsDefined) {
    const std::string macros =
        "#define FOO 7\n#define HAVE defined(FOO)\n#define HAVE_BAR (defined BAR)\n"
        "#define IS(x) (defined(x) && x > 5)\n";
    auto taken = [&](const std::string& condition) {
        return expand(macros + "#if " + condition + "\nyes\n#else\nno\n#endif");
    };
    EXPECT_EQ(taken("HAVE"), "yes");
    EXPECT_EQ(taken("HAVE_BAR"), "no");
    EXPECT_EQ(taken("HAVE && !HAVE_BAR && !defined BAR"), "yes");
    EXPECT_EQ(taken("defined(HAVE) && defined HAVE_BAR"), "yes");
    EXPECT_EQ(taken("IS(BAR)"), "no");
    EXPECT_EQ(expand("defined(FOO)"), "defined ( FOO )");
}

TEST(Preprocess, DefinedNeedsAName) {
    for (std::string condition : {"defined", "defined()", "defined(3) + 1", "1 && defined +"}) {
        TestSource source("#if " + condition + "\n#endif\n");
        preprocess(source.source, {}, source.diagnostics);
        EXPECT_EQ(source.diagnostics.findings().size(), 1u) << condition << source.messages();
    }
}

TEST(Preprocess, OptionsDefineMacrosWithParameters) {
    CompileOptions options;
    options.defines = {{"F(x)", "x*2"}, {"G(a, b)", "a-b"}, {"H (x)", "x"}, {"E()", ""}};
    EXPECT_EQ(expand("F(3) G(1, F(2)) F H E() ;", options), "3 * 2 1 - 2 * 2 F ( x ) x ;");
    for (const char* wrong : {"2x", "", "F(", "F(1)"}) {
        options.defines = {{wrong, "1"}};
        EXPECT_NE(expand("ok", options).find("RSL_BAD_DIRECTIVE"), std::string::npos) << wrong;
    }
}

// As functions of the source hide built-in ones.
TEST(Preprocess, AFunctionOfTheSourceHidesTheMacroOfACustomaryHeader) {
    auto behind_header = [](const std::string& text) {
        std::string all = expand("#include <patterns.h>\nSTART " + text);
        return all.substr(all.find("START ") + 6);
    };
    EXPECT_EQ(behind_header("sqr(2) float sqr(float x) { return x; } sqr(2)"),
              "( ( 2 ) * ( 2 ) ) float sqr ( float x ) { return x ; } sqr ( 2 )");
    // A typed call is none, and neither is a macro of the source's own.
    EXPECT_EQ(behind_header("if (float sqr(vector (s)) > 1) { }"),
              "if ( float ( ( vector ( s ) ) * ( vector ( s ) ) ) > 1 ) { }");
    EXPECT_EQ(expand("#define each(i) for (i = 0; i < 3; i += 1)\neach(k) { }"),
              "for ( k = 0 ; k < 3 ; k += 1 ) { }");
    for (const char* text :
         {"#include \"patterns.h\"\nfloat sqr(float x) { return x * x; }\nsurface a() { Ci = "
          "sqr(s); }",
          "#include \"noises.h\"\nfloat snoise(point p) { return 2 * noise(p) - 1; }\n"
          "surface a() { Ci = filteredsnoise(P, 0.5); }",
          "#include \"filterwidth.h\"\nfloat filterwidth(float x) { return max(abs(Du(x) * du), "
          "MINFILTWIDTH); }\nsurface a() { Ci = filterwidth(s); }",
          "#include \"util.h\"\nfloat bias(float a, b) { return pow(a, b); }\n"
          "surface a() { Ci = bias(s, t) + union(s, t); }"}) {
        TestSource source(text);
        EXPECT_FALSE(compile(source.source, {}, source.diagnostics).empty()) << source.messages();
        EXPECT_TRUE(source.diagnostics.findings().empty()) << source.messages();
    }
}

// The lines that `cpp` makes of the same text, for what people's macros do.
TEST(Preprocess, AgreesWithTheSystemsPreprocessor) {
    if (std::system("cpp --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no cpp";
    const char* kTexts[] = {
        "#define HAVE defined(FOO)\n#define FOO 3\n#if HAVE && FOO(1) == 3\n#else\nb\n#endif\n",
        "#define HAVE defined(FOO)\n#if HAVE\na\n#else\nb\n#endif\n",
        "#define HAVE defined FOO\n#define FOO bar\n#if HAVE\na FOO\n#else\nb\n#endif\n",
        "#if -1 < 0u\na\n#elif 'a' == 97 && '\\n' == 10\nc\n#endif\n",
        "#if (2 || 1 / 0) && -1 / 2u > 1 && (-1 >> 63) == -1 && 1 << 4 == 16\na\n#endif\n",
        "#define f(x) <x>\n#define g f\nf (1) g(2) f\n(3) f f(f(4))\n",
        "#define cat(a, b) a ## b\n#define xcat(a, b) cat(a, b)\n#define N 3\n"
        "xcat(v, N) cat(v, N) xcat(cat(1, 2), 3)\n",
        "#define s(x) #x\n#define xs(x) s(x)\n#define N 3 +  4\nxs(N) s(N) s( a  b )\n",
        "#define EMPTY\n#define D(x) EMPTY x EMPTY\n-D(-1) D() D(D(2))\n",
    };
    std::string folder = ::testing::TempDir();
    for (std::string text : kTexts) {
        std::ofstream(folder + "/in.h") << text;
        std::string command = "cpp -P -w " + folder + "/in.h > " + folder + "/out.h 2>/dev/null";
        bool accepted = std::system(command.c_str()) == 0;
        std::ifstream out(folder + "/out.h");
        std::string theirs(std::istreambuf_iterator<char>(out), {});
        std::string ours = expand(text);
        if (!accepted)
            EXPECT_NE(ours.find("error"), std::string::npos) << text;
        else
            EXPECT_EQ(ours, expand(theirs)) << text;  // token by token
    }
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
