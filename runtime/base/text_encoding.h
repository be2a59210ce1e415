// runtime/base/text_encoding.h: text in other encodings than UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// A code point as UTF-8. Surrogates are encoded like other characters.
void append_utf8(std::string& out, char32_t character);

// UTF-16 without a byte order mark. Halves of surrogate pairs become U+FFFD, a last odd byte is
// left out.
std::string utf8_from_utf16(std::string_view bytes, bool big_endian);

// Text that is UTF-8 as it is; any other as Latin-1 (ISO 8859-1).
std::string utf8_or_latin1(std::string_view text);

// UTF-16 with a byte order mark, as some editors of Windows write it, becomes UTF-8; all else is
// left as it is. Halves of surrogate pairs and a last odd byte become U+FFFD.
std::string utf8_text(std::string bytes);

}  // namespace kinora
