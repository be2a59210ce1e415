// tests/runtime/sampled_lights_test.cpp: lights of RSL 2.0 with sample methods, against closed
// forms and double-precision quadrature.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/runtime/expect_colors.h"
#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A sphere about the origin of its space, sampled inside the cone that it fills.
const char* const kSphere = R"(
class ball(uniform float radius = 0.4; uniform float samples = 16; uniform color radiance = 1;) {
    vector way = 0;
    float far = 0, least = 0, pdf = 0;
    void look() {
        way = point "shader" (0, 0, 0) - Ps;
        far = length(way);
        float sine2 = min(1, radius * radius / (far * far));
        least = sqrt(1 - sine2);
        pdf = (1 + least) / (2 * PI * sine2);
    }
    float reach(vector D) {
        float c = D . way;
        return c - sqrt(max(0, radius * radius - far * far + c * c));
    }
    public void light(output vector L; output color Cl) {
        L = Ps - point "shader" (0, 0, 0);
        Cl = 0;
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        look();
        vector W = way / far;
        vector T = normalize(abs(W[0]) < 0.9 ? W ^ vector(1, 0, 0) : W ^ vector(0, 1, 0));
        vector B = W ^ T;
        uniform float i;
        resize(s, samples);
        for (i = 0; i < samples; i += 1) {
            float c = 1 - random() * (1 - least), a = 2 * PI * random();
            vector D = W * c + (T * cos(a) + B * sin(a)) * sqrt(max(0, 1 - c * c));
            s[i]->setLightSample(radiance, pdf, D, reach(D));
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        look();
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            vector D = s[i]->direction;
            if (D . way > least * far) {
                s[i]->setLightSample(radiance, pdf);
                s[i]->distance = reach(D);
            }
        }
    }
})";

// Lambert and a microfacet lobe (B. Walter and others 2007, GGX) with both sample methods.
const char* const kPlate = R"(
class plate(float rough = 0.15; uniform float samples = 4; uniform float mis = 1;
            uniform string heuristic = "veachpower2"; float dull = 0.5; float gloss = 0.5;) {
    normal Nn = 0;
    vector Vn = 0, Tn = 0, Bn = 0;
    public void begin() {
        Nn = normalize(faceforward(N, I));
        Vn = -normalize(I);
        Tn = normalize(abs(Nn[0]) < 0.9 ? Nn ^ vector(1, 0, 0) : Nn ^ vector(0, 1, 0));
        Bn = Nn ^ Tn;
    }
    float shadowing(float c) { return 2 * c / (c + sqrt(rough * rough + (1 - rough * rough) * c * c)); }
    void evaluate(vector Ln; output color response; output float pdf) {
        vector H = normalize(Ln + Vn);
        float nl = Ln . Nn, nv = Vn . Nn, nh = H . Nn, vh = H . Vn;
        response = 0;
        pdf = 0;
        if (nv > 0 && nh > 0 && vh > 0) {
            float k = nh * nh * (rough * rough - 1) + 1, d = rough * rough / (PI * k * k);
            pdf = d * nh / (4 * vh);
            if (nl > 0) response = gloss * d * shadowing(nl) * shadowing(nv) / (4 * nv);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        color response = 0;
        float pdf = 0;
        for (i = 0; i < arraylength(s); i += 1) {
            evaluate(s[i]->direction, response, pdf);
            if (what == "diffuse")
                s[i]->setMaterialResponse(dull * max(0, s[i]->direction . Nn) / PI, 0);
            else
                s[i]->setMaterialResponse(response, pdf);
        }
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        uniform float i, start = arraylength(s), end = start + samples;
        color response = 0;
        float pdf = 0;
        if (what == "specular") {
            resize(s, end);
            for (i = start; i < end; i += 1) {
                float x = random(), a = 2 * PI * random();
                float c = sqrt((1 - x) / (1 + (rough * rough - 1) * x));
                vector H = (Tn * cos(a) + Bn * sin(a)) * sqrt(max(0, 1 - c * c)) + Nn * c;
                vector Ln = 2 * (H . Vn) * H - Vn;
                evaluate(Ln, response, pdf);
                s[i]->setMaterialSample(response, pdf, Ln, 1e30);
            }
        }
    }
    public void lighting(output color Ci, Oi) {
        color d = 0, g = 0;
        directlighting(this, getlights(), "mis", mis, "heuristic", heuristic, "diffuseresult", d,
                       "specularresult", g);
        Ci = d + g;
    }
})";

std::string number(const char* symbol, double value) {
    return fmt::format("<bind symbol=\"{}\"><float>{}</float></bind>", symbol, value);
}
std::string surface(const std::string& binds) {
    return "<shader stage=\"SURFACE\">" + binds + "</shader>";
}

// The floor, lit by the sphere at that height, which the camera does not see.
SceneText lit_floor(const std::string& code, double height, const std::string& binds,
                    const std::string& passes = "<shader stage=\"SURFACE\"/>") {
    SceneText scene = floor_scene(code, passes);
    scene.rsl_light("lamp", kSphere, fmt::format("<translate>0 0 {}</translate>", height), binds);
    return scene;
}

// Radiance / PI x irradiance of a sphere that the horizon does not cut.
double sphere_irradiance(dvec2 p, double height, double radius) {
    double far2 = height * height + glm::dot(p, p);
    return radius * radius / far2 * height / std::sqrt(far2);
}

TEST(SampledLights, ASphereGivesItsIrradianceToOldAndNewSurfaces) {
    for (const char* code : {kMatte, kPlate}) {
        SceneText scene = lit_floor(
            code, 2, number("samples", 256),
            code == kMatte ? surface("") : surface(number("dull", 1) + number("gloss", 0)));
        Rendering r(scene.text());
        EXPECT_EQ(r.findings(), "");
        r.frame();
        double sum = 0, wanted = 0;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) {
                double want = sphere_irradiance(r.place(x, y), 2, 0.4);
                EXPECT_NEAR(r.color(x, y).x, want, 2e-2 * want) << code << x << "," << y;
                sum += double(r.color(x, y).x), wanted += want;
            }
        EXPECT_NEAR(sum, wanted, 1e-3 * wanted) << code;
    }
}

// One convention (docs/lights.md): Cl of 1 that faces a white Lambert surface gives 1.
TEST(SampledLights, AnOldLampOfOneGivesOneByEitherCall) {
    for (const char* code : {kMatte, kPlate}) {
        SceneText scene = floor_scene(
            code, code == kMatte ? surface("") : surface(number("dull", 1) + number("gloss", 0)));
        scene.rsl_light("sun", "light sun() { solar(vector \"world\" (0, 0, -1), 0) Cl = 1; }");
        Rendering r(scene.text());
        expect_colors(
            r.frame(), [](dvec2) { return dvec3(1.0); }, 1e-6);
    }
}

double mean_of(SceneText& scene, int seed_count) {
    double sum = 0;
    for (int seed = 0; seed < seed_count; ++seed) {
        Rendering r(scene.text());
        r.settings.integrator.seed = uint32_t(seed);
        r.settings.integrator.samples_per_pixel = 64;
        r.frame();
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) sum += double(r.color(x, y).x);
    }
    return sum / (256.0 * seed_count);
}

// Whoever chooses the directions, the mean is the same: weights add up to 1.
TEST(SampledLights, StrategiesAndHeuristicsHaveOneMean) {
    auto mean = [&](double mis, const char* heuristic) {
        SceneText scene =
            lit_floor(kPlate, 2, number("radius", 0.8) + number("samples", 8),
                      surface(number("mis", mis) + number("samples", 64) + number("rough", 0.3) +
                              fmt::format("<bind symbol=\"heuristic\"><string>{}</string></bind>",
                                          heuristic)));
        return mean_of(scene, 4);
    };
    const double lights = mean(0, "balance");
    EXPECT_GT(lights, 0.01);
    EXPECT_NEAR(mean(1, "balance"), lights, 2e-3 * lights);
    EXPECT_NEAR(mean(1, "veachpower2"), lights, 2e-3 * lights);
    EXPECT_NEAR(mean(2, "power"), lights, 1e-2 * lights);
}

// A square halfway hides the lamp's lower part from some points and all of it from others.
TEST(SampledLights, ShadowsTakeSamplesAway) {
    SceneText scene = lit_floor(kMatte, 2, number("samples", 64));
    scene.square("shade", 0.5).look("dark", "surface dark() { Ci = 0; Oi = 1; }");
    scene.place("shade", "dark", "<translate>-5 0 1</translate><scale>10 10 1</scale>");
    Rendering r(scene.text());
    r.frame();
    // The edge x = 0 at half the height: what is right of it by the radius sees the whole sphere.
    for (int x : {0, 2}) EXPECT_EQ(r.color(x, 8).x, 0) << x;
    double want = sphere_irradiance(r.place(14, 8), 2, 0.4);
    EXPECT_NEAR(r.color(14, 8).x, want, 1e-2 * want);
}

TEST(SampledLights, WrongWordsAndNumbersAreErrors) {
    struct {
        const char* pair;
        const char* code;
    } rows[] = {{"\"heuristic\", \"nonsense\"", "RSL_PAIR_VALUE"},
                {"\"mis\", 3", "RSL_PAIR_VALUE"},
                {"\"diffusemis\", 2", "RSL_PAIR_VALUE"},
                {"\"integrationdomain\", \"ball\"", "RSL_PAIR_VALUE"},
                {"\"heuristic\", \"balance\"", ""}};
    for (const auto& row : rows) {
        std::string code = kPlate;
        const std::string pair = "\"mis\", mis, \"heuristic\", heuristic";
        code.replace(code.find(pair), pair.size(), row.pair);
        Rendering r(floor_scene(code).text());
        EXPECT_EQ(r.count("RSL_PAIR_VALUE"), *row.code ? 1 : 0) << row.pair << r.findings();
    }
}

}  // namespace
}  // namespace kinora
