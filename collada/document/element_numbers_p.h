// collada/document/element_numbers_p.h: the numbers that an element contains.
#pragma once

#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

// Each reads all numbers of the text. What is no number becomes 0 (SRC_NUMBER), a decimal comma is
// understood (SRC_COMMA_DECIMAL), NaN and infinities are kept; of each kind the first is reported
// with its location. `expected` as in scan_doubles().
std::vector<double> read_doubles(const Document& document, const Element& element,
                                 Diagnostics& diag, size_t expected = 0);
// Values beyond 32 bits are clamped, which puts them out of every range.
std::vector<int32_t> read_ints(const Document& document, const Element& element, Diagnostics& diag,
                               size_t expected = 0);
// What its count attribute says; 0 without one.
size_t written_count(const Element& element);

}  // namespace kinora::collada
