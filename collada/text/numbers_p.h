// collada/numbers_p.h: the numbers of an element's text, whatever the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collada/document.h"

namespace kinora::collada {

// Each reads all numbers of the text. What is no number becomes 0 (SRC_NUMBER), a decimal comma is
// understood (SRC_COMMA_DECIMAL), NaN and infinities are kept; of each kind the first is reported
// with its place. `expected`, how many there are likely to be, spares counting them (0: unknown);
// it may be wrong, and no more memory is taken than what the text can hold.
std::vector<double> read_doubles(const Document& document, const Element& element,
                                 Diagnostics& diag, size_t expected = 0);
// Values beyond 32 bits are clamped, which puts them out of every range.
std::vector<int32_t> read_ints(const Document& document, const Element& element, Diagnostics& diag,
                               size_t expected = 0);
// What its count attribute says; 0 without one.
size_t written_count(const Element& element);

// One number alone; false when the text (trimmed) is anything else or not finite.
bool parse_double(std::string_view text, double& value);
// "1,5" under a comma locale; not "1,2,3".
bool comma_decimal(std::string_view word, double& value);
// xs:boolean, of either case; nothing where the text is anything else.
std::optional<bool> parse_bool(std::string_view text);
// A count-like attribute; false when it is no whole number >= 0 of 64 bits.
bool parse_count(std::string_view text, uint64_t& value);

// Words of a text, split at white space.
size_t count_words(std::string_view text);
std::vector<std::string_view> split_words(std::string_view text);
// The word that has `number` others before it; "" when there are fewer.
std::string_view word_number(std::string_view text, size_t number);
std::string_view trim(std::string_view text);

}  // namespace kinora::collada
