// tests/fuzzers/fuzz_numbers.cpp: any text as a list of numbers, against std::from_chars.
#include <charconv>
#include <cmath>

#include "collada/document/element_numbers_p.h"
#include "collada/text/numbers_p.h"
#include "tests/collada/scene_promises.h"
#include "tests/fuzzers/fuzzer.h"

using namespace kinora;

namespace {

// The value of a word that is a plain decimal number, without a '+' or a decimal comma.
template <class T>
bool plain(std::string_view word, T& value) {
    if (word.find_first_not_of("0123456789.eE-+") != std::string_view::npos) return false;
    auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

template <class T>
void compare(const std::vector<T>& values, std::string_view text) {
    std::vector<std::string_view> words = collada::split_words(text);
    if (values.size() != words.size()) fuzz::expect("one number a word");
    for (size_t i = 0; i < words.size(); ++i) {
        T expected;
        if (plain(words[i], expected) && values[i] != expected)
            fuzz::expect("equal to from_chars: " + std::string(words[i]));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string text(fuzz::text_of(data, size));
    for (char& c : text)
        if (c == '<' || c == '&' || c == '>' || static_cast<unsigned char>(c) >= 0x80) c = ' ';
    Diagnostics diag;
    auto document = collada::read_document_text(
        "fuzz.dae", "<COLLADA version=\"1.4.1\"><float_array>" + text + "</float_array></COLLADA>",
        diag);
    if (!document || !document->whole()) return 0;  // control characters
    const collada::Element& list = *document->root().first_child;
    fuzz::MemoryBound bound(size);
    bool commas = text.find(',') != std::string::npos;  // "1,5 2" may be one or two numbers
    std::vector<double> doubles = collada::read_doubles(*document, list, diag);
    std::vector<int32_t> ints = collada::read_ints(*document, list, diag);
    if (!commas) {
        compare(doubles, list.text);
        compare(ints, list.text);
    }
    fuzz::expect(collada::broken_place(diag));
    return 0;
}
