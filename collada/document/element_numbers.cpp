// collada/document/element_numbers.cpp: the numbers that an element contains, and what is wrong
// with them.
#include "collada/document/element_numbers_p.h"

#include "collada/document/findings.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

void report(const NumberFaults& faults, const Document& document, const Element& element,
            Diagnostics& diag) {
    auto say = [&](const FindingInfo& code, NumberFaults::Word word) {
        if (word.length == 0) return;
        diag.report(code, document.text_location(element, word.begin, word.begin + word.length),
                    element.text.substr(word.begin, word.length));
    };
    say(Code::SRC_NUMBER, faults.number);
    say(Code::SRC_COMMA_DECIMAL, faults.comma);
    say(Code::SRC_NAN_INF, faults.nonfinite);
}

}  // namespace

std::vector<double> read_doubles(const Document& document, const Element& element,
                                 Diagnostics& diag, size_t expected) {
    NumberFaults faults;
    std::vector<double> values = scan_doubles(element.text, expected, faults);
    report(faults, document, element, diag);
    return values;
}

std::vector<int32_t> read_ints(const Document& document, const Element& element, Diagnostics& diag,
                               size_t expected) {
    NumberFaults faults;
    std::vector<int32_t> values = scan_ints(element.text, expected, faults);
    report(faults, document, element, diag);
    return values;
}

size_t written_count(const Element& element) {
    uint64_t count = 0;
    return parse_count(element.value("count"), count) ? size_t(count) : 0;
}

}  // namespace kinora::collada
