// tests/bench/collada_bench.cpp: what reading numbers and documents costs, in bytes a second.
#include <benchmark/benchmark.h>
#include <fast_float/fast_float.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/validate.h"
#include "tests/shared.h"

namespace kinora::collada {
namespace {

struct Style {
    const char* name;
    const char* format;
};
constexpr Style kStyles[] = {{"%.6f", "%.6f "},   {"%g", "%g "},     {"%.9g", "%.9g "},
                             {"%.17g", "%.17g "}, {"%.3f", "%.3f "}, {"%.7e", "%.7e "}};

std::string number_text(int64_t style) {
    std::mt19937 random(5);
    std::normal_distribution<double> value(0, 10);
    std::string text;
    while (text.size() < 4'000'000) {
        char word[64];
        text.append(word,
                    size_t(std::snprintf(word, sizeof word, kStyles[style].format, value(random))));
    }
    return text;
}

template <class Convert>
void words(benchmark::State& state, Convert convert) {
    std::string text = number_text(state.range(0));
    state.SetLabel(kStyles[state.range(0)].name);
    for (auto _ : state) {
        std::vector<double> values;  // made anew, as a reader must
        values.reserve(text.size() / 8);
        const char *p = text.data(), *end = p + text.size();
        while (p < end) {
            double value = 0;
            p = convert(p, end, value);
            values.push_back(value);
            while (p < end && *p == ' ') ++p;
        }
        benchmark::DoNotOptimize(values.data());
    }
    state.SetBytesProcessed(int64_t(state.iterations() * text.size()));
}

void BM_floats_strtod(benchmark::State& state) {
    words(state, [](const char* p, const char*, double& value) {
        char* stop;
        value = std::strtod(p, &stop);
        return const_cast<const char*>(stop);
    });
}
BENCHMARK(BM_floats_strtod)->DenseRange(0, 5);

void BM_floats_from_chars(benchmark::State& state) {
    words(state, [](const char* p, const char* end, double& value) {
        return std::from_chars(p, end, value).ptr;
    });
}
BENCHMARK(BM_floats_from_chars)->DenseRange(0, 5);

void BM_floats_fast_float(benchmark::State& state) {
    words(state, [](const char* p, const char* end, double& value) {
        return fast_float::from_chars(p, end, value).ptr;
    });
}
BENCHMARK(BM_floats_fast_float)->DenseRange(0, 5);

Document list_document(const std::string& text, Diagnostics& diag) {
    return *read_document_text("t.dae", "<COLLADA><p>" + text + "</p></COLLADA>", diag);
}

void BM_floats_kinora(benchmark::State& state) {
    std::string text = number_text(state.range(0));
    state.SetLabel(kStyles[state.range(0)].name);
    Diagnostics diag;
    Document document = list_document(text, diag);
    for (auto _ : state)
        benchmark::DoNotOptimize(read_doubles(document, *document.root().first_child, diag));
    state.SetBytesProcessed(int64_t(state.iterations() * text.size()));
}
BENCHMARK(BM_floats_kinora)->DenseRange(0, 5);

void BM_ints_kinora(benchmark::State& state) {
    std::mt19937 random(5);
    std::string text;
    while (text.size() < 4'000'000) text += std::to_string(random() % 20000) + " ";
    Diagnostics diag;
    Document document = list_document(text, diag);
    for (auto _ : state)
        benchmark::DoNotOptimize(read_ints(document, *document.root().first_child, diag));
    state.SetBytesProcessed(int64_t(state.iterations() * text.size()));
}
BENCHMARK(BM_ints_kinora);

// KINORA_SCENES names a file or folder; else the shared scenes. Each step over all .dae files.
std::vector<std::pair<std::string, std::string>> scene_files() {
    const char* named = std::getenv("KINORA_SCENES");
    std::filesystem::path root = named ? named : shared_scenes();
    std::vector<std::pair<std::string, std::string>> files;
    auto add = [&](const std::filesystem::path& path) {
        std::ifstream in(path, std::ios::binary);
        std::ostringstream text;
        text << in.rdbuf();
        files.emplace_back(path.string(), text.str());
    };
    if (std::filesystem::is_regular_file(root)) add(root);
    if (std::filesystem::is_directory(root))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
            if (entry.path().extension() == ".dae") add(entry.path());
    return files;
}

enum class Step : uint8_t { Read, Check, Extract, Everything, Validate };

void documents(benchmark::State& state, Step step) {
    auto files = scene_files();
    size_t bytes = 0;
    for (auto& [path, text] : files) bytes += text.size();
    for (auto _ : state)
        for (auto& [path, text] : files) {
            if (step != Step::Read) state.PauseTiming();
            Diagnostics diag;
            std::optional<Document> document = read_document_text(path, text, diag);
            if (step != Step::Read) state.ResumeTiming();
            if (!document) continue;
            ExtractOptions options;
            options.everything = step == Step::Everything;
            if (step == Step::Check) check_elements(*document, diag);
            if (step == Step::Extract || step == Step::Everything)
                benchmark::DoNotOptimize(extract(*document, diag, options));
            if (step == Step::Validate) benchmark::DoNotOptimize(validate(*document, diag));
        }
    state.SetBytesProcessed(int64_t(state.iterations() * bytes));
    state.SetItemsProcessed(int64_t(state.iterations() * files.size()));
}

void BM_document_read(benchmark::State& state) {
    documents(state, Step::Read);
}
void BM_document_check(benchmark::State& state) {
    documents(state, Step::Check);
}
void BM_document_extract(benchmark::State& state) {
    documents(state, Step::Extract);
}
void BM_document_everything(benchmark::State& state) {
    documents(state, Step::Everything);
}
void BM_document_validate(benchmark::State& state) {
    documents(state, Step::Validate);
}
BENCHMARK(BM_document_read);
BENCHMARK(BM_document_check);
BENCHMARK(BM_document_extract);
BENCHMARK(BM_document_everything);
BENCHMARK(BM_document_validate);

}  // namespace
}  // namespace kinora::collada

BENCHMARK_MAIN();
