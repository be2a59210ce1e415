// tests/runtime/scene/ri/round_trip_test.cpp: calls that are written and read are the same calls.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "runtime/scene/ri/bytestream/zip.h"
#include "tests/fuzz_settings.h"
#include "tests/runtime/scene/ri/random_calls.h"
#include "tests/runtime/scene/ri/recorded_calls.h"
#include "tests/runtime/scene/ri/scene_text.h"
#include "tests/shared.h"

namespace kinora::ri {
namespace {

std::string zipped(const std::string& bytes) {
    std::string error, packed = zip(bytes, error);
    EXPECT_EQ(error, "");
    return packed;
}

void expect_round_trip(const std::string& stream, const std::string& name) {
    ReadCalls read = read_calls(stream);
    for (StreamForm form : {StreamForm::Ascii, StreamForm::Binary}) {
        std::string written = rewritten(stream, form);
        EXPECT_TRUE(looks_like_rib(written) || read.calls.empty()) << name;
        ReadCalls again = read_calls(written);
        EXPECT_EQ(again.calls, read.calls) << name << "\n" << written;
        EXPECT_EQ(again.messages, Texts()) << name;
        EXPECT_EQ(read_calls(zipped(written)).calls, read.calls) << name;
        EXPECT_EQ(rewritten(written, form), written) << name;
    }
}

TEST(RibRoundTrip, OfHandmadeCalls) {
    EXPECT_EQ(read_calls(kSceneText).messages, Texts());
    EXPECT_GT(read_calls(kSceneText).calls.size(), 30u);
    expect_round_trip(kSceneText, "handmade");
}

TEST(RibRoundTrip, OfFloatsOfAllSizes) {
    std::mt19937 random(7);
    std::string stream = "Points \"P\" [";
    for (int i = 0; i < 30000; ++i) {
        float value = std::bit_cast<float>(uint32_t(random()));
        stream += fmt::format("{:.9g} ", std::isfinite(value) ? value : 0);
    }
    expect_round_trip(stream + "]", "floats");
}

TEST(RibRoundTrip, OfIntegersOfAllSizes) {
    std::string stream;
    for (int64_t value = 1; value <= 1u << 31; value *= 2)
        for (int64_t near : {value - 1, value, -value, -value - 1})
            stream += fmt::format("Sides {}\n", std::clamp<int64_t>(near, INT32_MIN, INT32_MAX));
    expect_round_trip(stream, "integers");
}

// Random calls of each request, and the streams that they make.
struct WrittenCalls {
    explicit WrittenCalls(uint32_t seed) {
        auto sink = std::make_unique<RecordingSink>(calls);
        sink->then = [&](const Call& call) {
            ascii_writer.call(call);
            binary_writer.call(call);
            ++counts[size_t(call.request)];
        };
        Context context(std::move(sink), diagnostics);
        Context::make_current(&context);
        RandomCalls random(seed);
        for (int i = 0; i < 1500; ++i) random.call(context);
    }

    Diagnostics diagnostics;
    Texts calls;
    std::vector<int> counts = std::vector<int>(requests().size());
    std::string ascii, binary;
    StreamWriter ascii_writer{StreamForm::Ascii,
                              [this](std::string_view bytes) { ascii += bytes; }};
    StreamWriter binary_writer{StreamForm::Binary,
                               [this](std::string_view bytes) { binary += bytes; }};
};

void expect_same(const Texts& got, const Texts& wanted, const std::string& what) {
    ASSERT_EQ(got.size(), wanted.size()) << what;
    for (size_t i = 0; i < got.size(); ++i) ASSERT_EQ(got[i], wanted[i]) << what << " call " << i;
}

TEST(RibRoundTrip, OfRandomCallsOfAllRequests) {
    std::vector<int> counts(requests().size());
    const uint64_t seeds = fuzz_setting("KINORA_FUZZ_RIB_CALLS", 15);
    for (uint32_t seed = 1; seed <= seeds; ++seed) {
        const WrittenCalls made(seed);
        ReadCalls nothing_wrong;
        note_findings(made.diagnostics, nothing_wrong);
        ASSERT_EQ(nothing_wrong.messages, Texts()) << seed;
        const std::string packed = zipped(made.binary);
        for (const std::string* stream : {&made.ascii, &made.binary, &packed}) {
            ReadCalls read = read_calls(*stream);
            ASSERT_NO_FATAL_FAILURE(expect_same(read.calls, made.calls, fmt::format("{}", seed)));
            ASSERT_EQ(read.messages, Texts()) << seed;
        }
        for (size_t i = 0; i < counts.size(); ++i) counts[i] += made.counts[i];
    }
    for (size_t i = 0; i < counts.size(); ++i) {
        const bool is_read = Request(i) != Request::ArchiveRecord;
        EXPECT_EQ(counts[i] > 0, is_read) << requests()[i].name;
    }
}

TEST(RibRoundTrip, BlocksIndent) {
    EXPECT_EQ(
        rewritten("WorldBegin AttributeBegin Sides 1 AttributeEnd WorldEnd", StreamForm::Ascii),
        "##RenderMan RIB-Structure 1.1\nversion 3.03\n"
        "WorldBegin\n    AttributeBegin\n        Sides 1\n    AttributeEnd\nWorldEnd\n");
}

TEST(RibRoundTrip, CommentsAreRecorded) {
    std::string written;
    StreamWriter writer(StreamForm::Ascii, [&](std::string_view piece) { written += piece; });
    for (auto [type, text] :
         {std::pair{"comment", " a\nb"}, {"structure", "Frames 1"}, {"verbatim", "Sides 1"}}) {
        Values arguments[] = {type, text};
        writer.call({Request::ArchiveRecord, arguments, {}, {}, {}});
    }
    EXPECT_EQ(written.substr(written.find("3.03\n") + 5), "# a\n#b\n##Frames 1\nSides 1\n");
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

std::filesystem::path rib_folder() {
    return shared_folder() / "rib";
}

std::vector<std::filesystem::path> rib_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(rib_folder()))
        if (entry.path().extension() == ".rib" || entry.path().extension() == ".gz")
            files.push_back(entry.path());
    return files;
}

class SharedRib : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::is_directory(rib_folder())) GTEST_SKIP() << "no ../shared/rib";
    }
};

TEST_F(SharedRib, AllFilesMakeRoundTrips) {
    EXPECT_GT(rib_files().size(), 20u);
    for (const std::filesystem::path& path : rib_files())
        expect_round_trip(bytes_of(path), path.string());
}

TEST_F(SharedRib, EqualStreamsMakeEqualCalls) {
    auto calls = [](const std::string& name) {
        ReadCalls read = read_calls(bytes_of(rib_folder() / name));
        return read.calls;
    };
    std::string torus = "aqsis-history/ribfiles/torus";
    EXPECT_EQ(calls(torus + "_bin.rib"), calls(torus + "_bin_gzip.rib.gz"));
    EXPECT_EQ(calls(torus + "_bin.rib"), calls(torus + "_gzip.rib.gz"));
    std::string test = "ricpp/ricpp2/RibSamples/test";
    EXPECT_EQ(calls(test + "ascii.rib"), calls(test + "bin.rib"));
}

// Of 29 files those that name requests or tokens which the interface does not have, and those that
// are wrong on purpose.
TEST_F(SharedRib, FindingsAreOfKnownKinds) {
    std::map<std::string, int> counts;
    for (const std::filesystem::path& path : rib_files())
        for (const std::string& finding : read_calls(bytes_of(path)).findings)
            ++counts[finding.substr(0, finding.find(' '))];
    std::map<std::string, int> expected{
        {"RIB_FOREIGN", 1}, {"RIB_REQUEST_UNKNOWN", 8}, {"RI_COUNTS", 1}};
    EXPECT_EQ(counts, expected);
}

}  // namespace
}  // namespace kinora::ri
