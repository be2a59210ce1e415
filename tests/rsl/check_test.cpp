// tests/rsl/check_test.cpp: each file below tests/rsl/files gives exactly the findings it says, and
// the facts of shaders that compile.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "rsl/builtins/table.h"
#include "rsl/lint/lint.h"
#include "tests/rsl/source_text.h"

namespace kinora::rsl {
namespace {

namespace fs = std::filesystem;

// "//! 12:5 error RSL_CODE text": the text stands in the message or the help. A file whose end is
// broken on purpose has them in a .expect beside it.
struct Expected {
    std::string position, severity, code, text;
};
std::vector<Expected> expected_findings(const fs::path& path) {
    fs::path beside = path;
    beside.replace_extension(".expect");
    std::istringstream lines(read_file(fs::exists(beside) ? beside : path));
    std::vector<Expected> all;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("//! ")) continue;
        std::istringstream words(line.substr(4));
        Expected e;
        words >> e.position >> e.severity >> e.code >> std::ws;
        std::getline(words, e.text);
        all.push_back(e);
    }
    return all;
}

// Exactly these, in this order.
void expect_findings(const TestSource& source, const std::vector<Expected>& expected) {
    const auto& findings = source.diagnostics.findings();
    EXPECT_EQ(findings.size(), expected.size()) << source.messages();
    if (findings.size() != expected.size()) return;
    for (size_t i = 0; i < findings.size(); ++i) {
        LineColumn at =
            source.diagnostics.files.line_column(findings[i].where.file, findings[i].where.begin);
        EXPECT_EQ(fmt::format("{}:{}", at.line, at.column), expected[i].position);
        EXPECT_EQ(severity_name(findings[i].severity), expected[i].severity);
        EXPECT_EQ(findings[i].info->code, expected[i].code);
        std::string said = findings[i].message + "\n" + findings[i].help;
        EXPECT_NE(said.find(expected[i].text), std::string::npos) << said;
    }
}

// Compiles every .sl below the folder; the number of them.
int check_folder(const char* folder) {
    int files = 0;
    for (const fs::path& path : shader_files(folder)) {
        SCOPED_TRACE(path.string());
        ++files;
        TestSource source(read_file(path));
        auto shaders = compile(source.source, front_end_only(), source.diagnostics);
        expect_findings(source, expected_findings(path));
        EXPECT_EQ(shaders.empty(), source.diagnostics.has_errors());
    }
    return files;
}

TEST(CheckFiles, GiveExactlyTheFindingsTheyExpect) {
    EXPECT_GE(check_folder("tests/rsl/files"), 86);
}

// What people get wrong: each program with what must be said of it, and nothing else.
TEST(WrongPrograms, GiveExactlyTheFindingsTheyExpect) {
    EXPECT_GE(check_folder("tests/rsl/wrong"), 304);
}

// What compiles and is most likely a slip.
TEST(Lint, GivesExactlyTheWarningsThatFilesExpect) {
    int files = 0;
    for (const fs::path& path : shader_files("tests/rsl/lint")) {
        SCOPED_TRACE(path.string());
        ++files;
        TestSource source(read_file(path));
        auto shaders = compile(source.source, front_end_only(), source.diagnostics);
        ASSERT_FALSE(shaders.empty()) << source.messages();
        source.diagnostics.clear();
        lint(shaders, {source.source.map.file, {path.parent_path().string()}}, source.diagnostics);
        source.diagnostics.sort_unique();
        expect_findings(source, expected_findings(path));
    }
    EXPECT_GE(files, 5);
}

TEST(Lint, NamesOfWarningsLeadBackToThem) {
    for (const std::string& name : warning_names()) {
        const FindingInfo* info = find_warning(name);
        ASSERT_NE(info, nullptr) << name;
        EXPECT_EQ(warning_name(*info), name);
        EXPECT_EQ(info->severity, Severity::Warning);
    }
    ASSERT_NE(find_warning("unused-variable"), nullptr);
    EXPECT_STREQ(find_warning("unused-variable")->code, "RSL_UNUSED_VARIABLE");
    EXPECT_EQ(find_warning("syntax"), nullptr);  // an error
}

std::vector<std::unique_ptr<Shader>> compiled(TestSource& source) {
    auto shaders = compile(source.source, front_end_only(), source.diagnostics);
    EXPECT_FALSE(shaders.empty()) << source.messages();
    return shaders;
}

TEST(Check, ReportsPlacesInTheFileThatHoldsTheText) {
    // The text as an XML reader hands it over: "<code>" is 6 bytes, "&lt;" became "<".
    std::string file = "<code>surface x() {\n if (s &lt; bad) Ci = 1; }</code>";
    std::string text = "surface x() {\n if (s < bad) Ci = 1; }";
    Diagnostics diagnostics;
    ShaderSource source{text, {}};
    source.map.file = diagnostics.files.add("scene.dae", file);
    uint32_t less = uint32_t(text.find('<'));
    source.map.segments = {{0, 6}, {less + 1, less + 1 + 6 + 3}};
    compile(source, front_end_only(), diagnostics);
    ASSERT_EQ(diagnostics.findings().size(), 1u);
    EXPECT_EQ(diagnostics.findings()[0].where.begin, file.find("bad"));
}

// RenderMan Interface 3.2 has only float forms of these: what noise() gives inside them follows
// from what is wanted of the whole, however deep it stands.
TEST(Check, TheTypeWantedReachesThroughNestedCalls) {
    const char* kInner[] = {"noise(P)", "cellnoise(P)", "pnoise(P, point 2)", "trace(P, N)",
                            "(2 * noise(P) - 1)"};
    const char* kOuter[] = {"abs(%s)",      "pow(%s, 2)", "clamp(%s, 0, 1)", "mix(.2, .8, %s)",
                            "max(0, %s)",   "min(1, %s)", "mod(%s, 1)",      "smoothstep(0, 1, %s)",
                            "step(.5, %s)", "floor(%s)",  "sqrt(%s)"};
    auto inside = [](std::string_view outer, const std::string& inner) {
        size_t at = outer.find("%s");
        return std::string(outer.substr(0, at)) + inner + std::string(outer.substr(at + 2));
    };
    for (const char* inner : kInner)
        for (const char* middle : kOuter)
            for (const char* outer : kOuter) {
                std::string x = inside(outer, inside(middle, inner));
                TestSource source("surface x(string map = \"\";) { float f = " + x +
                                  ", g[2]; f += " + x + "; g[0] = " + x + "; if (" + x +
                                  " > .5) Ci = " + x + "; Ci += color(" + x + ", 0, log(" + x +
                                  ")) + texture(map, " + x + ", 0, \"blur\", " + x + ") + spline(" +
                                  x + ", color 0, color 1, color 0, color 1); color c = " + x +
                                  "; }");
                EXPECT_EQ(compiled(source).size(), 1u) << x;
                EXPECT_TRUE(source.diagnostics.findings().empty()) << x;
            }
}

TEST(Check, DefaultsFoldWhereNothingRuns) {
    TestSource source(
        "surface x(float a = 1 + 2 * 3, b = -PI; color c = 0.5, d = color(1, 2, 3) / 2;"
        "point p = point \"shader\" (1, 2, 3); string s[3] = {\"a\", \"b\"}; float e = radians(1);"
        "float none; matrix m = 2; color hsv = color \"hsv\" (1 / 3.0, 1, 1);"
        "string t = concat(\"a\", \".tx\"); float big = 2 > 1 ? max(3, 4) : 0, zero = 1 / 0,"
        "place = xcomp(transform(\"world\", point 1)), time_of = time)"
        "{ Ci = a; }");
    auto shaders = compiled(source);
    const auto& p = shaders[0]->parameters;
    EXPECT_EQ(p[0].constant->numbers, std::vector<float>({7}));
    EXPECT_EQ(p[1].constant->numbers, std::vector<float>({-3.14159265f}));
    EXPECT_EQ(p[2].constant->numbers, std::vector<float>({0.5f, 0.5f, 0.5f}));
    EXPECT_EQ(p[3].constant->numbers, std::vector<float>({0.5f, 1, 1.5f}));
    EXPECT_EQ(p[4].constant->numbers, std::vector<float>({1, 2, 3}));
    EXPECT_TRUE(p[4].constant->in_shader_space);
    EXPECT_EQ(p[5].constant->strings, std::vector<std::string>({"a", "b", ""}));
    EXPECT_FLOAT_EQ(p[6].constant->numbers.at(0), 0.01745329252f);
    EXPECT_EQ(p[7].constant->numbers, std::vector<float>({0}));
    EXPECT_EQ(p[8].constant->numbers[5], 2);
    EXPECT_EQ(p[8].constant->numbers[1], 0);
    ASSERT_EQ(p[9].constant->numbers.size(), 3u);
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(p[9].constant->numbers[k], k == 1 ? 1 : 0, 1e-6) << k;  // green
    EXPECT_EQ(p[10].constant->strings, std::vector<std::string>({"a.tx"}));
    EXPECT_EQ(p[11].constant->numbers, std::vector<float>({4}));
    EXPECT_EQ(p[12].constant->numbers, std::vector<float>({0}));  // docs/numerics.md#division
    EXPECT_FALSE(p[13].constant);                                 // spaces are the renderer's
    EXPECT_FALSE(p[14].constant);
}

TEST(Check, SpatialDefaultsThatAreWrittenOutAreInShaderSpace) {
    TestSource source(
        "light x(point a = 0, b = (1, 2, 3), c = -(1, 0, 0); vector d = 1;"
        "point e[2] = {0, (1, 2, 3)}; point f = point \"world\" 1, g = (1, 0, 0) + 1; color h = 0;)"
        "{ illuminate(a) Cl = 1; }");
    auto shaders = compiled(source);
    const auto& p = shaders[0]->parameters;
    for (size_t i : {0, 1, 2, 3, 4}) EXPECT_TRUE(p[i].constant->in_shader_space) << p[i].name;
    EXPECT_EQ(p[2].constant->numbers, std::vector<float>({-1, 0, 0}));
    EXPECT_EQ(p[4].constant->numbers, std::vector<float>({0, 0, 0, 1, 2, 3}));
    EXPECT_FALSE(p[5].constant);
    EXPECT_FALSE(p[6].constant->in_shader_space);
    EXPECT_FALSE(p[7].constant->in_shader_space);
}

TEST(Check, ListsTheGlobalsReadAndWritten) {
    TestSource source(
        "float f() { return t; }\n"
        "surface x() { vector n = faceforward(N, I); Ci += f() * Cs; Oi[0] = n[0]; }");
    auto shaders = compiled(source);
    auto names = [](const auto& list) {
        std::string text;
        for (const GlobalInfo* g : list) text += std::string(g->name) + " ";
        return text;
    };
    EXPECT_EQ(names(shaders[0]->globals_read), "Cs N Ng t I Ci Oi ");
    EXPECT_EQ(names(shaders[0]->globals_written), "Ci Oi ");
    ASSERT_EQ(shaders[0]->functions.size(), 1u);
    EXPECT_EQ(shaders[0]->functions[0]->name, "f");
}

// The type that noise() gets in each place.
TEST(Check, TheWantedTypeChoosesTheOverload) {
    struct Row {
        const char* statement;
        const char* call;
    };
    for (const Row& row :
         {Row{"float a = noise(P);", "float noise"}, Row{"color a = noise(P);", "color noise"},
          Row{"point a = noise(P);", "point noise"}, Row{"color a = noise(P) * 2;", "color noise"},
          Row{"vector a = N * noise(P);", "float noise"},
          Row{"point a = P + noise(P);", "point noise"},
          Row{"float a = abs(.5 - noise(P));", "float noise"},
          Row{"color a = mix(Cs, Os, noise(P));", "float noise"},
          Row{"float a = xcomp(point noise(P));", "point noise"},
          Row{"float a = N . noise(P);", "normal noise"},
          Row{"if (noise(P) > 0.5) Ci = 1;", "float noise"}}) {
        TestSource source(fmt::format("surface x() {{ {} }}", row.statement));
        auto shaders = compiled(source);
        std::string types = print_types(*shaders[0]->ast);
        size_t at = types.find("noise(P");
        size_t brace = types.find("){", at);
        std::string_view type = std::string_view(types).substr(brace + 2);
        EXPECT_EQ(std::string(type.substr(0, type.find(' '))) + " noise", row.call)
            << row.statement;
    }
}

TEST(Check, RatesFollowWhatValuesDependOn) {
    TestSource source(
        "float pass(float a) { return a; }\n"
        "surface x(float k = 1) {\n"
        "  float uni = k * 2, vary = s, ctl = 1, loop = 0, fu = pass(k), fv = pass(s);\n"
        "  if (s > 0.5) ctl = 2;\n"
        "  float i; for (i = 0; i < 4; i += 1) { loop += 1; if (t > i) break; }\n"
        "  Ci = uni + vary + ctl + loop + fu + fv; }");
    auto shaders = compiled(source);
    std::string types = print_types(*shaders[0]->ast);
    EXPECT_NE(types.find("uni = k{float uniform} * 2{float uniform}{uniform"), std::string::npos);
    for (const char* name : {"vary", "ctl", "loop", "fv"}) {
        for (Stmt* stmt : shaders[0]->definition->body->body)
            if (const auto* d = as_if<DeclareStmt>(stmt))
                for (const Symbol* symbol : d->symbols) {
                    bool uniform = symbol->name == "uni" || symbol->name == "fu";
                    EXPECT_FALSE(uniform && symbol->varying) << symbol->name;
                    EXPECT_TRUE(symbol->name != name || symbol->varying) << name;
                }
    }
}

TEST(Check, EverySignatureIsWellFormed) {
    for (auto group : builtin_groups())
        for (const Builtin& row : group) {
            auto signatures = parse_signatures(row.signature);
            EXPECT_FALSE(signatures.empty()) << row.name;
            EXPECT_FALSE(std::string_view(row.doc).empty()) << row.name;
        }
    EXPECT_EQ(find_builtin("mix").size(), 10u);
    EXPECT_TRUE(find_builtin("dot").empty());
    EXPECT_EQ(foreign_builtin("urandom"), "Pixie");
}

}  // namespace
}  // namespace kinora::rsl
