// tests/runtime/scene/ri/binary_test.cpp: the codes of RI Specification 3.2, table C.1, byte by
// byte.
#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "runtime/scene/ri/bytestream/unzip_p.h"
#include "tests/runtime/scene/ri/recorded_calls.h"

namespace kinora::ri {
namespace {

using namespace std::string_literals;

Texts calls_of(std::string bytes) {
    ReadCalls read = read_calls(std::move(bytes));
    EXPECT_EQ(read.messages, Texts());
    return read.calls;
}

std::string gzip(const std::string& bytes) {
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, bytes.size()) + 64, 0);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = uInt(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = uInt(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

TEST(RibBinary, IntegersAreSignedAndMayHaveFractions) {
    EXPECT_EQ(calls_of("Sides \200\002"s), Texts{"Sides 2i"});
    EXPECT_EQ(calls_of("Sides \200\377"s), Texts{"Sides -1i"});
    EXPECT_EQ(calls_of("Sides \201\002\200"s), Texts{"Sides 640i"});
    EXPECT_EQ(calls_of("Sides \202\377\000\000"s), Texts{"Sides -65536i"});
    EXPECT_EQ(calls_of("Sides \203\001\000\000\000"s), Texts{"Sides 16777216i"});
    EXPECT_EQ(calls_of("ShadingRate \204\100"s), Texts{"ShadingRate 0.25"});
    EXPECT_EQ(calls_of("ShadingRate \205\001\200"s), Texts{"ShadingRate 1.5"});
    EXPECT_EQ(calls_of("ShadingRate \206\001\000\100"s), Texts{"ShadingRate 256.25"});
    EXPECT_EQ(calls_of("ShadingRate \207\377\377\377\200"s), Texts{"ShadingRate -0.5"});
    EXPECT_EQ(calls_of("ShadingRate \210\100"s), Texts{"ShadingRate 0.0009765625"});
    EXPECT_EQ(calls_of("ShadingRate \213\000\001\100\000"s), Texts{"ShadingRate 1.25"});
    EXPECT_EQ(calls_of("ShadingRate \217\100\000\000\000"s), Texts{"ShadingRate 64"});
}

TEST(RibBinary, Reals) {
    EXPECT_EQ(calls_of("ShadingRate \244\077\200\000\000"s), Texts{"ShadingRate 1"});
    EXPECT_EQ(calls_of("ShadingRate \245\300\004\000\000\000\000\000\000"s),
              Texts{"ShadingRate -2.5"});
}

TEST(RibBinary, Strings) {
    EXPECT_EQ(calls_of("Orientation \222lh"s), Texts{"Orientation \"lh\""});
    EXPECT_EQ(calls_of("Orientation \220"s), Texts{"Orientation \"\""});
    EXPECT_EQ(calls_of("Orientation \23712345678901234\\"s),
              Texts{"Orientation \"12345678901234\\\""});
    EXPECT_EQ(calls_of("Orientation \240\003a\"b"s), Texts{"Orientation \"a\"b\""});
    EXPECT_EQ(calls_of("Orientation \241\000\002lh"s), Texts{"Orientation \"lh\""});
    EXPECT_EQ(calls_of("Orientation \242\000\000\002lh"s), Texts{"Orientation \"lh\""});
    EXPECT_EQ(calls_of("Orientation \243\000\000\000\002l\377"s), Texts{"Orientation \"l\377\""});
}

TEST(RibBinary, RequestsAreDefined) {
    EXPECT_EQ(calls_of("\314\001\225Sides\246\001\200\002\246\001\200\001"s),
              (Texts{"Sides 2i", "Sides 1i"}));
    EXPECT_EQ(calls_of("\314\000 \"Matte\" \246\000\200\001\314\000\225Sides\246\000\200\001"s),
              (Texts{"Matte 1i", "Sides 1i"}));
    EXPECT_EQ(calls_of("\314\377\240\005Sides\246\377 2"s), Texts{"Sides 2i"});
}

TEST(RibBinary, StringTokensAreDefined) {
    EXPECT_EQ(calls_of("\315\005\222lh Orientation\317\005Orientation\317\005"s),
              (Texts{"Orientation \"lh\"", "Orientation \"lh\""}));
    EXPECT_EQ(calls_of("Orientation\316\001\000\"rh\"\320\001\000"s), Texts{"Orientation \"rh\""});
    EXPECT_EQ(calls_of("\315\001\222lh\315\002\317\001\315\001\222rh Orientation\317\002"s),
              Texts{"Orientation \"lh\""});
    EXPECT_EQ(calls_of("Declare \315\001\221q\317\001\315\001\225float\317\001"s),
              Texts{"Declare \"q\" \"float\""});
}

TEST(RibBinary, ArraysOfSingles) {
    EXPECT_EQ(calls_of("Color\310\003\077\200\000\000\000\000\000\000\277\000\000\000"s),
              Texts{"Color [1 0 -0.5]"});
    EXPECT_EQ(calls_of("Points\"P\"\311\000\003\077\200\000\000\000\000\000\000\277\000\000\000"s),
              Texts{"Points \"vertex point P\" [1 0 -0.5]"});
    EXPECT_EQ(calls_of("MotionBegin\312\000\000\001\077\200\000\000"s), Texts{"MotionBegin [1]"});
    EXPECT_EQ(calls_of("MotionBegin\313\000\000\000\000Sides 1"s),
              (Texts{"MotionBegin []", "Sides 1i"}));
    EXPECT_EQ(calls_of("Color[\200\001\244\077\000\000\000 .25]"s), Texts{"Color [1 0.5 0.25]"});
    EXPECT_EQ(calls_of("SubdivisionMesh\"catmull-clark\"\310\001\100\100\000\000[0 1 2]"
                       "\310\000\310\000\310\000\310\000\"P\"[0 0 0 1 0 0 0 1 0]"s)
                  .size(),
              1u);
}

TEST(RibBinary, FormsMixAndCommentsHoldAnything) {
    EXPECT_EQ(
        calls_of("# \246\001\377\n\314\001\225Sides\246\001 2#\315\r\246\001\200\001Matte 1"s),
        (Texts{"Sides 2i", "Sides 1i", "Matte 1i"}));
}

TEST(RibBinary, TheEndOfInputEnds) {
    EXPECT_EQ(calls_of("Sides 1 \377 Sides 2"s), Texts{"Sides 1i"});
}

TEST(RibBinary, WrongCodesAreFound) {
    auto read = [](std::string bytes) { return read_calls(std::move(bytes)); };
    for (int byte : {0247, 0307, 0321, 0376}) {
        ReadCalls reserved = read("Sides 1\n" + std::string(1, char(byte)) + " Matte 1");
        EXPECT_EQ(reserved.findings, Texts{"RIB_CODE 2:1"}) << byte;
        EXPECT_EQ(reserved.calls, (Texts{"Sides 1i", "Matte 1i"}));
        EXPECT_NE(reserved.messages[0].find("(byte 8)"), std::string::npos);
    }
    EXPECT_EQ(read("Sides 1 \246\001 Matte 1"s).findings, Texts{"RIB_CODE 1:9"});
    EXPECT_EQ(read("Orientation \317\001 Matte 1"s).findings, Texts{"RIB_CODE 1:13"});
    EXPECT_EQ(read("Sides 1 \315\001 Matte 1"s).findings, Texts{"RIB_CODE 1:9"});
    EXPECT_EQ(read("Sides 1 \315\001\315\002\221a"s).findings, Texts{"RIB_CODE 1:9"});
}

TEST(RibBinary, StreamsThatAreCutOffKeepWhatIsWhole) {
    for (std::string rest : {"Color\310\003\077\200"s, "Sides \201\001"s, "Orientation \225lh"s,
                             "Orientation \241\001"s, "\246"s, "\315\001\225a"s, "\245\001"s}) {
        ReadCalls read = read_calls("Sides 1 " + rest);
        EXPECT_EQ(read.calls, Texts{"Sides 1i"});
        EXPECT_EQ(read.findings.size(), 1u) << rest;
    }
}

TEST(RibGzip, PackedStreamsAreUnpacked) {
    std::string text = "Sides 1 Matte 1";
    Texts expected{"Sides 1i", "Matte 1i"};
    EXPECT_EQ(calls_of(gzip(text)), expected);
    EXPECT_EQ(calls_of(gzip(gzip(text))), expected);
    EXPECT_EQ(calls_of(gzip("Sides 1 ") + gzip("Matte 1")), expected);
    EXPECT_TRUE(looks_like_rib(gzip(text)));
    EXPECT_TRUE(looks_like_rib(gzip(gzip(text))));
    EXPECT_FALSE(looks_like_rib(gzip("<COLLADA>")));
}

TEST(RibGzip, DamagedOnesKeepWhatCanBeRead) {
    std::string text;
    std::mt19937 random(3);
    for (int i = 0; i < 5000; ++i) text += fmt::format("Sides {}\n", random() % 1000000);
    std::string packed = gzip(text);
    ReadCalls read = read_calls(packed.substr(0, packed.size() / 2));
    EXPECT_GT(read.calls.size(), 1500u);
    EXPECT_LT(read.calls.size(), 3500u);
    ReadCalls whole = read_calls(text);
    for (size_t i = 0; i + 2 < read.calls.size(); ++i) ASSERT_EQ(read.calls[i], whole.calls[i]);
    ASSERT_FALSE(read.findings.empty());
    EXPECT_EQ(read.findings[0], "RIB_GZIP -");
    EXPECT_FALSE(read_calls("\x1f\x8b nonsense").is_rib);
}

TEST(RibGzip, BombsAreLimited) {
    std::string bomb = gzip(gzip(std::string(50'000'000, ' ')));
    UnzipLimits limits{.bytes = 1 << 24, .ratio = 200, .free_bytes = 1 << 20};
    Unzipped unzipped = unzip(bomb, limits);
    EXPECT_EQ(unzipped.bytes.size(), 1u << 20);
    EXPECT_NE(unzipped.error, "");
    std::string nested = "Sides 1";
    for (int i = 0; i < 6; ++i) nested = gzip(nested);
    EXPECT_EQ(unzip(nested, limits).bytes, "");
}

}  // namespace
}  // namespace kinora::ri
