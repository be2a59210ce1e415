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

// The mean over the pixels of each one's variance over seeds, and the mean.
struct Noise {
    double variance = 0, mean = 0;
};
Noise noise_of(const SceneText& scene) {
    constexpr int kSeeds = 8, kPixels = 256;
    std::vector<double> sum(kPixels), squares(kPixels);
    for (int seed = 0; seed < kSeeds; ++seed) {
        Rendering r(scene.text());
        r.settings.integrator.seed = uint32_t(seed);
        r.frame();
        for (size_t k = 0; k < kPixels; ++k) {
            double c = double(r.color(int(k % 16), int(k / 16)).x);
            sum[k] += c, squares[k] += c * c;
        }
    }
    Noise noise;
    for (size_t k = 0; k < kPixels; ++k) {
        noise.variance += (squares[k] - sum[k] * sum[k] / kSeeds) / (kSeeds - 1) / kPixels;
        noise.mean += sum[k] / kSeeds / kPixels;
    }
    return noise;
}

// E. Veach and L. Guibas 1995: both strategies together are nowhere much worse than the better one,
// and on the whole far better than either.
TEST(SampledLights, WeighingIsAsGoodAsTheBetterStrategyEverywhere) {
    constexpr int kSamples = 16;
    struct {
        double rough, radius;
    } regions[] = {{0.05, 0.05}, {0.05, 0.7}, {0.15, 0.4}, {0.5, 0.05}, {0.5, 0.7}};
    double whole[3] = {};
    for (const auto& region : regions) {
        Noise by[3];
        for (int mis = 0; mis < 3; ++mis)
            by[mis] = noise_of(
                lit_floor(kPlate, 3, number("radius", region.radius) + number("samples", kSamples),
                          surface(number("mis", mis) + number("samples", kSamples) +
                                  number("dull", 0) + number("rough", region.rough))));
        const double least = std::min(by[0].variance, by[2].variance);
        EXPECT_LE(by[1].variance, 1.1 * least + by[0].mean * by[0].mean / (10 * kSamples))
            << region.rough << " " << region.radius;
        for (int mis = 0; mis < 3; ++mis)
            whole[mis] += by[mis].variance / (by[0].mean * by[0].mean);
    }
    EXPECT_LE(whole[1], 0.35 * std::min(whole[0], whole[2]));
}

// The floor under a square of the mesh that shines by both sides, of that half width.
SceneText under_square(double half, const std::string& binds) {
    SceneText scene = floor_scene(kPlate, surface(binds));
    scene.square("lamp", half)
        .look("lamp-look",
              "light panel() { illuminate(P) Cl = 8 *"
              " abs(normalize(L) . normalize(N)) / (L . L); }",
              "<shader stage=\"LIGHT\"/>");
    return scene.place("lamp", "lamp-look",
                       "<translate>0 0.5 3</translate><rotate>1 0 0 150</rotate>");
}

// A lamp on geometry: the material's directions that meet its mesh are weighed against its samples.
TEST(SampledLights, LampsOnGeometryAreWeighedAsWell) {
    constexpr int kSamples = 16;  // of lamps, too
    for (double rough : {0.05, 0.4}) {
        Noise by[3];
        for (int mis = 0; mis < 3; ++mis)
            by[mis] = noise_of(under_square(
                0.7, number("mis", mis) + number("samples", kSamples) + number("rough", rough)));
        EXPECT_NEAR(by[1].mean, by[0].mean, 0.02 * by[0].mean) << rough;
        const double least = std::min(by[0].variance, by[2].variance);
        EXPECT_LE(by[1].variance, 1.1 * least + by[0].mean * by[0].mean / (10 * kSamples)) << rough;
    }
    auto mean = [](double mis) {
        SceneText scene =
            under_square(1, number("mis", mis) + number("samples", 64) + number("rough", 0.3));
        return mean_of(scene, 4);
    };
    const double lights = mean(0);
    EXPECT_GT(lights, 0.01);
    EXPECT_NEAR(mean(1), lights, 2e-3 * lights);
    EXPECT_NEAR(mean(2), lights, 1e-2 * lights);
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

double mean_red(const raytrace::Film& film) {
    double sum = 0;
    for (const vec4& pixel : film.rgba) sum += double(pixel.x);
    return sum / double(film.rgba.size());
}

// Walls that the camera sees gather four rays, where those arrive the lamp sends sixteen samples.
TEST(SampledLights, FewerCountBehindRaysOfMany) {
    auto rendered = [](uint32_t behind) {
        SceneText scene;
        scene.cube("box", 10).look("wall", R"(surface wall() {
            float depth = 0;
            normal Nf = normalize(faceforward(N, I));
            rayinfo("depth", depth);
            Oi = 1;
            if (depth == 0)
                Ci = indirectdiffuse(P, Nf, 4);
            else
                Ci = diffuse(Nf);
        })");
        scene.place("box", "wall");
        scene.rsl_light("lamp", kSphere, "<translate>1 2 -1</translate>", number("samples", 16));
        SceneOptions options;
        options.quality.samples_behind = behind;
        auto made = std::make_unique<Rendering>(scene.text(), options);
        EXPECT_EQ(made->findings(), "");
        made->settings.integrator.samples_per_pixel = 16;
        made->frame();
        return made;
    };
    const auto all = rendered(0), one = rendered(1), five = rendered(5);
    // Of the camera, gathered, and to the lamp from what the camera sees.
    constexpr double kOthers = (1 + 4 + 16) * 256.0 * 16;
    const auto sent = [](const auto& r) { return double(r->stats.rays) - kOthers; };
    EXPECT_NEAR(sent(all) / sent(one), 16, 0.5);
    EXPECT_NEAR(sent(all) / sent(five), 16 / 5.0, 0.1);
    const double want = mean_red(all->film);
    EXPECT_NEAR(mean_red(one->film), want, 5e-3 * want);
    EXPECT_NEAR(mean_red(five->film), want, 5e-3 * want);
}

// ---- lobes of stdrsl under a white sky ----------------------------------------------------------

// A square that the camera sees at that angle, within a cube that shines 1.
double under_white_sky(const std::string& lobe, const std::string& init, double degrees) {
    const std::string code = R"(#include <stdrsl/)" + lobe + R"(.h>
class x() {
    stdrsl_ShadingContext context;
    stdrsl_Fresnel fresnel;
    stdrsl_)" + lobe + R"( lobe;
    public void begin() { context->init(); lobe->)" +
                             init + R"( }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        lobe->evalSpecularSamps(context, fresnel, s);
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        lobe->genSpecularSamps(context, fresnel, what, s);
    }
    public void lighting(output color Ci, Oi) { Ci = indirectspecular(this); }
})";
    SceneText scene;
    scene.square("plate", 4)
        .look("lobe", code)
        .place("plate", "lobe", fmt::format("<rotate>1 0 0 {}</rotate>", degrees));
    scene.cube("sky", 40).look("white", "surface white() { Ci = 1; Oi = 1; }");
    scene.place("sky", "white");
    Rendering r(scene.text());
    EXPECT_EQ(r.findings(), "");
    r.settings.integrator.samples_per_pixel = 4;
    r.frame();
    double sum = 0;
    for (int y = 7; y < 9; ++y)
        for (int x = 0; x < 16; ++x) sum += double(r.color(x, y).x);
    return sum / 32;
}

// What the lobe reflects of light 1 from everywhere: its response over the half turn, by midpoints.
double reflected(double degrees, const std::function<double(dvec3 L, dvec3 V)>& response) {
    const double angle = degrees * kPi / 180;
    const dvec3 V(std::sin(angle), 0, std::cos(angle));
    constexpr int kSteps = 500;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            double z = (i + 0.5) / kSteps, turn = 2 * kPi * (j + 0.5) / kSteps;
            double r = std::sqrt(1 - z * z);
            sum += response({r * std::cos(turn), r * std::sin(turn), z}, V);
        }
    return sum * 2 * kPi / (double(kSteps) * kSteps);
}

// M. Ashikhmin and P. Shirley 2000, both exponents n, reflectance 1; with the cosine.
double ashikhmin_shirley(dvec3 L, dvec3 V, double n) {
    dvec3 H = glm::normalize(L + V);
    return (n + 1) / (8 * kPi) * std::pow(H.z, n) * L.z / (glm::dot(H, V) * std::max(L.z, V.z));
}
// M. Ashikhmin and S. Premoze 2007 with Beckmann's distribution.
double premoze(dvec3 L, dvec3 V, double m) {
    double c2 = std::pow(glm::normalize(L + V).z, 2);
    double p = std::exp((c2 - 1) / (c2 * m * m)) / (kPi * m * m * c2 * std::sqrt(c2));
    return p * L.z / (4 * (L.z + V.z - L.z * V.z));
}

TEST(SampledLobes, ReflectUnderAWhiteSkyWhatTheirResponseIntegratesTo) {
    for (double degrees : {5.0, 30.0, 60.0, 80.0})
        for (double rough : {0.1, 0.5}) {
            auto as = [&](dvec3 L, dvec3 V) {
                return ashikhmin_shirley(L, V, 1 / (rough * rough));
            };
            const double want = reflected(degrees, as);
            EXPECT_NEAR(
                under_white_sky("SpecularAS",
                                fmt::format("init(context, color 1, {}, 0, 1, 256, 256);", rough),
                                degrees),
                want, 3e-3 * want)
                << "AS " << rough << " at " << degrees;
            auto dbrdf = [&](dvec3 L, dvec3 V) { return premoze(L, V, rough); };
            const double other = reflected(degrees, dbrdf);
            EXPECT_NEAR(
                under_white_sky(
                    "SpecularDBRDF",
                    fmt::format("init(context, \"beckmann\", color 1, {}, 256, 256);", rough),
                    degrees),
                other, 3e-3 * other)
                << "DBRDF " << rough << " at " << degrees;
        }
}

// A lamp of a group behind a shade, and one of another in the open.
TEST(SampledLights, ResultsWithoutShadowsAndOfGroupsAreParts) {
    const std::string code = R"(
class x(uniform string groups[] = {"key", "fill"}; uniform float which = 0;) {
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1)
            s[i]->setMaterialResponse(what == "diffuse" ? max(0, zcomp(vtransform("world",
                                      s[i]->direction))) / PI : 0, 0);
    }
    public void lighting(output color Ci, Oi) {
        color d = 0, bare = 0, each[], bare_each[];
        directlighting(this, getlights(), "lightgroups", groups, "diffuseresult", d,
                       "unshadoweddiffuseresult", bare, "groupeddiffuseresults", each,
                       "groupedunshadoweddiffuseresults", bare_each);
        Ci = which == 0 ? d : which == 1 ? bare : which == 2 ? each[0] : which == 3 ? each[1]
           : which == 4 ? bare_each[0] : bare_each[1];
    }
})";
    auto sun = [](const char* group, double Cl, const char* from) {
        return fmt::format(
            "light sun(uniform string __group = \"{}\";) {{"
            " solar(vector \"world\" {}, 0) Cl = {}; }}",
            group, from, Cl);
    };
    const double expected[] = {0.25 * 0.6, 1 + 0.25 * 0.6, 0, 0.25 * 0.6, 1, 0.25 * 0.6};
    for (int which = 0; which < 6; ++which) {
        SceneText scene = floor_scene(code, surface(number("which", which)));
        scene.rsl_light("above", sun("key", 1, "(0, 0, -1)"));
        scene.rsl_light("aside", sun("fill", 0.25, "(-0.8, 0, -0.6)"));
        // The shade is far above the floor and out of the camera's sight.
        scene.square("shade", 1.5).look("dark", "surface dark() { Ci = 0; Oi = 1; }");
        scene.place("shade", "dark", "<translate>0 0 20</translate>");
        Rendering r(scene.text());
        EXPECT_EQ(r.findings(), "");
        r.frame();
        EXPECT_NEAR(r.color(8, 8).x, expected[which], 1e-5) << which;
    }
}

// ---- indirect light of every scene (--gi) -------------------------------------------------------

// Within a closed box whose walls shine 1 and reflect a half: 1 + 1/2 + 1/4 + ..., a term a bounce.
// A wall that gathers such light itself has it once.
TEST(IndirectLight, FillsAClosedBoxByItsSeries) {
    const char* const kWalls[] = {
        "surface wall() { Oi = 1; Ci = 1 + 0.5 * diffuse(normalize(faceforward(N, I))); }",
        "surface wall() { normal Nf = normalize(faceforward(N, I)); Oi = 1;"
        " Ci = 1 + 0.5 * (diffuse(Nf) + indirectdiffuse(P, Nf, 1)); }"};
    for (const char* wall : kWalls)
        for (uint32_t bounces : {0u, 1u, 4u}) {
            SceneText scene;
            scene.cube("box", 20).look("wall", wall).place("box", "wall");
            SceneOptions options;
            options.lights = LightSet::Scene;
            options.indirect = bounces;
            if (wall == kWalls[1]) options.quality.diffuse_depth = bounces;
            Rendering r(scene.text(), options);
            EXPECT_EQ(r.findings(), "");
            const double want = 2 - std::pow(0.5, bounces);
            expect_colors(
                r.frame(), [&](dvec2) { return dvec3(want); }, 1e-5);
        }
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
