// tests/rsl/objects/lights_test.cpp: the lights of a scene as values of type shader, and calls of
// shaders that are null. Expected numbers are arithmetic by hand.
#include <gtest/gtest.h>

#include "jit/target.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

// An ambient light, which nobody lists; a key light from above; a fill light that does not reach
// the point; one from the side.
std::vector<TestLight> four_lights(const LoweredShader& lowered) {
    std::vector<TestLight> lights(4);
    lights[0].kind = kLightAmbient;
    lights[1].L[2] = 2, lights[1].Cl[0] = 0.5f;
    lights[2].lit = 0, lights[2].Cl[0] = 100;
    lights[3].L[0] = 4, lights[3].L[2] = 0, lights[3].Cl[0] = 0.25f;
    for (size_t k = 0; k < lowered.categories.size(); ++k)
        if (lowered.categories[k] == "key") lights[1].categories |= 1u << k;
    for (size_t k = 0; k < 4; ++k)
        for (size_t c = 0; c < lowered.light_messages.size(); ++c)
            lights[k].messages.push_back(float(k) * 10);
    return lights;
}

void expect_lit(const std::string& class_source, float expected) {
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        RunShader run(class_source, {}, {}, false, target.name);
        ASSERT_TRUE(run.ok()) << run.findings();
        run.lights = four_lights(run.lowered);
        EXPECT_FLOAT_EQ(run.value("Ci.r"), expected) << target.name << class_source;
        EXPECT_EQ(run.faults, 0) << target.name;
    }
}

std::string lit(const std::string& body, const std::string& members = "") {
    return "class a(string kind = \"key\"; float wanted = 1;) { " + members +
           " public void lighting(output color Ci, Oi) { Ci = 0; uniform float i; vector L = 0;"
           " color Cl = 0; " +
           body + " } }";
}

std::string findings_of_lit(const std::string& body, const std::string& members = "") {
    return RunShader(lit(body, members)).findings();
}

const std::string kSum =
    "for (i = 0; i < arraylength(all); i += 1) { all[i]->light(L, Cl);"
    " Ci += Cl * (length(L) + 10 * zcomp(L)); } ";

TEST(Getlights, ListsWhatReachesThePoint) {
    expect_lit(lit("shader all[] = getlights(); Ci = arraylength(all);"), 2);
    expect_lit(lit("shader all[] = getlights(\"category\", \"key\"); Ci = arraylength(all);"), 1);
    expect_lit(lit("shader all[] = getlights(\"category\", kind); Ci = arraylength(all);"), 1);
    expect_lit(lit("shader all[] = getlights(\"category\", \"-key\"); Ci = arraylength(all);"), 1);
    expect_lit(lit("shader all[]; all = getlights(\"category\", \"none\"); Ci = arraylength(all);"),
               0);
}

// Of length 2 and down, color 0.5; of length 4 and level, color 0.25.
TEST(Getlights, GivesLightsWhoseLightMethodIsCalled) {
    float key = 0.5f * (2 - 10 * 2), side = 0.25f * 4;
    expect_lit(lit("shader all[] = getlights(); " + kSum), key + side);
    expect_lit(lit("shader all[] = getlights(\"category\", kind); " + kSum), key);
    expect_lit(lit("shader all[] = getlights(\"category\", \"-key\"); " + kSum), side);
    expect_lit(lit(kSum, "shader all[]; public void begin() { all = getlights(); }"), key + side);
}

TEST(Getlights, LightsHaveParametersAndAMethod) {
    expect_lit(lit("shader all[] = getlights(); float x = 7;"
                   "for (i = 0; i < arraylength(all); i += 1) {"
                   " if (getvar(all[i], \"intensity\", x) == 1) Ci += x; }"),
               10 + 30);
    expect_lit(
        lit("shader all[] = getlights();"
            "Ci = hasmethod(all[1], \"light\") + 2 * hasmethod(all[1], \"generateSamples\");"),
        1);
}

// An element that is no light yet is null.
TEST(Getlights, LightsStandBesideOtherShaders) {
    expect_lit(lit("shader all[] = getlights(); resize(all, 3); float k = 0;"
                   "for (i = 0; i < arraylength(all); i += 1) { if (all[i] != null) k += 1; }"
                   "shader one = null; if (s < 1) one = all[1]; one->light(L, Cl); Ci = k + Cl;"),
               2 + 0.25f);
}

// Cl of 1 is a radiance of PI: what a Lambert response of cosine / PI makes 1 of.
TEST(Getlights, FeedsDirectlighting) {
    std::string samples =
        "public void evaluateSamples(string what; output __radiancesample r[]) { uniform float k;"
        "for (k = 0; k < arraylength(r); k += 1) r[k]->setMaterialResponse(color 2, 1); }";
    expect_lit(lit("shader all[] = getlights(\"category\", \"key\"); color d = 0;"
                   "Ci = directlighting(this, all, \"diffuseresult\", d);",
                   samples),
               3.14159265f * (0.5f * 2 + 0.5f * 2));
}

TEST(Getlights, SaysWhatCannotBeDone) {
    const std::string all = "shader all[] = getlights(); color c; ";
    struct {
        std::string body;
        const char* code;
    } rows[] = {
        {all + "all[0]->generateSamples(\"sphere\", c);", "RSL_LIGHT_METHOD"},
        {all + "all[0]->light(L);", "RSL_LIGHT_METHOD"},
        {all + "if (s > 0) all[0] = getshader(\"a\"); all[0]->intensity = 1;",
         "RSL_CO_SHADER_WRITE"},
        {"shader all[] = getlights(\"group\", \"a\"); Ci = arraylength(all);", "RSL_LIGHT_QUERY"},
        {"shader all = getlights();", "RSL_ARRAY_AS_VALUE"}};
    for (auto& row : rows)
        EXPECT_NE(findings_of_lit(row.body).find(row.code), std::string::npos)
            << row.body << findings_of_lit(row.body);
    EXPECT_NE(findings_of_lit("Ci = 1;", "shader all[] = getlights();").find("RSL_LIGHT_QUERY"),
              std::string::npos);
}

// ---- calls of shaders that are null -------------------------------------------------------------

int faults_of(const std::string& body, float s, std::string* said = nullptr) {
    int faults = -1;
    for (const jit::Target& target : jit::targets()) {
        if (!target.supported()) continue;
        std::string source =
            "class a() { public void surface(output color Ci, Oi) { " + body + " } }";
        std::vector<LinkedSource> both(2);
        both[0].source.text = source;
        both[1].handle = "m";
        both[1].source.text = "class m() { public float value(float x) { return x; } }";
        RunShader run(both, {}, {}, target.name);
        EXPECT_TRUE(run.ok()) << run.findings();
        if (!run.ok()) return -1;
        run.set("s", s);
        run.run(3);
        if (faults < 0) faults = run.faults;
        EXPECT_EQ(faults, run.faults) << target.name;
        if (said)
            for (const jit::FaultSite& site : run.lowered.module.fault_sites)
                *said += site.message + "\n";
    }
    return faults;
}

TEST(NullShaders, ReportCallsThatNothingAnswers) {
    const std::string either = "shader h = null; if (s > 0) h = getshader(\"m\"); ";
    std::string said;
    EXPECT_EQ(faults_of(either + "Ci = h->value(2);", 0, &said), 1);
    EXPECT_NE(said.find("'value()' is called through a shader that is null"), said.npos) << said;
    EXPECT_EQ(faults_of(either + "Ci = h->value(2);", 1), 0);
    EXPECT_EQ(faults_of(either + "Ci = 0; if (h != null) Ci = h->value(2);", 0), 0);
    EXPECT_EQ(faults_of("shader h = null; Ci = h->value(2);", 0), 1);
    EXPECT_EQ(faults_of("shader h = null; Ci = 0; if (h != null) Ci = h->value(2);", 0), 0);
    EXPECT_EQ(faults_of("shader h = null; Ci = 0; if (h != null && h->value(2) > 1) Ci = 1;", 0),
              0);
}

}  // namespace
}  // namespace kinora::rsl
