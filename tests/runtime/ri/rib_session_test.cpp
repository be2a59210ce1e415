// tests/runtime/ri/rib_session_test.cpp: calls written in each form of RIB are the same calls.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/ri/session.h"
#include "runtime/scene/ri/calls/outside.h"
#include "tests/runtime/scene/ri/recorded_calls.h"

namespace kinora::ri {
namespace {

std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

int errors = 0;
void count(RtInt, RtInt severity, char*) {
    errors += severity > RIE_INFO;
}

void option(const char* token, const char* value) {
    RtString values[] = {const_cast<char*>(value)};
    RiOption(const_cast<char*>("rib"), token, values, RI_NULL);
}

void draw() {
    RtColor color = {0.1f, 1.0f / 3, 1e-7f};
    RtPoint points[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1.5f, 1e20f}};
    RtFloat grain = 3;
    RiWorldBegin();
    RiDeclare(const_cast<char*>("grain"), const_cast<char*>("uniform float"));
    RiSurface(const_cast<char*>("wood"), "grain", &grain, RI_NULL);
    RtLightHandle light = RiLightSource(const_cast<char*>("distantlight"), RI_NULL);
    RiIlluminate(light, RI_FALSE);
    RiColor(color);
    RiBasis(RiBSplineBasis, 1, RiPowerBasis, 4);
    for (int i = 0; i < 20000; ++i) RiPolygon(3, "P", points, RI_NULL);
    RiWorldEnd();
}

class RibSessions : public testing::Test {
  protected:
    void SetUp() override { errors = 0; }

    // The file that calls make; `before`: of those that choose its form.
    template <class Before>
    std::string written(const std::string& name, const Before& before) {
        std::string file = testing::TempDir() + "/" + name;
        std::unique_ptr<Session> session = rib_session(file);
        session->context().for_c_program = true;
        session->context().handler = count;
        Context::make_current(&session->context());
        before();
        draw();
        session->finish();
        session->context().tell();
        return bytes_of(file);
    }
};

TEST_F(RibSessions, HaveTheSameCallsInEachForm) {
    std::string ascii = written("a.rib", [] {});
    std::string binary = written("b.rib", [] { option("format", "binary"); });
    std::string both = written("c.rib", [] {
        option("string format", "binary");
        option("string compression", "gzip");
    });
    std::string named = written("d.rib.gz", [] {});
    EXPECT_EQ(errors, 0);
    EXPECT_TRUE(ascii.starts_with("##RenderMan RIB"));
    EXPECT_NE(binary, ascii);
    EXPECT_LT(both.size(), binary.size());
    ReadCalls calls = read_calls(ascii);
    EXPECT_GT(calls.calls.size(), 20000u);
    for (const std::string& other : {binary, both, named})
        EXPECT_EQ(read_calls(other).calls, calls.calls);
}

TEST_F(RibSessions, TakeTheirFormBehindCommentsAndBeforeBlocks) {
    std::string binary = written("a.rib", [] {
        RiArchiveRecord(const_cast<char*>("comment"), const_cast<char*>("first"));
        option("format", "binary");
    });
    EXPECT_EQ(errors, 0);
    EXPECT_NE(binary.find("#first\n"), std::string::npos);
    std::string ascii = written("b.rib", [] {
        RiSides(1);
        option("format", "binary");
    });
    EXPECT_EQ(errors, 1);
    EXPECT_NE(ascii.find("\nSides 1\n"), std::string::npos);
    written("c.rib", [] { option("format", "cuneiform"); });
    EXPECT_EQ(errors, 2);
}

// Camera space is 4 units before the world's; the current one is turned by a quarter about z.
TEST_F(RibSessions, AnswerFromTheTransformationsThatTheyWrite) {
    RtPoint to_camera = {1, 2, 3}, to_mark = {1, 2, 3}, nowhere = {1, 2, 3};
    RtPoint* answers[3] = {};
    written("points.rib", [&] {
        RiTranslate(0, 0, 4);
        RiWorldBegin();
        RiAttributeBegin();
        RiCoordinateSystem(const_cast<char*>("mark"));
        RiMotionBegin(2, 0.0, 1.0);
        RiTranslate(10, 0, 0);
        RiTranslate(20, 0, 0);
        RiMotionEnd();
        RiRotate(90, 0, 0, 1);
        RiObjectBegin();
        RiScale(7, 7, 7);
        RiObjectEnd();
        answers[0] = RiTransformPoints(RI_OBJECT, RI_CAMERA, 1, &to_camera);
        answers[1] = RiTransformPoints(RI_OBJECT, const_cast<char*>("mark"), 1, &to_mark);
        answers[2] = RiTransformPoints(const_cast<char*>("none"), RI_WORLD, 1, &nowhere);
        RiAttributeEnd();
        RiWorldEnd();
    });
    EXPECT_EQ(answers[0], &to_camera);
    EXPECT_EQ(answers[1], &to_mark);
    EXPECT_EQ(answers[2], nullptr);
    const RtFloat camera[] = {8, 1, 7}, mark[] = {8, 1, 3};
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(to_camera[k], camera[k], 1e-5) << k;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(to_mark[k], mark[k], 1e-5) << k;
    EXPECT_EQ(errors, 1);
}

TEST_F(RibSessions, ThatCannotBeWrittenSayItOnce) {
    EXPECT_EQ(written("no/such/folder/a.rib", [] {}), "");
    EXPECT_EQ(errors, 1);
    EXPECT_EQ(RiLastError, RIE_SYSTEM);
}

TEST(OutsideOfContexts, OptionsAreKeptForThoseToCome) {
    Context::make_current(nullptr);
    option("format", "binary");
    const CallList& options = outside().options;
    ASSERT_EQ(options.calls().size(), 1u);
    EXPECT_EQ(options.calls()[0].parameters[0].values.string(), "binary");
}

TEST(OutsideOfContexts, ErrorsArePrintedUntilThereIsAHandler) {
    Context::make_current(nullptr);
    testing::internal::CaptureStderr();
    RiWorldEnd();
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "RenderMan Interface: error 23: the call stands outside of RiBegin and RiEnd, and "
              "does nothing\n");
    EXPECT_EQ(RiLastError, RIE_NOTSTARTED);
}

}  // namespace
}  // namespace kinora::ri
