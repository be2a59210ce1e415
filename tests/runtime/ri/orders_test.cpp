// tests/runtime/ri/orders_test.cpp: calls in any order, with arguments of any kind, end in errors.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "ri.h"

namespace {

int told = 0;
void count_errors(RtInt, RtInt, char* message) {
    EXPECT_NE(message, nullptr);
    ++told;
}
void end_inside(RtInt, RtInt, char*) {
    RiEnd();
}

// Arguments, most of them sound. Arrays are as long as the largest count that is given.
class Arguments {
  public:
    explicit Arguments(uint32_t seed) : random_(seed) {}

    int below(int count) { return int(random_() % uint32_t(count)); }
    bool seldom() { return below(8) == 0; }
    RtFloat real() {
        constexpr RtFloat kReals[] = {0, 1, -1, 0.5f, 3, 90, 1e-20f, RI_INFINITY, -RI_INFINITY};
        return seldom() ? kReals[below(9)] : RtFloat(below(200) - 50) / 50;
    }
    RtInt count() { return seldom() ? -below(100) : below(5); }
    RtToken token() {
        static const char* const kTokens[] = {"P",
                                              "Pw",
                                              "Cs",
                                              "Kd",
                                              "matte",
                                              "bicubic",
                                              "",
                                              "uniform float x",
                                              "linear",
                                              "cubic",
                                              "nonperiodic",
                                              "periodic",
                                              "bilinear",
                                              "world",
                                              "camera",
                                              "catmull-clark",
                                              "rgba",
                                              "vertex color[2] y",
                                              "plastic",
                                              "rib"};
        return below(10) == 0 ? nullptr : const_cast<char*>(kTokens[below(20)]);
    }
    RtFloat* reals() {
        if (seldom()) return nullptr;
        for (RtFloat& value : reals_) value = real();
        return reals_;
    }
    // Numbers of points or their indices.
    RtInt* integers() {
        if (seldom()) return nullptr;
        for (RtInt& value : integers_) value = below(40) == 0 ? -1 : below(4);
        return integers_;
    }
    RtMatrix* matrix() { return reinterpret_cast<RtMatrix*>(reals()); }
    RtPointer handle() {
        if (handles_.empty() || seldom()) return RtPointer(uintptr_t(random_()));
        return handles_[size_t(below(int(handles_.size())))];
    }
    void keep(RtPointer handle) { handles_.push_back(handle); }

    // A parameter list: values that serve as any type.
    RtInt pairs() {
        for (int i = 0; i < 2; ++i) {
            tokens[i] = i == 0 ? const_cast<char*>("P") : real_token();
            values[i] = reals();
        }
        return count() % 3;
    }
    RtToken tokens[2];
    RtPointer values[2];

  private:
    // None of strings, which numbers are not.
    RtToken real_token() {
        static const char* const kTokens[] = {"Pw", "Cs", "Kd", "uniform float x", "st", "N"};
        return below(10) == 0 ? nullptr : const_cast<char*>(kTokens[below(6)]);
    }

    std::minstd_rand random_;
    RtFloat reals_[4096];
    RtInt integers_[512];
    std::vector<RtPointer> handles_;
};

RtVoid subdivide(RtPointer data, RtFloat) {
    if (data) RiSphere(1, -1, 1, 360, RI_NULL);
    RiEnd();  // of its caller: legal, if unkind
}

using A = Arguments;
using Calls = std::vector<std::function<void(A&)>>;

const Calls& block_calls() {
    static const Calls calls = {
        [](A& a) { RiFrameBegin(a.count()); },
        [](A&) { RiFrameEnd(); },
        [](A&) { RiWorldBegin(); },
        [](A&) { RiWorldEnd(); },
        [](A&) { RiAttributeBegin(); },
        [](A&) { RiAttributeEnd(); },
        [](A&) { RiTransformBegin(); },
        [](A&) { RiTransformEnd(); },
        [](A& a) { RiSolidBegin(a.token()); },
        [](A&) { RiSolidEnd(); },
        [](A& a) { a.keep(RiObjectBegin()); },
        [](A&) { RiObjectEnd(); },
        [](A& a) { RiObjectInstance(a.handle()); },
        [](A& a) { RiMotionBeginV(a.count(), a.reals()); },
        [](A&) { RiMotionBegin(2, 0.0, 1.0); },
        [](A&) { RiMotionEnd(); },
        [](A& a) { a.keep(RiArchiveBegin(a.token(), RI_NULL)); },
        [](A&) { RiArchiveEnd(); },
        [](A& a) { RiReadArchive(a.token(), nullptr, RI_NULL); },
        [](A& a) { RiIfBegin(a.token(), RI_NULL); },
        [](A& a) { RiElseIf(a.token(), RI_NULL); },
        [](A&) { RiElse(); },
        [](A&) { RiIfEnd(); },
        [](A& a) { a.keep(RiGetContext()); },
        [](A& a) { RiContext(a.handle()); },
        [](A& a) {
            RiErrorHandler(a.seldom() ? nullptr : a.seldom() ? end_inside : count_errors);
        },
        [](A& a) { RiArchiveRecord(a.token(), const_cast<char*>("%d"), 1); },
        [](A& a) { RiDeclare(a.token(), a.token()); },
    };
    return calls;
}

const Calls& state_calls() {
    static const Calls calls = {
        [](A& a) { RiFormat(a.count() + 4, a.count() + 4, a.real()); },
        [](A& a) { RiScreenWindow(a.real(), a.real(), a.real(), a.real()); },
        [](A& a) { RiCropWindow(a.real(), a.real(), a.real(), a.real()); },
        [](A& a) { RiProjectionV(a.token(), a.pairs(), a.tokens, a.values); },
        [](A& a) { RiClipping(a.real(), a.real()); },
        [](A& a) { RiDepthOfField(a.real(), a.real(), a.real()); },
        [](A& a) { RiShutter(a.real(), a.real()); },
        [](A&) { RiPixelSamples(1, 1); },
        [](A& a) { RiPixelFilter(a.seldom() ? nullptr : RiSincFilter, a.real(), a.real()); },
        [](A& a) { RiExposure(a.real(), a.real()); },
        [](A& a) { RiImagerV(a.token(), a.pairs(), a.tokens, a.values); },
        [](A& a) { RiQuantize(a.token(), a.count(), a.count(), a.count(), a.real()); },
        [](A& a) { RiDisplay(a.token(), a.token(), a.token(), RI_NULL); },
        [](A& a) { RiColorSamples(a.count(), a.reals(), a.reals()); },
        [](A& a) { RiOptionV(a.token(), a.pairs(), a.tokens, a.values); },
        [](A& a) { RiColor(a.reals()); },
        [](A& a) { RiOpacity(a.reals()); },
        [](A& a) { a.keep(RiLightSourceV(a.token(), a.pairs(), a.tokens, a.values)); },
        [](A& a) { a.keep(RiAreaLightSource(a.token(), RI_NULL)); },
        [](A& a) { RiIlluminate(a.handle(), RtBoolean(a.count())); },
        [](A& a) { RiSurfaceV(a.token(), a.pairs(), a.tokens, a.values); },
        [](A& a) { RiDisplacement(a.token(), RI_NULL); },
        [](A& a) { RiAtmosphere(a.token(), RI_NULL); },
        [](A& a) { RiShaderLayer(a.token(), a.token(), a.token(), RI_NULL); },
        [](A& a) { RiAttributeV(a.token(), a.pairs(), a.tokens, a.values); },
        [](A& a) { RiBound(a.reals()); },
        [](A& a) { RiDetail(a.reals()); },
        [](A& a) { RiDetailRange(a.real(), a.real(), a.real(), a.real()); },
        [](A& a) { RiOrientation(a.token()); },
        [](A& a) { RiSides(a.count()); },
        [](A&) { RiIdentity(); },
        [](A& a) { RiTransform(*a.matrix()); },
        [](A& a) { RiConcatTransform(*a.matrix()); },
        [](A& a) { RiPerspective(a.real()); },
        [](A& a) { RiTranslate(a.real(), a.real(), a.real()); },
        [](A& a) { RiRotate(a.real(), a.real(), a.real(), a.real()); },
        [](A& a) { RiScale(a.real(), a.real(), a.real()); },
        [](A& a) { RiSkew(a.real(), a.real(), a.real(), a.real(), a.real(), a.real(), a.real()); },
        [](A& a) { RiCoordinateSystem(a.token()); },
        [](A& a) { RiCoordSysTransform(a.token()); },
        [](A& a) {
            RiTransformPoints(a.token(), a.token(), a.count(),
                              reinterpret_cast<RtPoint*>(a.reals()));
        },
        [](A& a) {
            RiMakeTexture(a.token(), a.token(), a.token(), a.token(), nullptr, 1, 1, RI_NULL);
        },
        [](A& a) { RiMakeShadow(a.token(), a.token(), RI_NULL); },
    };
    return calls;
}

const Calls& primitive_calls() {
    static const Calls calls = {
        [](A& a) { RiPolygonV(a.count(), a.pairs(), a.tokens, a.values); },
        [](A& a) { RiPolygonV(a.count(), a.count() % 3, nullptr, nullptr); },
        [](A& a) { RiGeneralPolygonV(a.count(), a.integers(), a.pairs(), a.tokens, a.values); },
        [](A& a) {
            RiPointsPolygonsV(a.count(), a.integers(), a.integers(), a.pairs(), a.tokens, a.values);
        },
        [](A& a) {
            RiPointsGeneralPolygonsV(a.count(), a.integers(), a.integers(), a.integers(), a.pairs(),
                                     a.tokens, a.values);
        },
        [](A& a) {
            RiBasis(*a.matrix(), a.count(), a.seldom() ? *a.matrix() : RiBSplineBasis, a.count());
        },
        [](A& a) { RiPatchV(a.token(), a.pairs(), a.tokens, a.values); },
        [](A& a) {
            RiPatchMeshV(a.token(), a.count() + 2, a.token(), a.count() + 2, a.token(), a.pairs(),
                         a.tokens, a.values);
        },
        [](A& a) {
            RiNuPatchV(a.count() + 2, a.count(), a.reals(), a.real(), a.real(), a.count() + 2,
                       a.count(), a.reals(), a.real(), a.real(), a.pairs(), a.tokens, a.values);
        },
        [](A& a) {
            RiTrimCurve(a.count(), a.integers(), a.integers(), a.reals(), a.reals(), a.reals(),
                        a.integers(), a.reals(), a.reals(), a.reals());
        },
        [](A& a) { RiSphere(a.real(), a.real(), a.real(), a.real(), RI_NULL); },
        [](A& a) {
            RiTorusV(a.real(), a.real(), a.real(), a.real(), a.real(), a.pairs(), a.tokens,
                     a.values);
        },
        [](A& a) { RiHyperboloid(a.reals(), a.reals(), a.real(), RI_NULL); },
        [](A& a) { RiPointsV(a.count(), a.pairs(), a.tokens, a.values); },
        [](A& a) {
            RiCurvesV(a.token(), a.count(), a.integers(), a.token(), a.pairs(), a.tokens, a.values);
        },
        [](A& a) {
            RiBlobbyV(a.count(), a.count(), a.integers(), a.count(), a.reals(), 0, nullptr,
                      a.pairs(), a.tokens, a.values);
        },
        [](A& a) {
            RiSubdivisionMeshV(a.token(), a.count(), a.integers(), a.integers(), 0, nullptr,
                               a.integers(), a.integers(), a.reals(), a.pairs(), a.tokens,
                               a.values);
        },
        [](A& a) { RiGeometry(a.token(), RI_NULL); },
        [](A& a) { RiProcedural(nullptr, a.reals(), a.seldom() ? subdivide : nullptr, nullptr); },
        [](A&) { RiProcDelayedReadArchive(nullptr, 1); },
    };
    return calls;
}

// Calls of a program, and RiEnd of all contexts that it leaves.
void run(uint32_t seed, RtToken name, int calls) {
    Arguments arguments(seed);
    std::vector<RtContextHandle> begun;
    const Calls* groups[] = {&block_calls(), &state_calls(), &primitive_calls()};
    RiErrorHandler(count_errors);
    for (int i = 0; i < calls; ++i) {
        if (i % 100 == 0 && arguments.below(3) > 0) {
            RiBegin(name);
            begun.push_back(RiGetContext());
            RiFormat(6, 6, 1);
            RiPixelSamples(1, 1);
            RiErrorHandler(count_errors);
        }
        if (arguments.below(100) == 0) RiEnd();
        const Calls& group = *groups[arguments.below(3)];
        group[size_t(arguments.below(int(group.size())))](arguments);
    }
    RiErrorHandler(count_errors);
    for (RtContextHandle handle : begun) {
        RiContext(handle);
        if (RiGetContext() == handle) RiErrorHandler(count_errors), RiEnd();
    }
    RiContext(RI_NULL);
}

// Pictures without a name are made in the current folder.
class Orders : public testing::Test {
  protected:
    void SetUp() override {
        told = 0;
        before_ = std::filesystem::current_path();
        std::filesystem::current_path(testing::TempDir());
    }
    void TearDown() override { std::filesystem::current_path(before_); }

  private:
    std::filesystem::path before_;
};

TEST_F(Orders, OfCallsThatRenderEndInErrors) {
    for (uint32_t seed = 1; seed <= 30; ++seed) run(seed, RI_NULL, 600);
    EXPECT_GT(told, 1000);
}

TEST_F(Orders, OfCallsThatWriteRibEndInErrors) {
    char ascii[] = "orders.rib", packed[] = "orders.rib.gz", nowhere[] = "no/such/folder/x.rib";
    for (uint32_t seed = 1; seed <= 60; ++seed)
        run(seed, seed % 3 == 0 ? ascii : seed % 3 == 1 ? packed : nowhere, 600);
    EXPECT_GT(told, 1000);
}

TEST_F(Orders, OutsideOfContextsEndInErrors) {
    Arguments arguments(7);
    RiErrorHandler(count_errors);
    for (const Calls* group : {&state_calls(), &primitive_calls()})
        for (const auto& call : *group) call(arguments);
    RiEnd();
    EXPECT_EQ(RiLastError, RIE_NOTSTARTED);
    EXPECT_GT(told, 50);
}

}  // namespace
