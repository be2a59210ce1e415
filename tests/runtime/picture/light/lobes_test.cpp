// tests/runtime/picture/light/lobes_test.cpp: stdrsl's lobes in a white dome: no more energy than
// arrives, and as much as double-precision quadrature of their response.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/runtime/scene_text.h"

namespace kinora {
namespace {

using Response = double (*)(dvec3 L, dvec3 V, double rough);

double square(double x) {
    return x * x;
}

// M. Ashikhmin and P. Shirley 2000, both exponents 1 / rough^2, reflectance 1; with the cosine.
double ashikhmin_shirley_lobe(dvec3 L, dvec3 V, double rough) {
    const dvec3 H = glm::normalize(L + V);
    const double n = 1 / square(rough);
    return (n + 1) / (8 * kPi) * std::pow(H.z, n) * L.z / (glm::dot(H, V) * std::max(L.z, V.z));
}

// M. Ashikhmin and S. Premoze 2007: p(H) L.N / (4 (L.N + V.N - L.N V.N)).
double premoze_lobe(double p, dvec3 L, dvec3 V) {
    return p * L.z / (4 * (L.z + V.z - L.z * V.z));
}
double beckmann_lobe(dvec3 L, dvec3 V, double rough) {
    const double c = glm::normalize(L + V).z, c2 = square(c), m2 = square(rough);
    return premoze_lobe(std::exp((c2 - 1) / (c2 * m2)) / (kPi * m2 * c2 * c), L, V);
}
double blinn_premoze_lobe(dvec3 L, dvec3 V, double rough) {
    const double n = 1 / square(rough);
    return premoze_lobe((n + 1) / (2 * kPi) * std::pow(glm::normalize(L + V).z, n), L, V);
}

// K. Torrance and E. Sparrow 1967 with J. Blinn's distribution of 1977: D G / (4 V.N).
double blinn_lobe(dvec3 L, dvec3 V, double rough) {
    const dvec3 H = glm::normalize(L + V);
    const double n = 1 / square(rough), D = (n + 2) / (2 * kPi) * std::pow(H.z, n);
    const double G = std::min(1.0, 2 * H.z * std::min(L.z, V.z) / glm::dot(H, V));
    return D * G / (4 * V.z);
}

struct Lobe {
    const char* type;
    const char* init;  // of a roughness
    Response response;
};
constexpr Lobe kLobes[] = {
    {"SpecularAS", "init(context, color 1, rough, 0, 1, 256, 256);", ashikhmin_shirley_lobe},
    {"SpecularDBRDF", "init(context, \"beckmann\", color 1, rough, 256, 256);", beckmann_lobe},
    {"SpecularDBRDF", "init(context, \"blinn\", color 1, rough, 256, 256);", blinn_premoze_lobe},
    {"SpecularBlinn", "init(context, color 1, rough, 256, 256);", blinn_lobe},
};
constexpr double kDegrees[] = {5, 30, 60, 80}, kRough[] = {0.05, 0.1, 0.2, 0.5, 1};

// Of light 1 from everywhere, by midpoints of the half vector's angle and turn, with the Jacobian 4
// V.H: fine where the lobe is narrow.
double quadrature(const Lobe& lobe, double degrees, double rough) {
    const double angle = degrees * kPi / 180;
    const dvec3 V(std::sin(angle), 0, std::cos(angle));
    const double widest = std::min(kPi / 2, 8 * rough);
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double down = widest * (i + 0.5) / kSteps, turn = kPi * (j + 0.5) / kSteps;
            const double s = std::sin(down);
            const dvec3 H(s * std::cos(turn), s * std::sin(turn), std::cos(down));
            const double between = glm::dot(V, H);
            const dvec3 L = 2 * between * H - V;
            if (between > 0 && L.z > 0) sum += lobe.response(L, V, rough) * 4 * between * s;
        }
    return sum * 2 * kPi * widest / square(kSteps);
}

std::string lobe_code(const Lobe& lobe) {
    return fmt::format(R"(#include <stdrsl/{0}.h>
class x(uniform float rough = 1;) {{
    stdrsl_ShadingContext context;
    stdrsl_Fresnel fresnel;
    stdrsl_{0} lobe;
    public void begin() {{ context->init(); lobe->{1} }}
    public void evaluateSamples(string what; output __radiancesample s[]) {{
        lobe->evalSpecularSamps(context, fresnel, s);
    }}
    public void generateSamples(string what; output __radiancesample s[]) {{
        lobe->genSpecularSamps(context, fresnel, what, s);
    }}
    public void lighting(output color Ci, Oi) {{ Ci = indirectspecular(this); }}
}})",
                       lobe.type, lobe.init);
}

struct Estimate {
    double mean = 0, error = 0;  // standard error of the mean
};

// The plate fills the picture at any angle; a pixel is one estimate.
Estimate in_white_dome(const Lobe& lobe, double degrees, double rough) {
    SceneText scene;
    scene.square("plate", 12)
        .look(
            "lobe", lobe_code(lobe),
            fmt::format("<shader stage=\"SURFACE\"><bind symbol=\"rough\"><float>{}</float></bind>"
                        "</shader>",
                        rough));
    scene.place("plate", "lobe", fmt::format("<rotate>1 0 0 {}</rotate>", degrees));
    scene.cube("sky", 40).look("white", "surface white() { Ci = 1; Oi = 1; }");
    scene.place("sky", "white");
    Rendering r(scene.text());
    EXPECT_EQ(r.findings(), "");
    r.frame(16, 16);
    double sum = 0, squares = 0;
    for (int k = 0; k < 256; ++k) {
        const double c = double(r.color(k % 16, k / 16).x);
        sum += c / 256, squares += c * c / 256;
    }
    return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / 255)};
}

TEST(LobesInAWhiteDome, ReflectTheirResponseAndNoMoreThanArrives) {
    for (const Lobe& lobe : kLobes)
        for (double degrees : kDegrees)
            for (double rough : kRough) {
                SCOPED_TRACE(
                    fmt::format("{} {} degrees {} rough {}", lobe.type, lobe.init, degrees, rough));
                const double want = quadrature(lobe, degrees, rough);
                const Estimate got = in_white_dome(lobe, degrees, rough);
                EXPECT_LE(want, 1 + 1e-4);
                EXPECT_LE(got.mean, 1 + 3e-3);
                EXPECT_NEAR(got.mean, want, std::max(3e-3 * want, 3 * got.error));
            }
}

}  // namespace
}  // namespace kinora
