// collada/text/numbers_p.h: the numbers and words of a text, whatever the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace kinora::collada {

// What was wrong with the words of a list of numbers: of each kind the first, length 0 for none.
struct NumberFaults {
    struct Word {
        size_t begin = 0, length = 0;  // in the text
    };
    Word number;     // it is no number: 0
    Word comma;      // a decimal comma, which is understood
    Word nonfinite;  // NaN or an infinity, which is kept
};
// All numbers of the text. `expected`, how many there are likely to be, spares counting them (0:
// unknown); it may be wrong, and no more memory is taken than what the text can hold.
std::vector<double> scan_doubles(std::string_view text, size_t expected, NumberFaults& faults);
// Values beyond 32 bits are clamped, which puts them out of every range.
std::vector<int32_t> scan_ints(std::string_view text, size_t expected, NumberFaults& faults);

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
