// tests/rsl/objects/objects_test.cpp: resizable arrays, structs and classes of RSL 2.0, on every
// target, against the reference, and against the same shading written without them.
#include <gtest/gtest.h>

#include "jit/target.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

constexpr int kObjectPoints = 21;

Columns columns_of_s() {
    Columns columns;
    for (int i = 0; i < kObjectPoints; ++i) {
        columns["s"].push_back(float(i)), columns["dsdu"].push_back(1);
        columns["t"].push_back(float(i % 5) * 0.25f);
        columns["Os.r"].push_back(1), columns["Os.g"].push_back(1), columns["Os.b"].push_back(1);
        columns["rng"].push_back(std::bit_cast<float>(i * 77 + 5));
    }
    return columns;
}

// Values of an output at s = 0, 1, 2, ...: the same bits on each target, and close to the
// reference, which must find faults where they do.
std::vector<float> values_of(const std::string& source, const char* output = "Ci.r",
                             bool* faults = nullptr) {
    std::vector<float> first;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        LowerOptions options;
        options.want_N = options.want_P = true;
        RunShader run(source, options, {}, false, target.name);
        EXPECT_TRUE(run.ok()) << run.findings() << source;
        if (!run.ok()) return std::vector<float>(kObjectPoints, std::nanf(""));
        Columns columns = columns_of_s();
        run.inputs = columns;
        run.services[Service::query] = answer_zeros<Service::query>;  // a ray of the camera
        std::vector<float> got = run.run(kObjectPoints)[output];
        if (got.empty()) return std::vector<float>(kObjectPoints, std::nanf(""));
        if (first.empty()) first = got;
        if (faults) *faults = run.faults > 0;
        int reference_faults = 0;
        Layer layer{run.shaders.back().get(), {}};
        for (size_t i = 0; i < kObjectPoints; ++i) {
            EXPECT_EQ(std::bit_cast<int32_t>(got[i]), std::bit_cast<int32_t>(first[i]))
                << target.name << " at " << i << ": " << got[i] << ", " << first[i];
            auto reference = run_reference<float>({&layer, 1}, at_point(columns, {"rng"}, i));
            reference_faults += reference.faults;
            double expected = reference.values.at(output);
            EXPECT_NEAR(got[i], expected, 1e-5 * std::fabs(expected) + 1e-6)
                << target.name << " at " << i;
        }
        EXPECT_EQ(run.faults > 0, reference_faults > 0) << target.name;
    }
    return first;
}

void expect_same(const std::string& source, const std::string& plain) {
    std::vector<float> got = values_of(source), expected = values_of(plain);
    for (size_t i = 0; i < kObjectPoints; ++i) EXPECT_FLOAT_EQ(got[i], expected[i]) << i << source;
}

// ---- resizable arrays ---------------------------------------------------------------------------

TEST(ResizableArrays, HaveALengthOfTheirOwnAtEachPoint) {
    auto got = values_of(
        "surface t() { float a[], k; for (k = 1; k <= s; k += 1) push(a, k);"
        "float sum = 0; for (k = 0; k < arraylength(a); k += 1) sum += a[k];"
        "Ci = sum * 100 + arraylength(a); }");
    for (int n = 0; n < kObjectPoints; ++n)
        EXPECT_EQ(got[size_t(n)], float(n * (n + 1) / 2 * 100 + n)) << n;
}

TEST(ResizableArrays, FillNewElementsWithZero) {
    auto got = values_of(
        "surface t() { float a[] = {7, 8, 9}; resize(a, 1); resize(a, 2 + mod(s, 3));"
        "push(a, 5); Ci = a[0] * 100 + a[1] * 10 + a[arraylength(a) - 1]; }");
    for (float value : got) EXPECT_EQ(value, 705);
}

TEST(ResizableArrays, AreEmptyAgainInEachTurnOfALoop) {
    auto got = values_of(
        "surface t() { float k, most = 0; for (k = 0; k < s; k += 1) {"
        "float a[]; push(a, k); push(a, k); most = max(most, arraylength(a)); } Ci = most; }");
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], n > 0 ? 2 : 0) << n;
}

TEST(ResizableArrays, AreCopiedByValue) {
    auto got = values_of(
        "float changed(float v[]) { v[0] = 50; push(v, 1); return arraylength(v); }"
        "surface t() { float a[] = {1, 2}, b[]; b = a; push(b, s); b[0] = 10;"
        "Ci = a[0] + arraylength(a) * 100 + changed(a) * 1000 + arraylength(b) * 10000 + b[2]; }");
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], float(33201 + n)) << n;
}

TEST(ResizableArrays, AreChangedThroughOutputParameters) {
    auto got = values_of(
        "void more(output float v[]; float n) { float k; for (k = 0; k < n; k += 1) push(v, k); }"
        "surface t() { float a[]; more(a, 2); if (s > 9) more(a, 3);"
        "Ci = arraylength(a) * 10 + a[arraylength(a) - 1]; }");
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], n > 9 ? 52 : 21) << n;
}

// Sixteen arrays of matrices leave room for 127 elements of each; a number may ask for more. Beyond
// the room nothing is stored.
TEST(ResizableArrays, AreBoundedWithAFault) {
    bool faults = false;
    std::string others = "float n = 1;";
    for (int k = 0; k < 16; ++k) others += fmt::format(" matrix m{0}[]; resize(m{0}, n);", k);
    auto fill = [&](const char* reserve) {
        return "surface t() { float a[], k; " + others + reserve +
               " for (k = 0; k < 120 + s; k += 1) push(a, k);"
               " Ci = arraylength(a) + 1000 * a[arraylength(a) - 1]; }";
    };
    auto length = [](int n) { return float(n + 1000 * (n - 1)); };
    auto got = values_of(fill(""), "Ci.r", &faults);
    EXPECT_TRUE(faults);
    for (int n = 0; n < kObjectPoints; ++n)
        EXPECT_EQ(got[size_t(n)], length(std::min(120 + n, 127))) << n;
    got = values_of(fill("reserve(a, 500);"), "Ci.r", &faults);
    EXPECT_FALSE(faults);
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], length(120 + n)) << n;
    got = values_of("surface t() { float n = s * 5, a[n]; reserve(a, 9); Ci = arraylength(a); }",
                    "Ci.r", &faults);
    EXPECT_FALSE(faults);
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], 5 * n) << n;
    got = values_of("surface t() { float a[]; push(a, s); Ci = capacity(a); }", "Ci.r", &faults);
    EXPECT_EQ(got[0], 64);
}

// Many of them share 2 MiB for 16 points, and have room for 64 elements at least.
TEST(ResizableArrays, ShareTheirMemory) {
    auto room_of = [](int arrays, const char* type) {
        std::string text = "surface t(float n = 100;) { float k;";
        for (int a = 0; a < arrays; ++a)
            text += fmt::format(" {} a{}[]; resize(a{}, n);", type, a, a);
        return values_of(text + " Ci = capacity(a0); }", "Ci.r")[0];
    };
    EXPECT_EQ(room_of(1, "float"), 4096);
    EXPECT_EQ(room_of(8, "float"), (2 << 20) / (8 * 64));
    EXPECT_EQ(room_of(4, "color"), (2 << 20) / (4 * 3 * 64));
    EXPECT_EQ(room_of(1, "matrix"), (1 << 20) / (16 * 64));
    EXPECT_EQ(room_of(200, "color"), 64);
}

// f(f(..)) has two copies at once; the next call takes one of them again.
TEST(ResizableArrays, AreCopiedForEachCall) {
    auto got = values_of(
        "float f(float a[]; float x) { push(a, x); float k, sum = 0;"
        " for (k = 0; k < arraylength(a); k += 1) sum += a[k]; return sum; }"
        "surface t() { float a[]; push(a, s);"
        " Ci = f(a, f(a, 10)) + f(a, 100) + 1000 * arraylength(a); if (s > 3) Ci += f(a, 1); }",
        "Ci.r");
    for (int n = 0; n < kObjectPoints; ++n)
        EXPECT_EQ(got[size_t(n)], 1110 + 3 * n + (n > 3 ? n + 1 : 0)) << n;
}

TEST(ResizableArrays, ReportWhatLiesOutside) {
    bool faults = false;
    values_of("surface t() { float a[] = {1, 2}; resize(a, 2); Ci = a[mod(s, 3)]; }", "Ci.r",
              &faults);
    EXPECT_TRUE(faults);
    auto got =
        values_of("surface t() { float a[]; push(a, s); Ci = pop(a) + pop(a); }", "Ci.r", &faults);
    EXPECT_TRUE(faults);
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], float(n)) << n;
    values_of("surface t() { float a[]; resize(a, s - 1); Ci = arraylength(a); }", "Ci.r", &faults);
    EXPECT_TRUE(faults);
}

TEST(ResizableArrays, AreUniformWhereNothingVaries) {
    RunShader run(
        "surface t() { float a[]; push(a, s); uniform float n = arraylength(a); Ci = n; }");
    EXPECT_TRUE(run.ok()) << run.findings();
}

// ---- structs ------------------------------------------------------------------------------------

TEST(Structs, AreTheirMembers) {
    expect_same(
        "struct In { float w = 2; color c = color(1, 2, 3); }"
        "struct Out { In a; In b; float k = 5; }"
        "surface t() { Out x, y; x->a->w += s; y = x; y->b->c *= x->a->w; y->k = t;"
        "Ci = y->b->c + y->a->w * x->k + y->k; }",
        "surface t() { float w = 2 + s; Ci = color(1, 2, 3) * w + w * 5 + t; }");
}

TEST(Structs, HaveMethodsThatChangeThem) {
    expect_same(
        "struct Walk { float at = 1; float steps = 0;"
        "  void go(float by) { at += by; steps += 1; }"
        "  void twice(float by) { go(by); this->go(by * 2); }"
        "  float far() { if (at > 10) return at; return -at; } }"
        "surface t() { Walk w; w->go(s); if (t > 0.3) w->twice(t); Ci = w->far() + w->steps; }",
        "surface t() { float at = 1 + s, steps = 1; if (t > 0.3) { at += 3 * t; steps += 2; }"
        "Ci = (at > 10 ? at : -at) + steps; }");
}

TEST(Structs, ArePassedByReferenceAndReturned) {
    expect_same(
        "struct P2 { float x; float y; }"
        "P2 turned(P2 p) { P2 q; q->x = p->y; q->y = -p->x; return q; }"
        "void grow(P2 p; float k) { p->x *= k; p->y *= k; }"
        "surface t() { P2 p; p->x = s; p->y = t; p = turned(p); grow(p, 3); P2 q = turned(p);"
        "Ci = p->x * 100 + p->y * 10 + q->x; }",
        "surface t() { float x = 3 * t, y = -3 * s; Ci = x * 100 + y * 10 + y; }");
}

TEST(Structs, StandInArrays) {
    expect_same(
        "struct E { float w = 3; color c = 1; void add(float k) { w += k; } }"
        "surface t() { E a[3], list[]; float i; for (i = 0; i < 3; i += 1) a[i]->add(i * s);"
        "push(list, a[1]); push(list, a[2]); list[0]->add(100); list[0] = list[1];"
        "list[1]->c = color(s, t, 0); Ci = list[0]->w + list[1]->c[0] + arraylength(list) + "
        "a[0]->w; }",
        "surface t() { Ci = (3 + 2 * s) + s + 2 + 3; }");
}

// Where the array of all elements of all lists is: a[i]->k[j] is element 3 i + j.
TEST(Structs, HoldArraysInArrays) {
    expect_same(
        "struct E { float k[3] = {1, 2, 3}; float w = 7; color c[2]; }"
        "surface t() { E a[2], list[]; float i, sum = 0; a[1]->k[2] = s; a[0] = a[1];"
        "a[0]->k[0] += 10; a[0]->c[1] = color(t, 2, 3); push(list, a[1]); push(list, a[0]);"
        "for (i = 0; i < 3; i += 1) sum += a[0]->k[i] * pow(10, i);"
        "E one = list[1]; resize(list, 1);"
        "Ci = sum + 1000 * (list[0]->k[2] + one->c[1][0] + one->k[0]) + arraylength(list); }",
        "surface t() { Ci = 11 + 20 + 100 * s + 1000 * (s + t + 11) + 1; }");
}

TEST(Structs, ReportListsBeyondTheirLengths) {
    bool faults = false;
    values_of(
        "struct E { float k[2]; } surface t() { E a[2]; a[0]->k[1] = 5; a[1]->k[0] = 9;"
        "Ci = a[0]->k[mod(s, 3)]; }",
        "Ci.r", &faults);
    EXPECT_TRUE(faults);
}

TEST(Structs, LeaveNothingBehindInTheCode) {
    RunShader with(
        "struct V { float a = 1; float b = 2; float sum() { return a + b; } }"
        "surface t() { V v; v->a = s; Ci = v->sum() * t; Oi = 1; }");
    RunShader without(
        "float sum(float a; float b) { return a + b; }"
        "surface t() { float a = 1, b = 2; a = s; Ci = sum(a, b) * t; Oi = 1; }");
    ASSERT_TRUE(with.ok() && without.ok()) << with.findings() << without.findings();
    size_t sizes[2] = {};
    for (const jit::Function& f : with.lowered.module.functions) sizes[0] += f.insts.size();
    for (const jit::Function& f : without.lowered.module.functions) sizes[1] += f.insts.size();
    EXPECT_EQ(sizes[0], sizes[1]);
    EXPECT_TRUE(with.lowered.module.functions[0].arrays.empty());
}

TEST(Structs, MethodsThatNothingCallsAreNotChecked) {
    RunShader run(
        "struct V { float a = 1; void unused() { a = undeclared(nothing); } }"
        "float unused_too(V v) { return nowhere; }"
        "surface t() { V v; Ci = v->a; }");
    EXPECT_TRUE(run.ok()) << run.findings();
}

// Structs of structs, and calls in indices of arguments, multiply: hostile sources end soon.
TEST(Structs, AreBounded) {
    std::string text = "struct S0 { float a; float b; }";
    for (int k = 1; k < 40; ++k) text += fmt::format("struct S{0} {{ S{1} a; S{1} b; }}", k, k - 1);
    RunShader doubled(text + "surface t() { S39 x; Ci = 1; }");
    EXPECT_NE(doubled.findings().find("RSL_TOO_DEEP"), std::string::npos);
    std::string index = "0";
    for (int k = 0; k < 30; ++k) index = "f(a[" + index + "])";
    RunShader nested(
        "struct S { float a; float b; float c; float d; } float f(S s) { return s->a; }"
        "surface t() { S a[2]; Ci = " +
        index + "; }");
    EXPECT_NE(nested.findings().find("RSL_TOO_DEEP"), std::string::npos);
}

// ---- classes ------------------------------------------------------------------------------------

// Each method adds its digit: the order in which they run, and that none is left out.
std::string digits(const std::vector<std::string>& methods) {
    std::string text = "class t() { float order = 0; void add(float k) { order = order * 10 + k; }";
    int k = 0;
    for (const std::string& method : methods) {
        bool colors = method.find("ing") != std::string::npos || method == "surface";
        text += "public void " + method + (colors ? "(output color Ci, Oi)" : "()") + "{ add(" +
                std::to_string(++k) + ");" + (colors ? " Ci = order;" : "") + " }";
    }
    return text + "}";
}

TEST(Classes, RunTheirMethodsInOrder) {
    std::vector<std::string> all = {"construct",   "begin",    "displacement", "opacity",
                                    "prelighting", "lighting", "postlighting"};
    for (float value : values_of(digits(all))) EXPECT_EQ(value, 1234567);
    std::vector<std::string> pair = {"begin", "prelighting", "diffuselighting", "specularlighting",
                                     "postlighting"};
    for (float value : values_of(digits(pair))) EXPECT_EQ(value, 12345);
    for (float value : values_of(digits({"construct", "surface"}))) EXPECT_EQ(value, 12);
    // lighting() goes before the pair, and that before surface().
    for (float value : values_of(digits({"lighting", "diffuselighting", "surface"})))
        EXPECT_EQ(value, 1);
    // A surface() is whole, half of the pair is not.
    for (float value : values_of(digits({"diffuselighting", "surface"}))) EXPECT_EQ(value, 2);
}

TEST(Classes, WithoutOneOfTheirMethodsGiveAnotherPicture) {
    std::vector<std::string> all = {"construct",   "begin",    "displacement", "opacity",
                                    "prelighting", "lighting", "postlighting"};
    for (size_t k = 0; k < all.size(); ++k) {
        std::vector<std::string> rest = all;
        rest.erase(rest.begin() + long(k));
        for (float value : values_of(digits(rest))) EXPECT_NE(value, 1234567) << all[k];
    }
}

constexpr const char* kLeaf =
    "class t(float gain = 2;) { float seen = 0;"
    "  public void opacity(output color Oi) { seen = s > 4; Oi = seen * 0.5; }"
    "  public void surface(output color Ci, Oi) { Ci = gain * (s + seen) + 1; Oi = 1; } }";

TEST(Classes, SkipShadingWhereOpacityIsZero) {
    auto got = values_of(kLeaf);
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], n > 4 ? 2 * n + 3 : 0) << n;
    auto opacity = values_of(kLeaf, "Oi.r");
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(opacity[size_t(n)], n > 4 ? 1 : 0) << n;
}

// What construct() reads may change from frame to frame: it then runs again.
TEST(Classes, ConstructAgainWhenAParameterThatItReadsIsAnimated) {
    RunShader run(
        "class t(float gain = 2; float other = 1;) { constant float twice = 0; uniform float "
        "sums[];"
        " public void construct() { twice = 2 * gain; push(sums, twice + 1); }"
        " public void surface(output color Ci, Oi) { Ci = twice + 100 * sums[0] + other; } }",
        {}, {{"gain", ParamBinding::Kind::Frame, {}, {}}});
    ASSERT_TRUE(run.ok()) << run.findings();
    for (float gain : {3.0f, 5.0f, 3.0f}) {
        run.set("param:0:gain", gain);
        EXPECT_EQ(run.value("Ci.r"), 2 * gain + 100 * (2 * gain + 1) + 1);
    }
}

TEST(Classes, AskOpacityAloneForShadows) {
    LowerOptions options;
    options.want_Ci = false;
    RunShader run(kLeaf, options);
    ASSERT_TRUE(run.ok()) << run.findings();
    run.inputs = columns_of_s();
    auto got = run.run(kObjectPoints)["Oi.r"];
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], n > 4 ? 0.5f : 0) << n;
}

TEST(Classes, MayPromiseThatShadowsSeeOs) {
    LowerOptions options;
    options.want_Ci = false;
    std::string source = kLeaf;
    source.insert(source.find("float gain"), "float __computesOpacity = 0; ");
    RunShader run(source, options);
    ASSERT_TRUE(run.ok()) << run.findings();
    run.inputs = columns_of_s();
    EXPECT_EQ(run.value("Oi.r"), 1);
}

// What sees the point decides what lights it: docs/language.md#rsl-20.
TEST(Classes, AreLitByWhatARayNeeds) {
    constexpr struct {
        const char* methods;  // d, g, l, s: diffuselighting, specularlighting, lighting, surface
        float camera, specular, diffuse;
    } kRows[] = {{"dg", 12, 12, 1}, {"l", 3, 3, 3},     {"s", 4, 4, 4},
                 {"dgl", 3, 12, 1}, {"dls", 3, 3, 1},   {"dgs", 12, 12, 1},
                 {"ls", 3, 3, 3},   {"dgls", 3, 12, 1}, {"ds", 4, 4, 1}};
    for (const auto& row : kRows) {
        std::string source =
            "class t() { float n = 0; float add(float k) { n = n * 10 + k; return n; }";
        for (char c : std::string(row.methods)) {
            std::string name = c == 'd'   ? "diffuselighting"
                               : c == 'g' ? "specularlighting"
                               : c == 'l' ? "lighting"
                                          : "surface";
            source += "public void " + name + "(output color Ci, Oi) { Ci = add(" +
                      std::to_string(std::string("dgls").find(c) + 1) + "); }";
        }
        source += " public void postlighting(output color Ci, Oi) { Ci += 0.5; } }";
        for (const char* type : {"camera", "specular", "diffuse", "transmission"}) {
            static int32_t seen_by;
            seen_by = intern(type);
            RunShader run(source);
            ASSERT_TRUE(run.ok()) << run.findings() << source;
            run.services[Service::query] = [](const jit::ServiceCall& call) {
                std::fill_n(call.results, jit::kMaxLanes, std::bit_cast<float>(int32_t(1)));
                std::fill_n(call.results + jit::kMaxLanes, jit::kMaxLanes,
                            std::bit_cast<float>(seen_by));
            };
            float expected = std::string(type) == "diffuse"    ? row.diffuse
                             : std::string(type) == "specular" ? row.specular
                                                               : row.camera;
            EXPECT_EQ(run.value("Ci.r"), expected + 0.5f) << row.methods << " by " << type;
        }
    }
}

// opacity() leaves s / 20: up to the threshold there is a hole, for shadow rays too.
TEST(Classes, MakeHolesUpToAThreshold) {
    const char* source =
        "class t() { public void opacity(output color Oi) { Oi = color(s / 20, s / 40, 0); }"
        " public void surface(output color Ci, Oi) { Ci = 3; Oi += 0.5; } }";
    for (float threshold : {0.0f, 0.25f})
        for (bool colors : {true, false}) {
            LowerOptions options;
            options.opacity_threshold = threshold;
            options.want_Ci = colors;
            RunShader run(source, options);
            ASSERT_TRUE(run.ok()) << run.findings();
            run.inputs = columns_of_s();
            auto got = run.run(kObjectPoints);
            for (int n = 0; n < kObjectPoints; ++n) {
                float opacity = float(n) / 20;
                bool hole = opacity <= threshold;
                EXPECT_FLOAT_EQ(got["Oi.r"][size_t(n)], hole     ? 0
                                                        : colors ? opacity + 0.5f
                                                                 : opacity)
                    << n << " " << threshold;
                if (colors) {
                    EXPECT_EQ(got["Ci.r"][size_t(n)], hole ? 0 : 3) << n;
                }
            }
        }
}

TEST(Classes, SeeTheGlobalsUnderTheNamesOfTheirMethods) {
    auto got = values_of(
        "class t() { void brighter() { extern color Ci; Ci *= 2; }"
        "  public void surface(output color c; output color o;) { c = s + 1; brighter(); c += 1; } "
        "}");
    for (int n = 0; n < kObjectPoints; ++n) EXPECT_EQ(got[size_t(n)], float(2 * (n + 1) + 1)) << n;
}

TEST(Classes, BendNormalsAndLeaveThePoints) {
    std::string source =
        "class t() { float lifted = 0;"
        "  public void displacement(output point P; output normal N) { lifted = s;"
        "    P += vector(0, 0, 1); N = normal(s, 0, 1); }"
        "  public void surface(output color Ci, Oi) { Ci = lifted + zcomp(P); } }";
    auto got = values_of(source), bent = values_of(source, "N.x"), point = values_of(source, "P.z");
    for (int n = 0; n < kObjectPoints; ++n) {
        EXPECT_EQ(got[size_t(n)], float(n));
        EXPECT_EQ(bent[size_t(n)], float(n));
        EXPECT_EQ(point[size_t(n)], 0);
    }
}

// Points of no mesh, as kinora-shade's: nothing has moved them before, so P is where it is put.
TEST(Classes, MovePointsOfNoMesh) {
    std::string source =
        "class t() { float lifted = 0;"
        "  public void displacement(output point P; output normal N) { lifted = s;"
        "    P += vector(0, 0, 2 * s); N = normal(s, 0, 1); }"
        "  public void surface(output color Ci, Oi) { Ci = lifted + 100 * zcomp(P); } }";
    LowerOptions options;
    options.want_P = options.want_N = options.moves_points = true;
    RunShader run(source, options);
    ASSERT_TRUE(run.ok()) << run.findings();
    run.inputs = columns_of_s();
    auto got = run.run(kObjectPoints);
    for (int n = 0; n < kObjectPoints; ++n) {
        EXPECT_EQ(got["Ci.r"][size_t(n)], float(n + 200 * n));
        EXPECT_EQ(got["P.z"][size_t(n)], float(2 * n));
        EXPECT_EQ(got["N.x"][size_t(n)], float(n));
    }
    EXPECT_TRUE(run.shaders[0]->displacement);
}

TEST(Classes, AreOfTheKindThatTheirMethodsName) {
    constexpr struct {
        const char* method;
        ShaderKind kind;
    } kRows[] = {
        {"void light(output vector L; output color Cl) { solar() { Cl = 1; } }", ShaderKind::Light},
        {"void volume(output color Ci, Oi) { Ci *= 0.5; }", ShaderKind::Volume},
        {"void displacement(output point P; output normal N) { P += N; }",
         ShaderKind::Displacement},
        {"void prelighting(output color Ci, Oi) { Ci = 1; }", ShaderKind::Surface}};
    for (const auto& row : kRows) {
        RunShader run(std::string("class t() { public ") + row.method + " }");
        ASSERT_TRUE(run.ok()) << run.findings();
        EXPECT_EQ(run.shaders[0]->kind, row.kind);
    }
}

// The class, as a light that sets L itself, and the same with illuminate.
TEST(Classes, AreLightsThatShineFromWhereLSays) {
    auto lit = [](const std::string& source) {
        RunShader run(source);
        EXPECT_TRUE(run.ok()) << run.findings();
        if (!run.ok()) return std::map<std::string, std::vector<float>>();
        EXPECT_EQ(run.lowered.light_statements.size(), 1u);
        EXPECT_EQ(run.lowered.light_statements[0].kind, kLightIlluminate);
        run.set3("Ps", 1, 2, 3);
        return run.run(1);
    };
    auto got =
        lit("class t(float k = 2;) { public void light(output vector L; output color Cl) {"
            " L = Ps - point(0, 0, 1); Cl = k / (L . L); } }");
    auto expected =
        lit("light t(float k = 2;) { illuminate(point(0, 0, 1)) { Cl = k / (L . L); } }");
    EXPECT_FALSE(got.empty());
    EXPECT_EQ(got.size(), expected.size());
    for (const auto& [name, values] : expected) EXPECT_FLOAT_EQ(got[name][0], values[0]) << name;
}

TEST(Classes, GiveWhatTheSameShadingWithoutThemGives) {
    expect_same(
        "struct Frame { normal n = 0; float turned = 1; void init(float sides) {"
        "   n = normalize(N + normal(0, 0, 1)); if (sides > 1) turned = -1; } }"
        "class t(float Kd = 0.5; float table[3] = {1, 2, 4};) {"
        "  uniform float gain = Kd * 2; varying color base = 1; private Frame frame; float list[];"
        "  color lit(color c) { return c * gain * zcomp(frame->n); }"
        "  color lit(color c; float k) { return lit(c) + k; }"
        "  public void begin() { frame->init(t * 4); push(list, s); push(list, frame->turned); }"
        "  public void prelighting(output color Ci, Oi) { base = color(s, t, 1) * table[1]; }"
        "  public void lighting(output color Ci, Oi) { Ci = this->lit(base, list[1]) + list[0]; }"
        "  public void postlighting(output color Ci, Oi) { Ci *= Oi; } }",
        "surface t() { float turned = t * 4 > 1 ? -1 : 1;"
        "Ci = color(s, t, 1) * 2 * zcomp(normalize(N + normal(0, 0, 1))) + turned + s; Oi = 1; }");
}

// ---- idioms in plain shaders --------------------------------------------------------------------

TEST(Idioms, ArgumentsThatAreLeftOutHaveDefaults) {
    auto got = values_of(
        "float f(float a; float b = 10; float c = b_of(3)) { return a + b * c; }"
        "float b_of(float k) { return k - 1; }"
        "surface t() { Ci = f(s) + f(s, 1) * 100 + f(0, 0, 0); }");
    for (int n = 0; n < kObjectPoints; ++n)
        EXPECT_EQ(got[size_t(n)], float(n + 20 + (n + 2) * 100)) << n;
}

TEST(Idioms, NamedOutputsAreOutputParameters) {
    LowerOptions options;
    options.aovs = {"height", "tint"};
    RunShader run(
        "void keep(float h) { writeaov(\"height\", h); }"
        "surface t() { float back = 9, none = 4; keep(s * 2); writeaov(\"tint\", color(s, t, 1));"
        "Ci = readaov(\"height\", back) + back * 10 + readaov(\"other\", none) + none; }",
        options);
    ASSERT_TRUE(run.ok()) << run.findings();
    run.inputs = columns_of_s();
    auto got = run.run(kObjectPoints);
    ASSERT_TRUE(got.contains("aov:height") && got.contains("aov:tint.b"));
    for (int n = 0; n < kObjectPoints; ++n) {
        EXPECT_EQ(got["aov:height"][size_t(n)], float(2 * n));
        EXPECT_EQ(got["aov:tint.b"][size_t(n)], 1);
        EXPECT_EQ(got["Ci.r"][size_t(n)], float(5 + 20 * n));
    }
}

TEST(Idioms, StringsGiveNumbers) {
    constexpr struct {
        const char* expression;
        float value;
    } kRows[] = {
        {"stof(\"2.5\")", 2.5f}, {"stof(\" -1e2x\")", -100}, {"stof(\"\")", 0},
        {"stof(\"three\")", 0},  {"stof(\"+7\")", 7},        {"strlen(\"\")", 0},
        {"strlen(\"four\")", 4}, {"stof(\"inf\")", 0},       {"strlen(sprintf(\"%d|\", 12))", 3}};
    for (const auto& row : kRows)
        for (float value : values_of(std::string("surface t() { Ci = ") + row.expression + "; }"))
            EXPECT_EQ(value, row.value) << row.expression;
}

}  // namespace
}  // namespace kinora::rsl
