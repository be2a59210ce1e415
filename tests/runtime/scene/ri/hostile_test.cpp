// tests/runtime/scene/ri/hostile_test.cpp: damaged streams, and streams that would take memory.
#include <gtest/gtest.h>

#include "tests/fuzz_settings.h"
#include "tests/mutate.h"
#include "tests/runtime/player/live_memory.h"
#include "tests/runtime/scene/ri/scene_text.h"
#include "tests/runtime/scene/ri/stream_promises.h"

namespace kinora::ri {
namespace {

std::vector<std::string> words() {
    std::vector<std::string> words{"[",
                                   "]",
                                   "\"",
                                   "[]",
                                   "\"P\"",
                                   "\"Cs\"",
                                   "\"float a\"",
                                   "\"string b\"",
                                   "-1",
                                   "1e38",
                                   "nan",
                                   "1e999",
                                   "2000000000",
                                   "0.5",
                                   "\"a\"",
                                   "#",
                                   "\\",
                                   "\n",
                                   "Foo",
                                   "\"color[3] c\"",
                                   "\"vertex point[1048576] d\"",
                                   "\"P\" []",
                                   "\200\001",
                                   "\203\177\377\377\377",
                                   "\244\177\200",
                                   "\310\002",
                                   "\313\377\377\377\377",
                                   "\314\001\225Sides\246\001",
                                   "\315\001\221P\317\001",
                                   "\320\377\377",
                                   "\243\377\377\377\377",
                                   "\246",
                                   "\377",
                                   "[0 1 2]",
                                   "\"periodic\"",
                                   "\"bicubic\""};
    for (const RequestRow& row : requests()) words.emplace_back(row.name);
    return words;
}

TEST(RibHostile, DamagedStreamsKeepThePromises) {
    std::vector<std::string> corpus{kSceneText, rewritten(kSceneText, StreamForm::Ascii),
                                    rewritten(kSceneText, StreamForm::Binary)};
    uint64_t count = fuzz_setting("KINORA_FUZZ_RIB", 3000);
    for (uint64_t seed : {uint64_t(1), fresh_seed()}) {
        Mutator mutator(corpus, words(), seed);
        for (uint64_t i = 0; i < count; ++i) {
            std::string stream = mutator.next();
            std::string broken = broken_promise(stream);
            if (broken.empty()) continue;
            FAIL() << broken << "\n"
                   << write_reduced(fmt::format("rib-{}-{}.rib", seed, i), stream);
        }
    }
}

TEST(RibHostile, EachBeginningOfAStreamIsRead) {
    for (StreamForm form : {StreamForm::Ascii, StreamForm::Binary}) {
        std::string whole = rewritten(kSceneText, form);
        Texts calls = read_calls(whole).calls;
        for (size_t size = 0; size < whole.size(); size += 3) {
            Texts some = read_calls(whole.substr(0, size)).calls;
            ASSERT_LE(some.size(), calls.size()) << size;
            for (size_t i = 0; i + 1 < some.size(); ++i) ASSERT_EQ(some[i], calls[i]) << size;
        }
    }
}

// `piece` as often as makes a megabyte, between the others.
std::string repeated(const std::string& before, const std::string& piece,
                     const std::string& after = "") {
    std::string text = before;
    while (text.size() < 1'000'000) text += piece;
    return text + after;
}

// Memory is judged without that of the sink, which keeps nothing here.
class CountingSink : public CallSink {
  public:
    explicit CountingSink(size_t& most) : most_(most) {}
    void call(const Call&) override { most_ = std::max(most_, live_memory()); }

  private:
    size_t& most_;
};

TEST(RibHostile, MemoryIsBounded) {
    const std::string kStreams[] = {
        repeated("Points \"P\" [", "0 ", "]"),
        repeated("Blobby 0 [] [] [", "\"\"", "]"),
        repeated("Blobby 0 [", "1 ", "] [] []"),
        repeated("Surface \"a\" ", "\"s\"1"),
        repeated("Surface \"a\" ", "\"\"1"),
        repeated("Color [", "1 ", "]"),
        repeated("", "[", ""),
        repeated("", "Sides"),
        repeated("", "Sides 1;"),
        repeated("", "WorldBegin "),
        repeated("", "\"\n\\\"\n"),
        repeated("", "\246\001"),
        repeated("\314\001\233LightSource\315\001\221a", "\246\001\317\001\317\001"),
        repeated("Declare \"q\" \"float[1000000]\" ", "Surface \"a\" \"q\" 1 "),
        repeated("\315\001" + repeated("\"", "x", "\""), "\246\001\317\001 "),
        repeated("\315\001\"" + std::string(100'000, 'x') + "\"", "Surface \317\001\317\001 1 "),
        repeated("PointsPolygons [", "3 ", "] [2147483647] \"P\" [0]"),
    };
    for (const std::string& stream : kStreams) {
        size_t before = live_memory(), most = 0;
        {
            Diagnostics diagnostics;
            Context context(std::make_unique<CountingSink>(most), diagnostics);
            BytestreamReader reader(context);
            reader.read("hostile.rib", stream + " Sides 1");
            most = std::max(most, live_memory());
        }
        EXPECT_LT(most - before, 20 * stream.size() + (64u << 20)) << stream.substr(0, 80);
        EXPECT_LT(most - before, 20 * stream.size()) << stream.substr(0, 80);
    }
}

TEST(RibHostile, UnknownNamesAreCountedInBoundedMemory) {
    std::string stream;
    for (int i = 0; i < 100'000; ++i) stream += fmt::format("r{} ", i);
    ReadCalls read = read_calls(stream);
    EXPECT_EQ(read.findings.size(), 202u);  // RIB_MORE and RIB_FOREIGN
}

}  // namespace
}  // namespace kinora::ri
