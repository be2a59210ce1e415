// runtime/base/text_encoding.cpp: UTF-16 and Latin-1 to UTF-8 (RFC 2781, RFC 3629).
#include "runtime/base/text_encoding.h"

#include <utf8.h>

#include <cstdint>
#include <iterator>

namespace kinora {

namespace {

constexpr char32_t kReplacement = 0xfffd;

bool is_lead(char32_t unit) {
    return unit >= 0xd800 && unit < 0xdc00;
}
bool is_trail(char32_t unit) {
    return unit >= 0xdc00 && unit < 0xe000;
}

}  // namespace

void append_utf8(std::string& out, char32_t character) {
    utf8::unchecked::append(character, std::back_inserter(out));
}

std::string utf8_or_latin1(std::string_view text) {
    if (utf8::is_valid(text.begin(), text.end())) return std::string(text);
    std::string out;
    for (char c : text) append_utf8(out, uint8_t(c));
    return out;
}

std::string utf8_from_utf16(std::string_view bytes, bool big_endian) {
    size_t units = bytes.size() / 2;
    auto unit = [&](size_t i) -> char32_t {
        auto first = uint8_t(bytes[2 * i]), second = uint8_t(bytes[2 * i + 1]);
        return big_endian ? char32_t(first << 8 | second) : char32_t(second << 8 | first);
    };
    std::string out;
    out.reserve(units + 16);
    for (size_t i = 0; i < units; ++i) {
        char32_t c = unit(i);
        if (is_lead(c) && i + 1 < units && is_trail(unit(i + 1)))
            c = 0x10000 + ((c - 0xd800) << 10) + (unit(++i) - 0xdc00);
        append_utf8(out, is_lead(c) || is_trail(c) ? kReplacement : c);
    }
    return out;
}

std::string utf8_text(std::string bytes) {
    bool little = bytes.starts_with("\xff\xfe"), big = bytes.starts_with("\xfe\xff");
    if (!little && !big) return bytes;
    std::string out = utf8_from_utf16(std::string_view(bytes).substr(2), big);
    if (bytes.size() % 2) append_utf8(out, kReplacement);
    return out;
}

}  // namespace kinora
