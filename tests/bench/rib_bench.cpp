// tests/bench/rib_bench.cpp: what reading arrays of floats from RIB costs, beside what the COLLADA
// reader takes for the same numbers.
#include <benchmark/benchmark.h>

#include <random>

#include "collada/document/element_numbers_p.h"
#include "runtime/scene/ri/bytestream/read_stream.h"
#include "runtime/scene/ri/bytestream/write_stream.h"

namespace kinora {
namespace {

constexpr const char* kFormats[] = {"%.6f ", "%g ", "%.9g ", "%.3f ", "%.7e "};
constexpr int64_t kLast = std::size(kFormats) - 1;

std::string number_text(const char* format, size_t bytes) {
    std::mt19937 random(5);
    std::normal_distribution<double> value(0, 10);
    std::string text;
    for (size_t count = 0; text.size() < bytes || count % 3; ++count) {
        char word[64];
        text.append(word, size_t(std::snprintf(word, sizeof word, format, value(random))));
    }
    return text;
}

class SilentSink : public ri::CallSink {
  public:
    void call(const ri::Call& call) override { benchmark::DoNotOptimize(&call); }
};

void finish(benchmark::State& state, size_t bytes) {
    state.SetBytesProcessed(state.iterations() * int64_t(bytes));
}

// The same numbers in both files, some arrays of the size of a mesh's.
constexpr int kArrays = 8;
constexpr size_t kArrayBytes = 500'000;

void BM_collada_floats(benchmark::State& state) {
    std::string numbers = number_text(kFormats[state.range(0)], kArrayBytes);
    state.SetLabel(kFormats[state.range(0)]);
    std::string text = "<COLLADA version=\"1.4.1\">";
    for (int i = 0; i < kArrays; ++i) text += "<float_array>" + numbers + "</float_array>";
    text += "</COLLADA>";
    for (auto _ : state) {
        Diagnostics diagnostics;
        auto document = collada::read_document_text("bench.dae", text, diagnostics);
        for (const auto* array = document->root().first_child; array; array = array->next) {
            auto values = collada::read_doubles(*document, *array, diagnostics);
            benchmark::DoNotOptimize(values.data());
        }
    }
    finish(state, text.size());
}
BENCHMARK(BM_collada_floats)->DenseRange(0, kLast);

// The numbers alone, without the document around them.
void BM_collada_numbers(benchmark::State& state) {
    std::string numbers = number_text(kFormats[state.range(0)], kArrayBytes);
    state.SetLabel(kFormats[state.range(0)]);
    Diagnostics diagnostics;
    auto document = collada::read_document_text(
        "bench.dae",
        "<COLLADA version=\"1.4.1\"><float_array>" + numbers + "</float_array></COLLADA>",
        diagnostics);
    for (auto _ : state)
        for (int i = 0; i < kArrays; ++i) {
            auto values =
                collada::read_doubles(*document, *document->root().first_child, diagnostics);
            benchmark::DoNotOptimize(values.data());
        }
    finish(state, kArrays * numbers.size());
}
BENCHMARK(BM_collada_numbers)->DenseRange(0, kLast);

void read_rib(benchmark::State& state, const std::string& text) {
    for (auto _ : state) {
        Diagnostics diagnostics;
        ri::Context context(std::make_unique<SilentSink>(), diagnostics);
        ri::BytestreamReader(context).read("bench.rib", text);
        if (!diagnostics.findings().empty())
            state.SkipWithError(diagnostics.findings()[0].message.c_str());
    }
    finish(state, text.size());
}

std::string rib_text(int64_t format) {
    std::string text, numbers = number_text(kFormats[format], kArrayBytes);
    for (int i = 0; i < kArrays; ++i) text += "Points \"P\" [" + numbers + "]\n";
    return text;
}

void BM_rib_floats(benchmark::State& state) {
    state.SetLabel(kFormats[state.range(0)]);
    read_rib(state, rib_text(state.range(0)));
}
BENCHMARK(BM_rib_floats)->DenseRange(0, kLast);

void BM_rib_binary_floats(benchmark::State& state) {
    std::string written;
    Diagnostics diagnostics;
    ri::Context context(
        std::make_unique<ri::StreamWriter>(ri::StreamForm::Binary,
                                           [&](std::string_view piece) { written += piece; }),
        diagnostics);
    ri::BytestreamReader(context).read("bench.rib", rib_text(0));
    read_rib(state, written);
}
BENCHMARK(BM_rib_binary_floats);

// Many short requests.
void BM_rib_requests(benchmark::State& state) {
    std::string text;
    while (text.size() < 4'000'000)
        text +=
            "AttributeBegin\n  Translate 1.5 -2.25 0.125\n  Color [0.5 0.25 1]\n"
            "  Surface \"plastic\" \"Kd\" [0.75] \"uniform float bump\" 3\n"
            "  Sphere 1 -1 1 360\nAttributeEnd\n";
    read_rib(state, text);
}
BENCHMARK(BM_rib_requests);

}  // namespace
}  // namespace kinora
BENCHMARK_MAIN();
