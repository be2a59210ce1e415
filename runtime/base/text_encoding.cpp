// runtime/base/text_encoding.cpp: UTF-16 to UTF-8 (RFC 2781, RFC 3629).
#include "runtime/base/text_encoding.h"

#include <cstdint>

namespace kinora {

namespace {

constexpr char32_t kReplacement = 0xfffd;

void append(std::string& out, char32_t c) {
    if (c < 0x80) {
        out += char(c);
        return;
    }
    int more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    constexpr unsigned kLead[] = {0, 0xc0, 0xe0, 0xf0};
    out += char(kLead[more] | c >> 6 * more);
    while (more-- > 0) out += char(0x80 | (c >> 6 * more & 0x3f));
}

bool is_lead(char32_t unit) {
    return unit >= 0xd800 && unit < 0xdc00;
}
bool is_trail(char32_t unit) {
    return unit >= 0xdc00 && unit < 0xe000;
}

}  // namespace

std::string utf8_text(std::string bytes) {
    bool little = bytes.starts_with("\xff\xfe"), big = bytes.starts_with("\xfe\xff");
    if (!little && !big) return bytes;
    size_t units = bytes.size() / 2;
    auto unit = [&](size_t i) -> char32_t {
        auto first = uint8_t(bytes[2 * i]), second = uint8_t(bytes[2 * i + 1]);
        return little ? char32_t(second << 8 | first) : char32_t(first << 8 | second);
    };
    std::string out;
    out.reserve(units);
    for (size_t i = 1; i < units; ++i) {
        char32_t c = unit(i);
        if (is_lead(c) && i + 1 < units && is_trail(unit(i + 1)))
            c = 0x10000 + ((c - 0xd800) << 10) + (unit(++i) - 0xdc00);
        append(out, is_lead(c) || is_trail(c) ? kReplacement : c);
    }
    if (bytes.size() % 2) append(out, kReplacement);
    return out;
}

}  // namespace kinora
