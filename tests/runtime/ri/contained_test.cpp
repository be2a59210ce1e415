// tests/runtime/ri/contained_test.cpp: no exception reaches a C program.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <new>
#include <thread>

#include "runtime/base/check.h"
#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {
namespace {

class ThrowingSink : public CallSink {
  public:
    void call(const Call& call) override {
        if (call.request == Request::Identity) CHECK_EQ(1, 2);
        if (call.request == Request::FrameEnd) throw std::bad_alloc();
    }
    bool transform_points(std::string_view, std::string_view, std::span<float>) override {
        throw std::bad_alloc();
    }
};

struct Told {
    int code = 0, severity = 0, count = 0;
};
Told told;
void keep(RtInt code, RtInt severity, char*) {
    told = {code, severity, told.count + 1};
}

class Contained : public testing::Test {
  protected:
    void SetUp() override {
        told = {};
        context_.for_c_program = true;
        context_.handler = keep;
        Context::make_current(&context_);
    }
    void TearDown() override { Context::make_current(nullptr); }

    Diagnostics diagnostics_;
    Context context_{std::make_unique<ThrowingSink>(), diagnostics_};
};

TEST_F(Contained, AFailedCheckIsABug) {
    RiIdentity();
    EXPECT_EQ(told.code, RIE_BUG);
    EXPECT_EQ(told.severity, RIE_ERROR);
    EXPECT_EQ(told.count, 1);
    EXPECT_EQ(RiLastError, RIE_BUG);
}

TEST_F(Contained, MissingMemoryIsTold) {
    RiFrameEnd();
    EXPECT_EQ(told.code, RIE_NOMEM);
    RtPoint point = {0, 0, 0};
    told = {};
    EXPECT_EQ(RiTransformPoints(RI_NULL, RI_NULL, 1, &point), nullptr);
    EXPECT_GT(told.count, 0);
}

TEST_F(Contained, IsNotDoneForReadersOfFiles) {
    context_.for_c_program = false;
    EXPECT_THROW(RiIdentity(), CheckFailed);
}

TEST_F(Contained, FindingsOfTheSinkAreToldOnce) {
    RiFrameBegin(1);
    EXPECT_EQ(told.count, 0);
    RiIdentity();
    RiFrameBegin(2);
    EXPECT_EQ(told.count, 1);
}

class SilentSink : public CallSink {
  public:
    void call(const Call&) override {}
};

std::unique_ptr<Context> begun(Diagnostics& diagnostics) {
    auto context = std::make_unique<Context>(std::make_unique<SilentSink>(), diagnostics);
    context->for_c_program = true;
    Context::make_current(context.get());
    return context;
}

TEST(Contexts, ThatEndOnAnotherThreadAreNobodysAfterwards) {
    Diagnostics diagnostics;
    std::unique_ptr<Context> context = begun(diagnostics);
    EXPECT_EQ(Context::current(), context.get());
    std::thread other([&] {
        Context::make_current(context.get());
        context.reset();
        EXPECT_EQ(Context::current(), nullptr);
    });
    other.join();
    EXPECT_EQ(Context::current(), nullptr);
    RiIdentity();
    EXPECT_EQ(RiLastError, RIE_NOTSTARTED);
}

TEST(Contexts, PrintAtMostTwoHundredFindingsOfACode) {
    Diagnostics diagnostics;
    std::unique_ptr<Context> context = begun(diagnostics);
    context->handler = RiErrorPrint;
    testing::internal::CaptureStderr();
    for (int i = 0; i < 1000; ++i) RiTransform(nullptr);
    RiSides(1);
    RiDeclare(const_cast<char*>("a"), const_cast<char*>("nothing"));
    context->tell_unprinted();
    std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(printed, '\n'), 200 + 1 + 1);
    EXPECT_NE(printed.find("800 more findings"), std::string::npos);
}

TEST(Contexts, TellAHandlerOfTheProgramsOwnAllFindings) {
    Diagnostics diagnostics;
    std::unique_ptr<Context> context = begun(diagnostics);
    context->handler = keep;
    told = {};
    for (int i = 0; i < 1000; ++i) RiTransform(nullptr);
    EXPECT_EQ(told.count, 1000);
}

}  // namespace
}  // namespace kinora::ri
