// tests/rsl/objects/co_shaders_test.cpp: co-shaders, on every target and by the reference. Expected
// numbers are arithmetic by hand.
#include <gtest/gtest.h>

#include <functional>

#include "jit/target.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

constexpr int kLinkedPoints = 21;

struct CoShader {
    std::string handle, source;
    LinkTexts texts = {};
    std::string shader = {};
};

std::vector<LinkedSource> sources_of(const std::vector<CoShader>& shaders) {
    std::vector<LinkedSource> sources;
    for (const CoShader& one : shaders)
        sources.push_back({one.handle, {one.source, {}}, one.shader, one.texts});
    return sources;
}

std::string findings_of(const std::vector<CoShader>& shaders) {
    return RunShader(sources_of(shaders)).findings();
}

// An output where s = 0, 1, 2, ... and t = s mod 3: the same bits on each target, and what the
// reference gives.
std::vector<float> linked_values(const std::vector<CoShader>& shaders,
                                 const std::string& output = "Ci.r") {
    std::vector<float> first;
    Columns columns;
    for (int i = 0; i < kLinkedPoints; ++i) {
        columns["s"].push_back(float(i));
        columns["t"].push_back(float(i % 3));
        for (const char* name : {"Os.r", "Os.g", "Os.b"}) columns[name].push_back(1);
    }
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader run(sources_of(shaders), {}, {}, target.name);
        EXPECT_TRUE(run.ok()) << run.findings();
        if (!run.ok()) return std::vector<float>(kLinkedPoints, std::nanf(""));
        run.inputs = columns;
        std::vector<float> got = run.run(kLinkedPoints)[output];
        if (first.empty()) first = got;
        Layer layer{run.shaders.back().get(), {}};
        for (size_t i = 0; i < kLinkedPoints; ++i) {
            EXPECT_EQ(std::bit_cast<int32_t>(got[i]), std::bit_cast<int32_t>(first[i]))
                << target.name << " at " << i;
            auto reference = run_reference<float>({&layer, 1}, at_point(columns, {"rng"}, i));
            EXPECT_NEAR(got[i], reference.values.at(output), 1e-5 * std::fabs(got[i]) + 1e-6)
                << target.name << " at " << i;
        }
    }
    return first;
}

void expect_values(const std::vector<CoShader>& shaders, const std::function<float(float)>& of_s,
                   const std::string& output = "Ci.r") {
    std::vector<float> got = linked_values(shaders, output);
    for (size_t i = 0; i < kLinkedPoints; ++i) EXPECT_FLOAT_EQ(got[i], of_s(float(i))) << i;
}

const CoShader kRed{"red",
                    "float twice(float x) { return 2 * x; }\n"
                    "class pattern(float weight = 1; string __category = \"pattern, base\";) {\n"
                    "public float seen = 5; float member = 3;\n"
                    "public float value(float x) { return twice(x) * weight + member; }\n"
                    "public void tint(output color c) { c = color(value(s), 0, 0); }\n"
                    "public float only() { return 11; } }"};
const CoShader kGreen{"green",
                      "class pattern(float weight = 10; string __category = \"pattern\";) {\n"
                      "public float seen = 6;\n"
                      "public float value(float x) { return x * weight; } }"};
const CoShader kBlue{"blue",
                     "float twice(float x) { return 100 + x; }\n"
                     "class other(string __category = \"dirt\";) {\n"
                     "public float value(float x) { return twice(x); } }"};

// ---- one shader -------------------------------------------------------------------------------

TEST(CoShaders, AreCalledByTheirHandle) {
    expect_values({{"",
                    "surface a() { shader r = getshader(\"red\"); color c = 0; r->tint(c);"
                    "Ci = c + r->value(1); }"},
                   kRed},
                  [](float s) { return (2 * s + 3) + (2 + 3); });
}

TEST(CoShaders, HaveTheirOwnParametersMembersAndFunctions) {
    expect_values({{"",
                    "float twice(float x) { return 3000 * x; }\n"
                    "class a(float weight = 7;) { float member = 1000; public void surface(output "
                    "color Ci, Oi) { shader r = getshader(\"red\"), b = getshader(\"blue\");"
                    "Ci = r->value(s) + b->value(s) + weight + member + twice(1); } }"},
                   kRed,
                   kBlue},
                  [](float s) { return (2 * s + 3) + (100 + s) + 7 + 1000 + 3000; });
}

TEST(CoShaders, AreGivenByParametersOfTheTypeShader) {
    for (const char* handle : {"green", "", "nobody"})
        expect_values({{"",
                        "class a(shader base = null;) { public void surface(output color Ci, Oi) {"
                        "Ci = 1; if (base != null) Ci = base->value(s); } }",
                        {{"base", {handle}}}},
                       kGreen},
                      [&](float s) { return std::string(handle) == "green" ? 10 * s : 1; });
}

TEST(CoShaders, AreFoundByStringParameters) {
    const char* source =
        "class a(string pick = \"green\";) { shader m; public void construct() {"
        "m = getshader(pick); } public void surface(output color Ci, Oi) { Ci = m->value(s); } }";
    expect_values({{"", source}, kGreen, kRed}, [](float s) { return 10 * s; });
    expect_values({{"", source, {{"pick", {"green"}}}}, kGreen}, [](float s) { return 10 * s; });
}

TEST(CoShaders, MayCallFromFunctionsOfTheFile) {
    expect_values({{"",
                    "float of(shader x; float y) { return x->value(y); }\n"
                    "float outer(shader x) { return of(x, s) + 1; }\n"
                    "surface a() { Ci = outer(getshader(\"green\")); }"},
                   kGreen},
                  [](float s) { return 10 * s + 1; });
}

// Each layer is the same source, bound to another shader below.
TEST(CoShaders, AreLayered) {
    std::string layer =
        "class layer(shader below = null; float gain = 2;) { public float value(float x) {"
        "float b = 0; if (below != null) b = below->value(x); return b * gain + 1; } }";
    expect_values({{"", "surface a() { shader top = getshader(\"c\"); Ci = top->value(s); }"},
                   {"c", layer, {{"below", {"b"}}}},
                   {"b", layer, {{"below", {"a"}}}},
                   {"a", layer}},
                  [](float) { return ((0 * 2 + 1) * 2 + 1) * 2 + 1; });
}

TEST(CoShaders, ThatCallEachOtherInACircleAreAnError) {
    std::string layer =
        "class layer(shader below = null;) { public float value(float x) {"
        "return below->value(x); } }";
    std::string text =
        findings_of({{"", "surface a() { shader top = getshader(\"x\"); Ci = top->value(s); }"},
                     {"x", layer, {{"below", {"y"}}}},
                     {"y", layer, {{"below", {"x"}}}}});
    EXPECT_NE(text.find("RSL_CO_SHADER_CYCLE"), std::string::npos) << text;
    EXPECT_NE(text.find("x->value(), y->value(), x->value()"), std::string::npos) << text;
}

TEST(CoShaders, BeginBeforeTheShaderAndKeepWhatTheyWrote) {
    const char* counter =
        "class counter() { float n = 0; public void construct() { n = 10; }"
        "public void begin() { n += s; } public float next() { n += 1; return n; } }";
    expect_values({{"",
                    "class a() { shader c = getshader(\"n\"); float first;"
                    "public void begin() { first = c->next(); }"
                    "public void surface(output color Ci, Oi) { float x = c->next();"
                    "Ci = first * 1000 + x; } }"},
                   {"n", counter}},
                  [](float s) { return (11 + s) * 1000 + 12 + s; });
}

TEST(CoShaders, OfTheFirstLanguageAreCalledAsSurfaceOrReadAfterTheyRan) {
    expect_values({{"",
                    "surface a() { shader m = getshader(\"m\"), p = getshader(\"p\"); color c, o;"
                    "m->surface(c, o); float x = p->result; Ci = c + o * 100 + x * 10000; }"},
                   {"m", "surface m(float Kd = 3;) { Ci = s * Kd; Oi = 2; }"},
                   {"p", "shader p(output float result = 0;) { result = s + 4; }"}},
                  [](float s) { return s * 3 + 200 + (s + 4) * 10000; });
}

TEST(CoShaders, TakeAndGiveStructs) {
    std::string header = "struct Both { float a = 1; color c = 2; }\n";
    expect_values(
        {{"", header + "surface a() { Both b, d; b->a = s; shader x = getshader(\"x\");"
                       "x->fill(b); d = x->made(4); Ci = b->a + b->c + d->a; }"},
         {"x", header + "class x() { public void fill(output Both v) { v->a += 1; v->c = 20; }"
                        "public Both made(float q) { Both m; m->a = q * 100; return m; } }"}},
        [](float s) { return s + 1 + 20 + 400; });
}

// ---- one of several ---------------------------------------------------------------------------

const char* kThree =
    "surface a() { shader m = null; if (t == 0) m = getshader(\"red\");"
    "else if (t == 1) m = getshader(\"green\"); else m = getshader(\"blue\");";

float of_three(float s) {
    int t = int(s) % 3;
    return t == 0 ? 2 * s + 3 : t == 1 ? 10 * s : 100 + s;
}

TEST(CoShaders, DifferFromPointToPoint) {
    expect_values({{"", std::string(kThree) + "Ci = m->value(s); }"}, kRed, kGreen, kBlue},
                  of_three);
}

// Where the shader has no such method, and where there is none, the result is 0 and an output
// argument stays.
TEST(CoShaders, ThatLackAMethodDoNothing) {
    expect_values({{"", std::string(kThree) + "color c = 50; m->tint(c); Ci = c + m->only(); }"},
                   kRed,
                   kGreen,
                   kBlue},
                  [](float s) { return int(s) % 3 == 0 ? 2 * s + 3 + 11 : 50; });
    expect_values({{"",
                    "surface a() { shader m = null; if (t == 0) m = getshader(\"red\");"
                    "color c = 50; m->tint(c); Ci = c; }"},
                   kRed},
                  [](float s) { return int(s) % 3 == 0 ? 2 * s + 3 : 50; });
}

TEST(CoShaders, ArePassedToMethodsOfOthers) {
    expect_values(
        {{"", std::string(kThree) + "shader c = getshader(\"c\"); Ci = c->of(m, s); }"},
         kRed,
         kGreen,
         kBlue,
         {"c", "class c() { public float of(shader x; float y) { return x->value(y) + 1; } }"}},
        [](float s) { return of_three(s) + 1; });
}

TEST(CoShaders, AreComparedWithOthers) {
    expect_values(
        {{"", std::string(kThree) + "shader g = getshader(\"green\"); Ci = 0; if (m == g) Ci = 1;"
                                    "if (m != null && g != m) Ci = 2; }"},
         kRed,
         kGreen,
         kBlue},
        [](float s) { return int(s) % 3 == 1 ? 1 : 2; });
}

TEST(CoShaders, SayWhetherTheyHaveAMethod) {
    expect_values(
        {{"", std::string(kThree) + "shader r = getshader(\"red\");"
                                    "Ci = hasmethod(m, \"only\") + 10 * hasmethod(r, \"only\")"
                                    " + 100 * hasmethod(r, \"none\"); }"},
         kRed,
         kGreen,
         kBlue},
        [](float s) { return float(int(s) % 3 == 0) + 10; });
}

TEST(CoShaders, ShowTheirParametersAndPublicMembers) {
    expect_values({{"", std::string(kThree) + "shader r = getshader(\"red\");"
                                              "Ci = m->seen + 10 * r->weight; }"},
                   kRed,
                   kGreen,
                   kBlue},
                  [](float s) {
                      int t = int(s) % 3;
                      return (t == 0 ? 5.0f : t == 1 ? 6.0f : 0.0f) + 10;
                  });
}

TEST(CoShaders, GiveVariablesByName) {
    expect_values({{"", std::string(kThree) +
                            "float x = 77, y = 5, n = getvar(m, \"seen\", x);"
                            "n += 10 * getvar(m, \"member\", y); Ci = n * 100000 + x * 100 + y; }"},
                   kRed,
                   kGreen,
                   kBlue},
                  [](float s) {
                      int t = int(s) % 3;
                      float seen = t == 0 ? 5 : t == 1 ? 6 : 77;
                      return float(t < 2) * 100000 + seen * 100 + 5;
                  });
}

// ---- lists ------------------------------------------------------------------------------------

TEST(CoShaders, AreListedByCategory) {
    auto sum = [](const std::string& list) {
        return "surface a() { shader all[] = " + list +
               "; float k, sum = 0; for (k = 0; k < arraylength(all); k += 1)"
               "sum += all[k]->value(s); Ci = sum + arraylength(all) * 1000; }";
    };
    auto expect_list = [&](const char* query, int count, const std::function<float(float)>& of_s) {
        SCOPED_TRACE(query);
        expect_values({{"", sum(query)}, kRed, kGreen, kBlue},
                      [&](float s) { return of_s(s) + float(count) * 1000; });
    };
    expect_list("getshaders()", 3, [](float s) { return 2 * s + 3 + 10 * s + 100 + s; });
    expect_list("getshaders(\"category\", \"pattern\")", 2,
                [](float s) { return 2 * s + 3 + 10 * s; });
    expect_list("getshaders(\"category\", \"-pattern\")", 1, [](float s) { return 100 + s; });
    expect_list("getshaders(\"category\", \"pattern&-base\")", 1, [](float s) { return 10 * s; });
    expect_list("getshaders(\"category\", \"none\")", 0, [](float) { return 0.0f; });
}

TEST(CoShaders, InArraysOfNoneOneAndSeventeen) {
    for (int count : {0, 1, 17}) {
        std::string handles;
        std::vector<CoShader> shaders{{}};
        for (int k = 0; k < count; ++k) {
            std::string handle = "h" + std::to_string(k);
            handles += (k ? "," : "") + handle;
            shaders.push_back({handle, "class c" + std::to_string(k) +
                                           "() { public float value(float x) { return x * " +
                                           std::to_string(k + 1) + "; } }"});
        }
        shaders[0] = {"",
                      "class a(shader layers[] = {};) { public void surface(output color Ci, Oi) {"
                      "float k, sum = 0; for (k = 0; k < arraylength(layers); k += 1)"
                      "sum += layers[k]->value(s); float n = arraylength(layers);"
                      "if (n > 0) sum += 1000 * layers[mod(s, n)]->value(1); Ci = sum; } }",
                      {{"layers", {handles}}}};
        expect_values(shaders, [&](float s) {
            float chosen = count ? float(int(s) % count + 1) : 0;
            return s * float(count * (count + 1) / 2) + 1000 * chosen;
        });
    }
}

TEST(CoShaders, AreKeptInStructsAndArraysThatGrow) {
    expect_values({{"",
                    "struct Layer { shader what = null; float weight = 1;"
                    "float value(float x) { return what->value(x) * weight; } }\n"
                    "surface a() { shader list[]; push(list, getshader(\"green\"));"
                    "push(list, getshader(\"blue\")); Layer l; l->what = list[1]; l->weight = 3;"
                    "shader again[]; again = getshaders(\"category\", \"base\");"
                    "Ci = l->value(s) + list[0]->value(s) + again[0]->value(s); }"},
                   kRed,
                   kGreen,
                   kBlue},
                  [](float s) { return (100 + s) * 3 + 10 * s + 2 * s + 3; });
}

// ---- what is left of them ---------------------------------------------------------------------

TEST(CoShaders, GiveTheShaderTheirParameters) {
    RunShader run(sources_of(
        {{"", "surface a() { shader r = getshader(\"red\"); Ci = r->only(); }"}, kRed, kBlue}));
    ASSERT_TRUE(run.ok()) << run.findings();
    std::string names;
    for (const ShaderParameter& p : run.shaders[0]->parameters) names += std::string(p.name) + " ";
    EXPECT_EQ(names, "red.weight red.__category ");  // blue is not called
}

// A variable that can be one shader alone costs nothing: the code is that of a direct call.
TEST(CoShaders, LeaveNoChoiceWhereThereIsNone) {
    std::vector<CoShader> linked{
        {"",
         "class a(shader m = null;) { public void surface(output color Ci, Oi) {"
         "Ci = 0; if (m != null) Ci = m->value(s); Oi = 1; } }",
         {{"m", {"green"}}}},
        kGreen};
    std::vector<CoShader> plain{
        {"", "class a() { public void surface(output color Ci, Oi) { Ci = s * 10; Oi = 1; } }"}};
    const char* target = jit::best_target().name;
    RunShader one(sources_of(linked), {}, {}, target), other(sources_of(plain), {}, {}, target);
    ASSERT_TRUE(one.ok() && other.ok()) << one.findings() << other.findings();
    EXPECT_EQ(one.kernels.point->code_bytes, other.kernels.point->code_bytes);
}

// A base, dirt, a coat, a pattern and a ramp, each a co-shader; and the same in one function.
const std::vector<CoShader> kFive{
    {"",
     "class layered(shader base = null; shader coat = null; string dirt = \"dirt\";) {\n"
     "shader m_dirt; public void construct() { m_dirt = getshader(dirt); }\n"
     "public void surface(output color Ci, Oi) { color c = 0; if (base != null) base->tint(c);\n"
     "if (m_dirt != null) m_dirt->cover(c); if (coat != null) coat->over(c); Ci = c; Oi = 1; } }",
     {{"base", {"clay"}}, {"coat", {"varnish"}}}},
    {"clay",
     "class clay(shader pattern = null; color tone = color(0.5, 0.25, 0.125);) {\n"
     "public void tint(output color c) { c = tone * (1 + pattern->value(s, t)); } }",
     {{"pattern", {"waves"}}}},
    {"waves",
     "class waves(float scale = 3; shader ramp = getshader(\"ramp\");) {\n"
     "public float value(float x, y) { return ramp->map(sin(x * scale) * cos(y * scale)); } }"},
    {"ramp",
     "class ramp(float gain = 2;) { public float map(float x) { return x * gain + noise(x); } }"},
    {"dirt",
     "class dirt(float amount = 0.25;) { public void cover(output color c) {\n"
     "float f = amount * noise(s, t); c = mix(c, color 0, f); } }"},
    {"varnish",
     "class varnish(float gloss = 8;) { float m_weight; public void begin() {\n"
     "m_weight = pow(abs(s - t) / (1 + s + t), gloss); }\n"
     "public void over(output color c) { c += m_weight; } }"}};

TEST(CoShaders, EachMethodShows) {
    std::vector<float> whole = linked_values(kFive);
    for (const char* method : {"tint(", "value(", "map(", "cover(", "over(", "begin("}) {
        std::vector<CoShader> without = kFive;
        for (size_t k = 1; k < without.size(); ++k) {
            std::string& text = without[k].source;
            for (const std::string type : {"public float ", "public void "})
                if (size_t at = text.find(type + method); at != text.npos)
                    text.insert(at + type.size(), "no_");
        }
        EXPECT_NE(linked_values(without), whole) << method;
    }
}

// As in an effect: the code of all is one, and each shader of it is chosen by its name.
TEST(CoShaders, MayStandInOneSource) {
    std::string all = "struct Unused { float a = 1; }\n";
    for (const CoShader& one : kFive) all += one.source + "\n";
    std::vector<CoShader> joined = kFive;
    for (CoShader& one : joined) {
        one.source = all;
        one.shader = one.handle.empty() ? "layered" : one.handle;
    }
    EXPECT_EQ(linked_values(joined), linked_values(kFive));
    RunShader run(all);
    EXPECT_TRUE(run.ok()) << run.findings();
    EXPECT_EQ(run.shaders.size(), kFive.size());
}

// Five co-shaders take no more code than the same written by hand, which gives the same bits.
TEST(CoShaders, CostNothing) {
    const CoShader by_hand{
        "",
        "surface by_hand(color tone = color(0.5, 0.25, 0.125); float scale = 3, gain = 2,"
        "amount = 0.25, gloss = 8;) {\n"
        "float weight = pow(abs(s - t) / (1 + s + t), gloss);\n"
        "float x = sin(s * scale) * cos(t * scale); float ramp = x * gain + noise(x);\n"
        "color c = tone * (1 + ramp); float f = amount * noise(s, t); c = mix(c, color 0, f);\n"
        "c += weight; Ci = c; Oi = 1; }"};
    EXPECT_EQ(linked_values(kFive, "Ci.g"), linked_values({by_hand}, "Ci.g"));
    const char* target = jit::best_target().name;
    RunShader one(sources_of(kFive), {}, {}, target), other(sources_of({by_hand}), {}, {}, target);
    ASSERT_TRUE(one.ok() && other.ok()) << one.findings() << other.findings();
    EXPECT_LE(double(one.kernels.point->code_bytes), 1.1 * double(other.kernels.point->code_bytes));
}

TEST(CoShaders, AreNumbersForNothing) {
    struct {
        const char* body;
        const char* code;
    } rows[] = {
        {"shader r = getshader(\"red\"); float x = r;", "RSL_HANDLE_AS_VALUE"},
        {"shader r = getshader(\"red\"); Ci = r + 1;", "RSL_HANDLE_AS_VALUE"},
        {"shader r = getshader(\"red\"); r = s;", "RSL_HANDLE_WANTED"},
        {"shader r = s;", "RSL_HANDLE_WANTED"},
        {"shader r = getshader(\"red\"); if (r == 2) Ci = 1;", "RSL_HANDLE_AS_VALUE"},
        {"shader r = getshader(\"red\"); Ci = sin(r);", "RSL_NO_OVERLOAD"},
        {"shader r = getshader(\"red\"); r->weight = 2;", "RSL_CO_SHADER_WRITE"},
        {"shader r = getshader(\"red\"); Ci = r->value(1, 2);", "RSL_ARGUMENT_COUNT"},
        {"shader r = getshader(\"red\"); Ci = r->member;", "RSL_CO_SHADER_MEMBER"},
        {"shader r = getshader(\"red\"); r->nothing();", "RSL_CO_SHADER_METHOD"},
    };
    for (const auto& row : rows) {
        std::string text =
            findings_of({{"", std::string("surface a() { ") + row.body + " }"}, kRed});
        EXPECT_NE(text.find(row.code), std::string::npos) << row.body << "\n" << text;
    }
}

}  // namespace
}  // namespace kinora::rsl
