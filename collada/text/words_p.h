// collada/text/words_p.h: forms that words and lists of numbers have.
#pragma once

#include <cstdint>
#include <string_view>

namespace kinora::collada {

// Forms of one word, and of lists of numbers (number_scan.cpp); white space separates.
bool is_name(std::string_view word);
bool is_ncname(std::string_view word);
bool is_uri(std::string_view word);
bool is_date_time(std::string_view word);
// Characters of 0x80 and above in names (name_characters.cpp).
bool is_letter_beyond_ascii(uint32_t character);
bool follows_in_name_beyond_ascii(uint32_t character);
bool is_real_list(std::string_view text);
// Whole numbers of at most 18 digits: false may mean a longer one.
bool is_whole_list(std::string_view text, bool signs);
// The same one byte at a time, which the faster ways are tested against.
bool is_real_list_by_table(std::string_view text);
bool is_whole_list_by_table(std::string_view text, bool signs);

}  // namespace kinora::collada
