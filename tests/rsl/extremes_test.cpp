// tests/rsl/extremes_test.cpp: the numerical cases of docs/numerics.md that belong to
// the language: on every target, with operands that are known when the shader
// is compiled, that are uniform and that differ between points, and in the reference.
#include <gtest/gtest.h>

#include <optional>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "jit/target.h"
#include "tests/rsl/differential.h"

namespace kinora::rsl {
namespace {

constexpr float kPi = 3.14159265f;
const float kNan = std::nanf("");

// Denormals are 0, going in and coming out, for its scope.
class FlushDenormals {
  public:
    FlushDenormals() : saved_(mode()) { set_mode(saved_ | kFlush); }
    ~FlushDenormals() { set_mode(saved_); }

  private:
#if defined(__x86_64__)
    static constexpr uint64_t kFlush = 0x8040;  // FTZ, DAZ
    static uint64_t mode() {
        return _mm_getcsr();
    }
    static void set_mode(uint64_t bits) {
        _mm_setcsr(uint32_t(bits));
    }
#else
    static constexpr uint64_t kFlush = 1 << 24;  // FPCR.FZ
    static uint64_t mode() {
        uint64_t bits;
        asm volatile("mrs %0, fpcr" : "=r"(bits));
        return bits;
    }
    static void set_mode(uint64_t bits) {
        asm volatile("msr fpcr, %0" : : "r"(bits));
    }
#endif
    uint64_t saved_;
};

struct Operands {
    float x = 0, y = 0, z = 0;
};

using Kind = ParamBinding::Kind;

RunShader shader_of(const std::string& body, const Operands& o, Kind kind, const char* target,
                    bool fast = false) {
    std::vector<ParamBinding> params;
    const float values[] = {o.x, o.y, o.z};
    for (size_t k = 0; k < 3; ++k)
        params.push_back({std::string(1, "xyz"[k]), kind, {values[k]}, {}});
    LowerOptions options;
    if (fast) options.math = jit::math::Tier::Fast;
    const char* detail = kind == Kind::Varying ? "varying" : "uniform";
    return RunShader(
        "surface t(" + std::string(detail) + " float x = 0, y = 0, z = 0;) { " + body + " }",
        options, params, false, target);
}

void set_operands(std::map<std::string, std::vector<float>>& inputs, const Operands& o) {
    inputs["param:0:x"] = {o.x}, inputs["param:0:y"] = {o.y}, inputs["param:0:z"] = {o.z};
}

// Values of the expression, a float over x, y and z: all that there are ways to compute it.
std::vector<float> ways(const std::string& expression, const Operands& o) {
    std::vector<float> values;
    std::string body = "Ci = color(float(" + expression + "));";
    for (Kind kind : {Kind::Constant, Kind::Frame, Kind::Varying}) {
        for (const jit::Target& target : jit::targets()) {
            if (!target.supported()) continue;
            RunShader run = shader_of(body, o, kind, target.name);
            EXPECT_TRUE(run.ok()) << run.findings();
            if (!run.ok()) return {kNan};
            set_operands(run.inputs, o);
            values.push_back(run.value("Ci.r"));
        }
        RunShader run = shader_of(body, o, kind, "interp");
        ReferenceInputs inputs;
        Columns columns;
        set_operands(columns, o);
        inputs = at_point(columns, {}, 0);
        std::vector<ParamBinding> params;
        for (size_t k = 0; k < 3; ++k)
            params.push_back({std::string(1, "xyz"[k]),
                              kind,
                              {k == 0   ? o.x
                               : k == 1 ? o.y
                                        : o.z},
                              {}});
        Layer layer{run.shaders.back().get(), params};
        values.push_back(float(run_reference<float>({&layer, 1}, inputs).values.at("Ci.r")));
    }
    return values;
}

void expect(const std::string& expression, const Operands& o, float wanted, float tolerance = 0) {
    for (float got : ways(expression, o))
        EXPECT_NEAR(got, wanted, tolerance)
            << expression << " for x=" << o.x << " y=" << o.y << " z=" << o.z;
}

void expect_between(const std::string& expression, const Operands& o, float low, float high) {
    for (float got : ways(expression, o)) {
        EXPECT_GE(got, low) << expression << " for x=" << o.x << " y=" << o.y;
        EXPECT_LE(got, high) << expression << " for x=" << o.x << " y=" << o.y;
    }
}

TEST(Extremes, PowOfANegativeToAFractionIs0) {
    expect("pow(x, y)", {-2, 0.5f}, 0);
}
TEST(Extremes, PowOfANegativeToAWholeNumberIsExact) {
    expect("pow(x, y)", {-2, 3}, -8, 1e-6f);
    expect("pow(x, y)", {-2, 2}, 4, 1e-6f);
}
TEST(Extremes, PowOf0) {
    expect("pow(x, y)", {0, 0}, 1);
    expect("pow(x, y)", {0, -1}, 0);
}
TEST(Extremes, DivisionByNearlyNothingIs0) {
    expect("x / y", {0, 0}, 0);
    expect("x / y", {3, 0}, 0);
    expect("x / y", {1, 1e-40f}, 0);
    expect("x / y", {1, 1e-37f}, 1 / 1e-37f, 1e31f);
}
TEST(Extremes, RootsOfNegativesAre0) {
    expect("sqrt(x)", {-1e-9f}, 0);
    expect("inversesqrt(x)", {0}, 0);
    expect("inversesqrt(x)", {-1}, 0);
}
TEST(Extremes, LogOf0AndBelowIsThatOfTheLeastFloat) {
    expect("log(x)", {0}, -87.3365448f, 1e-5f);
    expect("log(x)", {-1}, -87.3365448f, 1e-5f);
}
TEST(Extremes, ArcsClampTheirArgument) {
    expect("acos(x)", {1 + 1e-6f}, 0);
    expect("asin(x)", {-2}, -kPi / 2, 1e-6f);
}
TEST(Extremes, AtanOf0And0) {
    expect("atan(x, y)", {0, 0}, 0);
}
TEST(Extremes, ModHasTheSignOfTheDivisor) {
    expect("mod(x, y)", {-0.25f, 1}, 0.75f);
    expect("mod(x, y)", {5, -3}, -1);
}
TEST(Extremes, ModBy0Is0) {
    expect("mod(x, y)", {5, 0}, 0);
    // By x - y floor(x / y); -1 would be just below infinity: 0, as what rounds to a finite y is.
    expect("mod(x, y)", {5, HUGE_VALF}, 5);
    expect("mod(x, y)", {-1, HUGE_VALF}, 0);
    expect("mod(x, y)", {-1, -HUGE_VALF}, -1);
}
TEST(Extremes, ModOfSomethingHugeStaysBelowTheDivisor) {
    expect_between("mod(x, y)", {1e20f, 0.1f}, 0, 0.0999999940f);
}
TEST(Extremes, SmoothstepOfEqualEdgesIsAStep) {
    expect("smoothstep(x, x, y)", {0.5f, 0.4f}, 0);
    expect("smoothstep(x, x, y)", {0.5f, 0.5f}, 1);
}
TEST(Extremes, SmoothstepReversedAsksForTheFirstEdgeFirst) {
    expect("smoothstep(x, y, z)", {1, 0, 0.5f}, 0);
    expect("smoothstep(x, y, z)", {1, 0, 2}, 1);
}
TEST(Extremes, StepAtItsEdgeIs1) {
    expect("step(x, x)", {0.3f}, 1);
}
// Not OSL's min(max(x, min), max): RISpec asks for the lower limit first, and the marches of volume
// shaders (d += clamp(step, least, end - d)) end only so.
TEST(Extremes, ClampWithLimitsReversed) {
    expect("clamp(x, y, z)", {0.5f, 1, 0}, 1);
    expect("clamp(x, y, z)", {1.5f, 1, 0}, 0);
    expect("clamp(x, y, z)", {1, 1, 0}, 0);
}
TEST(Extremes, NormalizeOf0TinyAndHuge) {
    for (float size : {0.0f, 1e-30f, 1e30f})
        expect("length(normalize(vector(x, x, x)))", {size}, size == 0 ? 0 : 1, 3e-7f);
}
TEST(Extremes, LengthOfAHugeVector) {
    expect("length(vector(x, x, x)) / 1e20", {1e20f}, 1.7320508f, 3e-7f);
}
TEST(Extremes, RefractAtTotalReflectionIs0) {
    expect("length(refract(normalize(vector(1, 0, x)), vector(0, 0, 1), y))", {-0.1f, 1.5f}, 0);
}
TEST(Extremes, FresnelAtItsLimitsReflectsAll) {
    const char* setup =
        "float kr, kt; vector R, T; fresnel(vector(x, 0, y), vector(0, 0, 1), z, kr,"
        " kt, R, T); ";
    auto all = [&](const Operands& o) {
        for (const char* what : {"kr", "1 - kt", "1 - length(T)"})
            for (Kind kind : {Kind::Constant, Kind::Varying})
                for (const jit::Target& target : jit::targets()) {
                    if (!target.supported()) continue;
                    RunShader run =
                        shader_of(setup + std::string("Ci = ") + what + ";", o, kind, target.name);
                    ASSERT_TRUE(run.ok()) << run.findings();
                    set_operands(run.inputs, o);
                    EXPECT_EQ(run.value("Ci.r"), 1) << what << " " << target.name;
                }
    };
    all({1, 0, 1.5f});             // grazing
    all({0.9f, -0.43589f, 1.5f});  // total reflection
    all({0, -1, 0});               // eta 0
}
TEST(Extremes, ReflectTakesNAsItIs) {
    expect("zcomp(reflect(vector(0, 0, x), vector(0, 0, y)))", {-1, 2}, 7);  // I - 2 (I.N) N
}
TEST(Extremes, FaceforwardWithoutASideReturnsN) {
    expect("zcomp(faceforward(vector(0, 0, 1), vector(x, 0, 0), vector(0, 0, y)))", {1, 1}, 1);
}
TEST(Extremes, SplineClampsItsPlace) {
    expect("spline(x, 9, 1, 2, 9)", {-3}, 1);
    expect("spline(x, 9, 1, 2, 9)", {7}, 2);
    expect("spline(x, 9, 1, 2, 9)", {kNan}, 1);
}
TEST(Extremes, SplineWithTooFewKnotsIsAnError) {
    for (const char* call : {"spline(s, 1, 2, 3)", "spline(\"bezier\", s, 1, 2, 3, 4, 5)"}) {
        RunShader run("surface t() { Ci = " + std::string(call) + "; }");
        EXPECT_FALSE(run.ok());
        EXPECT_FALSE(run.findings().empty());
    }
}
TEST(Extremes, NoiseOnTheLatticeIsAHalf) {
    expect("noise(x)", {7}, 0.5f);
    expect("noise(x, y)", {-3, 12}, 0.5f);
    expect("noise(point(x, y, z))", {3, -2, 5}, 0.5f);
    expect("noise(point(x, y, z), x)", {3, -2, 5}, 0.5f);
}
TEST(Extremes, NoiseFarOutAndOfNoNumberIsFinite) {
    for (float x : {1e9f, 3e9f, -1e9f, 1e30f, HUGE_VALF, -HUGE_VALF, kNan})
        for (const char* call : {"noise(x)", "noise(x, y)", "noise(point(x, y, x))", "cellnoise(x)",
                                 "cellnoise(point(x, y, x))", "pnoise(x, 7)"})
            expect_between(call, {x, 0.3f}, 0, 1);
}
TEST(Extremes, CellnoiseTakesTheFloor) {
    expect("cellnoise(x) - cellnoise(y)", {-0.5f, -1}, 0);
    expect("cellnoise(x) - cellnoise(y)", {-0.0f, 0}, 0);
}
TEST(Extremes, PnoiseOfPeriod0HasPeriod1) {
    expect("pnoise(x, y) - pnoise(x + 1, y)", {0.3f, 0}, 0, 1e-6f);
    expect("pnoise(x, y) - pnoise(x, z)", {0.3f, 0, 1}, 0);
}
TEST(Extremes, IndicesClampWithOneFaultALine) {
    std::string body = "float a[3] = {5, 6, 7}; Ci = a[x];";
    struct Case {
        float index, value;
    };
    for (Case c : {Case{-1, 5}, Case{3, 7}, Case{1e30f, 7}, Case{kNan, 5}, Case{1, 6}})
        for (const jit::Target& target : jit::targets()) {
            if (!target.supported()) continue;
            RunShader run = shader_of(body, {c.index}, Kind::Varying, target.name);
            ASSERT_TRUE(run.ok()) << run.findings();
            set_operands(run.inputs, {c.index});
            EXPECT_EQ(run.value("Ci.r"), c.value) << c.index << " " << target.name;
            EXPECT_EQ(run.faults, c.index == 1 ? 0 : 1) << c.index << " " << target.name;
        }
}
TEST(Extremes, LoopsEndAfterAMillionTurns) {
    for (const char* loop :
         {"while (1 > 0) Ci += 1;", "float k; for (k = 0; k < 1e9; k += 1) Ci = k;"})
        for (const jit::Target& target : jit::targets()) {
            if (!target.supported()) continue;
            RunShader run("surface t() { Ci = 0; " + std::string(loop) + " }", {}, {}, false,
                          target.name);
            ASSERT_TRUE(run.ok()) << run.findings();
            EXPECT_GT(run.value("Ci.r"), 999998) << target.name;
            EXPECT_EQ(run.faults, 1) << target.name;
        }
}
TEST(Extremes, MinusZero) {
    expect("x == y ? 1 : 0", {-0.0f, 0}, 1);
    expect("sign(x)", {-0.0f}, 0);
    expect("min(x, y) + max(x, y)", {-0.0f, 0}, 0);
}
TEST(Extremes, MinAndMaxTakeTheSecondOperandBesideNan) {
    expect("min(x, y)", {kNan, 2}, 2);
    expect("max(x, y)", {kNan, 2}, 2);
    for (float got : ways("min(x, y)", {2, kNan})) EXPECT_NE(got, got);
    for (float got : ways("max(x, y)", {2, kNan})) EXPECT_NE(got, got);
}
// Not a row of the list: the filters of filterstep against their integrals.
TEST(Filterstep, HasTheFiltersOfTheInterface) {
    for (const char* filter : {"box", "triangle", "gaussian", "catmull-rom"})
        for (float edge : {-0.2f, 0.05f, 0.3f, 0.5f, 0.77f, 1.1f}) {
            std::vector<float> got = ways(
                "filterstep(x, y, z, \"filter\", \"" + std::string(filter) + "\")", {edge, 0, 1});
            for (float value : got) EXPECT_NEAR(value, got.back(), 1e-3f) << filter << " " << edge;
        }
}
// A ramp of 4 beside the edge is 1/4 above it, of 2 not at all: the width of the direction counts.
TEST(Filterstep, TheWidthThatNamesItsDirectionCounts) {
    auto step = [](const std::string& pairs) {
        return "filterstep(x, y, z, \"width\", " + pairs + ")";
    };
    expect(step("2"), {1, -1, 1}, 0.25f);
    expect(step("1"), {1, -1, 1}, 0);
    expect(step("2, \"swidth\", 1"), {1, -1, 1}, 0);
    expect(step("1, \"swidth\", 2"), {1, -1, 1}, 0.25f);
    expect("filterstep(x, y, z, \"swidth\", 2, \"width\", 9)", {1, -1, 1}, 0.25f);
}
// In the mode that fast kernels run in (docs/decisions.md#exact-arithmetic); precise ones keep
// denormals.
TEST(Extremes, DenormalsAre0InTheFastTierOnly) {
    for (bool fast : {true, false})
        for (const char* body :
             {"Ci = x * 1e30;", "Ci = (x + x) * 1e30;", "Ci = 1e-30 * z * 1e30;"})
            for (const jit::Target& target : jit::targets()) {
                if (!target.supported()) continue;
                Operands o{1e-40f, 0, 1e-10f};
                RunShader run = shader_of(body, o, Kind::Varying, target.name, fast);
                ASSERT_TRUE(run.ok()) << run.findings();
                set_operands(run.inputs, o);
                std::optional<FlushDenormals> flush;
                if (fast) flush.emplace();
                EXPECT_EQ(run.value("Ci.r") == 0, fast) << body << " " << target.name;
            }
}
TEST(Extremes, GreyHasHue0) {
    for (const char* space : {"hsv", "hsl"}) {
        std::string call = "comp(ctransform(\"" + std::string(space) + "\", color(x, x, x)), ";
        for (float grey : {0.0f, 0.5f, 1.0f}) {
            expect(call + "0)", {grey}, 0);
            expect(call + "1)", {grey}, 0);
        }
    }
}
TEST(Extremes, DerivativesOfConstantsAndStepsAre0) {
    expect("Du(x) + Dv(3)", {2}, 0);
    expect("Du(step(x, u))", {0}, 0);
    expect("Du(floor(u * x))", {5}, 0);
}

// A light where it shines: RSL's division gives 0 for 1 / 0. A cone of angle 0 is its axis alone,
// one of PI or more is all directions.
TEST(Extremes, LightsAtTheirPlaceAndConesAtTheirLimitsAreFinite) {
    const char* lit = "light l(varying float x = 0, y = 0, z = 0;) { ";
    struct Case {
        const char* body;
        Operands at;
        float wanted;
    };
    const Case kCases[] = {
        {"illuminate(point(x, y, 0)) Cl = 1 / (L . L);", {0, 0}, 0},
        {"illuminate(point(x, y, 0)) Cl = 1 / (L . L);", {0, 2}, 0.25f},
        {"illuminate(point(x, y, 0), vector(0, -1, 0), z) Cl = 1;", {0, 2, 0}, 1},
        {"illuminate(point(x, y, 0), vector(0, -1, 0), z) Cl = 1;", {1, 2, 0}, 0},
        {"illuminate(point(x, y, 0), vector(0, 1, 0), z) Cl = 1;", {0, 2, 0}, 0},
        {"illuminate(point(x, y, 0), vector(0, 1, 0), z) Cl = 1;", {0, 2, kPi}, 1},
        {"illuminate(point(x, y, 0), vector(0, 1, 0), z) Cl = 1;", {1, 2, 7}, 1},
    };
    for (const Case& c : kCases)
        for (const jit::Target& target : jit::targets()) {
            if (!target.supported()) continue;
            std::vector<ParamBinding> params;
            for (const char* name : {"x", "y", "z"})
                params.push_back({name, Kind::Varying, {0}, {}});
            RunShader run(lit + std::string(c.body) + " }", {}, params, false, target.name);
            ASSERT_TRUE(run.ok()) << run.findings();
            set_operands(run.inputs, c.at);
            EXPECT_EQ(run.value("light:0:Cl.r"), c.wanted) << c.body << " " << target.name;
        }
}

}  // namespace
}  // namespace kinora::rsl
