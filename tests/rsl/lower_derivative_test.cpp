// tests/rsl/lower_derivative_test.cpp: Du, Dv, area and calculatenormal of what shaders compute.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/rsl/run_shader.h"

namespace kinora::rsl {
namespace {

// A plane with P = (u, v, 0), s = u.
struct OnPlane : RunShader {
    explicit OnPlane(const std::string& source, bool stack = false)
        : RunShader(source, {}, {}, stack) {
        EXPECT_TRUE(ok()) << findings();
        set3("dPdu", 1, 0, 0);
        set3("dPdv", 0, 1, 0);
        set3("N", 0, 0, 1);
        set3("Ng", 0, 0, 1);
        set("u", 0.25f);
        set("s", 3);
        set("dsdu", 1);
        set("du", 0.5f);
        set("dv", 0.25f);
    }
};

TEST(LowerDerivative, FollowsTheChainRule) {
    OnPlane shader(
        "surface t() { Ci = color(Du(u), Dv(u), Du(s * s)); Oi = "
        "color(Deriv(s * s, u), area(P), Du(sin(s))); }");
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 1);
    EXPECT_EQ(out["Ci.g"][0], 0);
    EXPECT_EQ(out["Ci.b"][0], 6);
    EXPECT_EQ(out["Oi.r"][0], 6);
    EXPECT_EQ(out["Oi.g"][0], 0.125f);
    EXPECT_NEAR(out["Oi.b"][0], std::cos(3.0), 1e-6);
}

TEST(LowerDerivative, BranchesGiveTheTakenSide) {
    OnPlane shader(
        "surface t() { float x; if (s > 2) x = 2 * s; else x = 7 * s; float i; "
        "for (i = 0; i < 3; i += 1) x *= 2; Ci = Du(x); }");
    EXPECT_EQ(shader.value("Ci.r"), 16);
}

TEST(LowerDerivative, DisplacedNormalsTilt) {
    OnPlane shader(
        "displacement d() { N = calculatenormal(P + 0.5 * u * N); } surface t() "
        "{ normal n = normalize(N); Ci = color(xcomp(n), ycomp(n), zcomp(n)); }",
        true);
    auto out = shader.run();
    // The slope is 1/2 along u.
    EXPECT_FLOAT_EQ(out["Ci.r"][0], -0.5f / std::sqrt(1.25f));
    EXPECT_FLOAT_EQ(out["Ci.b"][0], 1 / std::sqrt(1.25f));
}

TEST(LowerDerivative, CalculatednormalTakesItsSideFromNg) {
    OnPlane shader("surface t() { Ci = color(zcomp(calculatenormal(P)), 0, 0); }");
    EXPECT_EQ(shader.value("Ci.r"), 1);
    shader.set3("Ng", 0, 0, -1);
    EXPECT_EQ(shader.value("Ci.r"), -1);
}

// A displacement that only bends normals shows no faces of a smooth mesh: where N leans, so does
// what is made of P. N is along n = (3/5, 0, 4/5); without and with a height of v / 2 over it.
TEST(LowerDerivative, BumpsBendTheNormalThatIsInterpolated) {
    for (bool bumped : {false, true}) {
        std::string P = bumped ? "P + 0.5 * v * normalize(N)" : "P";
        OnPlane shader("displacement d() { N = calculatenormal(" + P +
                           "); } surface t() { normal n = normalize(N);"
                           " Ci = color(xcomp(n), ycomp(n), zcomp(n)); }",
                       true);
        shader.set3("N", 1.2f, 0, 1.6f);
        auto out = shader.run();
        // Slopes (1, 0, 0) - n 3/5 and (0, 1, 0) [+ n / 2]: their product is n 4/5 [- (0, 2/5, 0)].
        double length = bumped ? std::sqrt(0.64 + 0.16) : 0.8;
        EXPECT_NEAR(out["Ci.r"][0], 0.48 / length, 1e-6);
        EXPECT_NEAR(out["Ci.g"][0], bumped ? -0.4 / length : 0, 1e-6);
        EXPECT_NEAR(out["Ci.b"][0], 0.64 / length, 1e-6);
    }
}

// A flat map of heights leaves the normal that it is given; one that rises by 1 over s tilts it.
TEST(LowerDerivative, BumpBendsTheNormalGiven) {
    for (float rise : {0.0f, 1.0f}) {
        OnPlane shader(
            "surface t() { normal n = normalize(bump(\"a\", N, dPdu, dPdv, u, v));"
            " Ci = color(xcomp(n), ycomp(n), zcomp(n)); }");
        static float slope;
        slope = rise;
        shader.services[Service::texture] = [](const jit::ServiceCall& call) {
            for (int k = 0; k < jit::kMaxLanes; ++k)
                call.results[k] = slope * call.args[2 * jit::kMaxLanes + k];
        };
        shader.set3("N", 1.2f, 0, 1.6f);
        auto out = shader.run();
        // n + rise (n ^ dPdv), n = (3/5, 0, 4/5): n ^ (0, 1, 0) = (-4/5, 0, 3/5).
        double length = std::sqrt(1.0 + rise);
        EXPECT_NEAR(out["Ci.r"][0], (0.6 - 0.8 * rise) / length, 1e-5);
        EXPECT_NEAR(out["Ci.g"][0], 0, 1e-6);
        EXPECT_NEAR(out["Ci.b"][0], (0.8 + 0.6 * rise) / length, 1e-5);
    }
}

TEST(LowerDerivative, SurfacesSeeTheFacesOfP) {
    OnPlane shader("surface t() { Ci = color(zcomp(calculatenormal(P)), Du(xcomp(P)), area(P)); }");
    shader.set3("N", 1.2f, 0, 1.6f);
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 1);
    EXPECT_EQ(out["Ci.g"][0], 1);
    EXPECT_EQ(out["Ci.b"][0], 0.125f);
}

// docs/decisions.md#dual-numbers: texture and environment return their gradients.
TEST(LowerDerivative, MapsHaveDerivatives) {
    auto shows_coordinate = [](const jit::ServiceCall& call) {
        for (int k = 0; k < jit::kMaxLanes; ++k) {
            call.results[k] = call.args[2 * jit::kMaxLanes + k];
            call.results[jit::kMaxLanes + k] = 3 * call.args[3 * jit::kMaxLanes + k];
        }
    };
    OnPlane shader(
        "surface t() { color a = texture(\"a\", 2 * s, v + s), e = environment(\"e\", P + 4 * v * "
        "N);"
        " color u = Du(a), w = Dv(a); Ci = color(comp(u, 0), comp(u, 1), comp(w, 1));"
        " Oi = color(comp(Du(e), 0), comp(Dv(e), 1), comp(Dv(e), 0)); }");
    shader.services[Service::texture] = shader.services[Service::environment] = shows_coordinate;
    auto out = shader.run();
    EXPECT_NEAR(out["Ci.r"][0], 2, 1e-5);
    EXPECT_NEAR(out["Ci.g"][0], 3, 1e-5);
    EXPECT_NEAR(out["Ci.b"][0], 3, 1e-5);
    EXPECT_NEAR(out["Oi.r"][0], 1, 1e-5);
    EXPECT_NEAR(out["Oi.g"][0], 3, 1e-5);
    EXPECT_NEAR(out["Oi.b"][0], 0, 1e-5);
}

// docs/decisions.md#dual-numbers: the slope of a normal is that of the N that came in.
TEST(LowerDerivative, CalculatednormalCarriesTheSlopeOfN) {
    OnPlane shader(
        "surface t() { normal n = 2 * calculatenormal(P + u * N); Ci = color(Du(n)); "
        "Oi = color(Dv(n)); N = 0; }");
    shader.set3("dNdu", 0.25f, 0.5f, 0.75f);
    shader.set3("dNdv", -1, -2, -3);
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 0.5f);
    EXPECT_EQ(out["Ci.b"][0], 1.5f);
    EXPECT_EQ(out["Oi.r"][0], -2);
    EXPECT_EQ(out["Oi.g"][0], -4);
}

TEST(LowerDerivative, FilterstepSpansThePixel) {
    OnPlane shader(
        "surface t() { Ci = color(filterstep(3, s), filterstep(2, s), "
        "filterstep(3.125, s)); }");
    auto out = shader.run();
    EXPECT_FLOAT_EQ(out["Ci.r"][0], 0.5f);
    EXPECT_FLOAT_EQ(out["Ci.g"][0], 1);
    EXPECT_FLOAT_EQ(out["Ci.b"][0], 0.25f);
}

TEST(LowerDerivative, TexturesGetTheirFootprint) {
    OnPlane shader("surface t() { Ci = color texture(\"a\", 2 * s, v); }");
    shader.services[Service::texture] = [](const jit::ServiceCall& call) {
        for (int k = 0; k < jit::kMaxLanes; ++k) {
            call.results[k] = call.args[4 * jit::kMaxLanes + k];                       // dsdx
            call.results[jit::kMaxLanes + k] = call.args[7 * jit::kMaxLanes + k];      // dtdy
            call.results[2 * jit::kMaxLanes + k] = call.args[2 * jit::kMaxLanes + k];  // s
        }
    };
    auto out = shader.run();
    EXPECT_EQ(out["Ci.r"][0], 1);      // 2 ds/du du
    EXPECT_EQ(out["Ci.g"][0], 0.25f);  // dv/dv dv
    EXPECT_EQ(out["Ci.b"][0], 6);
}

}  // namespace
}  // namespace kinora::rsl
