// tests/fuzzers/fuzz_resolver.cpp: documents whose links, counts and elements are shuffled: reading
// everything, the lint rules, and what scene.h promises.
#include <random>
#include <vector>

#include "collada/validate/validate.h"
#include "tests/collada/scene_promises.h"
#include "tests/fuzzers/fuzzer.h"

using namespace kinora;

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace {

using Random = std::minstd_rand;

// The ranges between quotes, or whole elements with nothing but text inside.
std::vector<collada::ByteRange> quoted(std::string_view text) {
    std::vector<collada::ByteRange> ranges;
    for (size_t at = 0; (at = text.find("=\"", at)) != text.npos;) {
        size_t end = text.find('"', at + 2);
        if (end == text.npos) break;
        ranges.push_back({uint32_t(at + 2), uint32_t(end)});
        at = end;
    }
    return ranges;
}

void list_ranges(const collada::Element& element, std::vector<collada::ByteRange>& ranges) {
    for (const collada::Element& child : element.children()) {
        ranges.push_back(child.bytes);
        list_ranges(child, ranges);
    }
}

template <class T>
const T& pick(const std::vector<T>& list, Random& random) {
    return list[random() % list.size()];
}

// Another attribute's value, an id with its '#', or a hostile number.
void change_value(std::string& text, Random& random) {
    std::vector<collada::ByteRange> values = quoted(text);
    if (values.empty()) return;
    static const std::vector<std::string> kWords = {"0",           "-1",  "4294967295",
                                                    "99999999999", "1,5", ""};
    collada::ByteRange to = pick(values, random), from = pick(values, random);
    std::string value = text.substr(from.begin, from.end - from.begin);
    if (random() % 3 == 0) value = "#" + value;
    if (random() % 4 == 0) value = pick(kWords, random);
    text.replace(to.begin, to.end - to.begin, value);
}

// An element removed, doubled, or put into the place of another.
void change_elements(std::string& text, Random& random) {
    Diagnostics diag;
    auto document = collada::read_document_text("fuzz.dae", text, diag);
    std::vector<collada::ByteRange> ranges;
    if (document) list_ranges(document->root(), ranges);
    if (ranges.empty() || diag.files.text(document->file()) != text) return;
    collada::ByteRange to = pick(ranges, random), from = pick(ranges, random);
    std::string element = text.substr(from.begin, from.end - from.begin);
    size_t length = to.end - to.begin;
    switch (random() % 3) {
        case 0:
            text.erase(to.begin, length);
            break;
        case 1:
            text.insert(to.begin, element);
            break;
        default:
            text.replace(to.begin, length, element);
    }
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
    Random random(seed + 1);
    if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, max_size);
    std::string text(fuzz::text_of(data, size));
    for (unsigned n = 1 + random() % 3; n > 0; --n)
        random() % 2 ? change_value(text, random) : change_elements(text, random);
    if (text.size() > max_size) return size;
    std::copy(text.begin(), text.end(), data);
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Diagnostics diag;
    fuzz::MemoryBound bound(size);
    auto document =
        collada::read_document_text("fuzz.dae", std::string(fuzz::text_of(data, size)), diag);
    if (!document) return 0;
    auto scene = collada::validate(*document, diag);
    if (scene) fuzz::expect(collada::broken_promise(*scene));
    fuzz::expect(collada::broken_place(diag));
    return 0;
}
