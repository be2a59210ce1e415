// tests/runtime/scene/ri/ascii_test.cpp: ASCII streams to calls.
#include <gtest/gtest.h>

#include "tests/runtime/scene/ri/recorded_calls.h"

namespace kinora::ri {
namespace {

// Calls that a stream makes without any finding.
Texts calls(std::string bytes) {
    ReadCalls read = read_calls(std::move(bytes));
    EXPECT_EQ(read.messages, Texts());
    EXPECT_TRUE(read.is_rib);
    return read.calls;
}

TEST(RibAscii, NumbersHaveAllForms) {
    EXPECT_EQ(calls("Clipping 1 1e3"), Texts{"Clipping 1 1000"});
    EXPECT_EQ(calls("Clipping +.5 1."), Texts{"Clipping 0.5 1"});
    EXPECT_EQ(calls("Clipping -0.25E+1 1e-2"), Texts{"Clipping -2.5 0.01"});
    EXPECT_EQ(calls("ScreenWindow 16777217 12345678901234567890 -0.00000000012345 1E38"),
              Texts{"ScreenWindow 16777216 1.2345679e+19 -1.2345e-10 1e+38"});
}

TEST(RibAscii, TokensNeedNoBlanksBetweenThem) {
    EXPECT_EQ(calls("Color[1 0 0]Surface\"plastic\"\"Kd\"[.5]\"Ks\".25#comment\nSides 1"),
              (Texts{"Color [1 0 0]",
                     "Surface \"plastic\" \"uniform float Kd\" [0.5] \"uniform float Ks\" [0.25]",
                     "Sides 1i"}));
}

TEST(RibAscii, CommentsEndWithTheirLine) {
    EXPECT_EQ(calls("##RenderMan RIB\r\n# Sides 1\rSides 2 # Sides 3 \"\nWorldBegin"),
              (Texts{"Sides 2i", "WorldBegin"}));
}

TEST(RibAscii, AMarkOfUtf8BeforeTheTextIsNoFinding) {
    EXPECT_TRUE(looks_like_rib("\xEF\xBB\xBFWorldBegin"));
    EXPECT_EQ(calls("\xEF\xBB\xBFWorldBegin"), Texts{"WorldBegin"});
}

TEST(RibAscii, StringsHaveEscapes) {
    EXPECT_EQ(calls(R"(Orientation "a\n\t\"\\\101\60z\q")"),
              Texts{"Orientation \"a\n\t\"\\A0zq\""});
    EXPECT_EQ(calls("Orientation \"a\\\nb\\\r\nc#d\""), Texts{"Orientation \"abc#d\""});
    EXPECT_EQ(calls("Orientation \"two\nlines\""), Texts{"Orientation \"two\nlines\""});
}

TEST(RibAscii, FixedNumbersStandAloneOrInBrackets) {
    Texts sphere{"Sphere 1 -1 1 360"};
    EXPECT_EQ(calls("Sphere 1 -1 1 360"), sphere);
    EXPECT_EQ(calls("Sphere [1 -1 1 360]"), sphere);
    EXPECT_EQ(calls("Sphere [1] [-1 1] 360"), sphere);
    EXPECT_EQ(calls("Color 1 0 .5"), Texts{"Color [1 0 0.5]"});
    EXPECT_EQ(calls("Bound 1 2 3 4 5 6"), Texts{"Bound [1 2 3 4 5 6]"});
    EXPECT_EQ(calls("Hyperboloid 1 2 3 4 5 6 360"), Texts{"Hyperboloid 1 2 3 4 5 6 360"});
    EXPECT_EQ(calls("Format [640 480 1]"), Texts{"Format 640i 480i 1"});
}

TEST(RibAscii, IntegersServeAsFloatsAndWholeFloatsAsIntegers) {
    EXPECT_EQ(calls("Sides 2.0"), Texts{"Sides 2i"});
    EXPECT_EQ(calls("Declare \"n\" \"int\" Attribute \"a\" \"n\" [3.0]").back(),
              "Attribute \"a\" \"uniform integer n\" [3]i");
    EXPECT_EQ(calls("Points \"P\" [1 2 3 4 5.5 6]"),
              Texts{"Points \"vertex point P\" [1 2 3 4 5.5 6]"});
}

TEST(RibAscii, AFractionIsDroppedWithAFinding) {
    ReadCalls read = read_calls("Sides 1.5\nAttribute \"a\" \"int n\" [1 2.25]");
    EXPECT_EQ(read.calls, (Texts{"Sides 1i", "Attribute \"a\" \"uniform integer n\" [1]i"}));
    EXPECT_EQ(read.findings,
              (Texts{"RIB_ARGUMENT 1:1", "RIB_ARGUMENT 2:23", "RIB_PARAMETER_LENGTH 2:15"}));
}

TEST(RibAscii, BasesHaveNamesOrNumbers) {
    EXPECT_EQ(calls("Basis \"bezier\" 3 [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] 4"),
              Texts{"Basis [-1 3 -3 1 3 -6 3 0 -3 3 0 0 1 0 0 0] 3i "
                    "[1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] 4i"});
}

TEST(RibAscii, OldAndShortForms) {
    EXPECT_EQ(calls("DepthOfField").size(), 1u);
    EXPECT_EQ(calls("DepthOfField Sides 1").back(), "Sides 1i");
    EXPECT_EQ(calls("Format 64 48 -1"), Texts{"Format 64i 48i -1"});
    EXPECT_EQ(calls("Format 64 48\nSides 1"), (Texts{"Format 64i 48i -1", "Sides 1i"}));
    EXPECT_EQ(calls("Projection \"perspective\" \"fov\" 45"),
              Texts{"Projection \"perspective\" \"uniform float fov\" [45]"});
    EXPECT_EQ(calls("Option \"searchpath\" \"string shader\" \"a:b\""),
              Texts{"Option \"searchpath\" \"uniform string shader\" [\"a:b\"]"});
    EXPECT_EQ(calls("MotionBegin 0 .5 MotionEnd"), (Texts{"MotionBegin [0 0.5]", "MotionEnd"}));
    EXPECT_EQ(calls("SubdivisionMesh \"catmull-clark\" [3] [0 1 2] \"P\" [0 0 0 1 0 0 0 1 0]"),
              Texts{"SubdivisionMesh \"catmull-clark\" [3]i [0 1 2]i [] []i []i [] "
                    "\"vertex point P\" [0 0 0 1 0 0 0 1 0]"});
}

TEST(RibAscii, CountsFollowFromArrays) {
    EXPECT_EQ(calls("Polygon \"P\" [0 0 0 1 0 0 0 1 0] \"Cs\" [1 0 0 0 1 0 0 0 1]"),
              Texts{"Polygon \"vertex point P\" [0 0 0 1 0 0 0 1 0] "
                    "\"varying color Cs\" [1 0 0 0 1 0 0 0 1]"});
    EXPECT_EQ(calls("Curves \"linear\" [2] \"nonperiodic\" \"P\" [0 0 0 1 1 1]"),
              Texts{"Curves \"linear\" [2]i \"nonperiodic\" \"vertex point P\" [0 0 0 1 1 1]"});
    EXPECT_EQ(calls("TrimCurve [1] [2] [0 0 1 1] [0] [1] [2] [0 1] [0 1] [1 1]"),
              Texts{"TrimCurve [1]i [2]i [0 0 1 1] [0] [1] [2]i [0 1] [0 1] [1 1]"});
    EXPECT_EQ(calls("Blobby 1 [1001 0] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] [\"\"]"),
              Texts{"Blobby 1i [1001 0]i [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] [\"\"]"});
    EXPECT_EQ(calls("PointsPolygons [] [] \"P\" []"),
              Texts{"PointsPolygons []i []i \"vertex point P\" []"});
}

TEST(RibAscii, FunctionsAndFiltersHaveNames) {
    EXPECT_EQ(calls("PixelFilter \"catmull-rom\" 4 4"), Texts{"PixelFilter \"catmull-rom\" 4 4"});
    EXPECT_EQ(calls("MakeTexture \"box\" \"b\" \"black\" \"clamp\" \"gaussian\" 2 2"),
              Texts{"MakeTexture \"box\" \"b\" \"black\" \"clamp\" \"gaussian\" 2 2"});
    EXPECT_EQ(calls("Procedural \"RunProgram\" [\"p\" \"d\"] [0 1 2 3 4 5]"),
              Texts{"Procedural \"RunProgram\" [\"p\" \"d\"] [0 1 2 3 4 5]"});
    EXPECT_EQ(calls("ErrorHandler \"ignore\""), Texts{"ErrorHandler \"ignore\""});
    ReadCalls read = read_calls("PixelFilter \"round\" 2 2 Sides 1");
    EXPECT_EQ(read.findings, Texts{"RI_TOKEN_WRONG 1:1"});
    EXPECT_EQ(read.calls, (Texts{"PixelFilter \"gaussian\" 2 2", "Sides 1i"}));
}

TEST(RibAscii, HandlesAreNumbersOrStrings) {
    ReadCalls read = read_calls(
        "LightSource \"a\" 7\nLightSource \"b\" \"key\"\nLightSource \"c\" 7\n"
        "Illuminate 7 0\nIlluminate \"key\" 1\nIlluminate 8 1\n"
        "ObjectBegin 7\nObjectEnd\nObjectInstance [7]\nObjectInstance \"key\"\n");
    EXPECT_EQ(read.calls, (Texts{"LightSource \"a\" 1i", "LightSource \"b\" 2i",
                                 "LightSource \"c\" 3i", "Illuminate 3i 0i", "Illuminate 2i 1i",
                                 "ObjectBegin 4i", "ObjectEnd", "ObjectInstance 4i"}));
    EXPECT_EQ(read.findings, (Texts{"RIB_HANDLE 6:1", "RIB_HANDLE 10:1"}));
}

TEST(RibAscii, TokensAreResolved) {
    EXPECT_EQ(calls("Surface \"wood\" \"grain\" [1 2 3]"),
              Texts{"Surface \"wood\" \"uniform color grain\" [1 2 3]"});
    EXPECT_EQ(calls("Declare \"q\" \"varying float[2]\" Sphere 1 -1 1 360 \"q\" [1 2 3 4 5 6 7 8]")
                  .back(),
              "Sphere 1 -1 1 360 \"varying float[2] q\" [1 2 3 4 5 6 7 8]");
    ReadCalls read = read_calls("Surface \"x\" \"nope\" [\"a\" 3] \"no\" 1 \"Kd\" .5 \"last\"");
    EXPECT_EQ(read.calls, Texts{"Surface \"x\" \"uniform float Kd\" [0.5]"});
    EXPECT_EQ(read.findings, (Texts{"RIB_TOKEN_UNKNOWN 1:13", "RIB_TOKEN_UNKNOWN 1:28",
                                    "RIB_TOKEN_UNKNOWN 1:43"}));
}

TEST(RibAscii, VersionsAreKnown) {
    EXPECT_EQ(calls("version 3.03 Sides 1"), Texts{"Sides 1i"});
    EXPECT_EQ(read_calls("version 4 Sides 1").findings, Texts{"RIB_VERSION 1:1"});
}

TEST(RibAscii, NotANumberIsKept) {
    ReadCalls read = read_calls("Points \"P\" [nan -inf 0]");
    EXPECT_EQ(read.calls, Texts{"Points \"vertex point P\" [nan -inf 0]"});
    EXPECT_EQ(read.findings, Texts{"RIB_NUMBER 1:13"});
}

TEST(RibAscii, StreamsAreToldByTheirBeginning) {
    EXPECT_TRUE(looks_like_rib("# x\n##RenderMan RIB-Structure 1.0\n"));
    EXPECT_TRUE(looks_like_rib("\r\n# a comment\nversion 3.03"));
    EXPECT_TRUE(looks_like_rib("Display \"a\""));
    EXPECT_TRUE(looks_like_rib("\xcc\x01\x9bWorldBegin!\xa6\x01") == false);
    EXPECT_TRUE(looks_like_rib("\xcc\x01\x9aWorldBegin\xa6\x01"));
    EXPECT_FALSE(looks_like_rib("<COLLADA>"));
    EXPECT_FALSE(looks_like_rib("surface a() {}"));
    EXPECT_FALSE(looks_like_rib(""));
    EXPECT_FALSE(looks_like_rib("\x1f\x8b"));
}

TEST(RibAscii, AnArchiveIsReadInTheMiddle) {
    Texts calls;
    Diagnostics diagnostics;
    auto sink = std::make_unique<RecordingSink>(calls);
    RecordingSink* recording = sink.get();
    Context context(std::move(sink), diagnostics);
    BytestreamReader reader(context);
    recording->then = [&](const Call& call) {
        if (calls.size() == 9) reader.stop();
        if (call.request == Request::ReadArchive)
            reader.read("inner.rib", "ObjectInstance 1 ReadArchive \"inner.rib\"");
    };
    EXPECT_TRUE(reader.read("outer.rib", "ObjectBegin 1 ObjectEnd ReadArchive \"a\" Sides 1"));
    ASSERT_EQ(calls.size(), 9u);
    EXPECT_EQ(calls[3], "ObjectInstance 1i");
    EXPECT_EQ(calls[4], "ReadArchive \"inner.rib\"");
}

TEST(RibAscii, ArchivesThatNameEachOtherEnd) {
    Texts calls;
    Diagnostics diagnostics;
    auto sink = std::make_unique<RecordingSink>(calls);
    RecordingSink* recording = sink.get();
    Context context(std::move(sink), diagnostics);
    BytestreamReader reader(context);
    recording->then = [&](const Call&) { reader.read("a.rib", "ReadArchive \"a.rib\""); };
    reader.read("a.rib", "ReadArchive \"a.rib\"");
    ReadCalls read;
    note_findings(diagnostics, read);
    EXPECT_EQ(read.findings, Texts{"RIB_DEPTH 1:1"});
}

}  // namespace
}  // namespace kinora::ri
