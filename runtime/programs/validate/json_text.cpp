// runtime/programs/validate/json_text.cpp: escapes.
#include "runtime/programs/validate/json_text.h"

#include <fmt/format.h>

#include <cmath>

namespace kinora {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Bytes of the UTF-8 sequence at `at`; 0 if there is none. Overlong forms, surrogates and what lies
// beyond U+10FFFF are none (Unicode, table 3-7).
size_t sequence_length(std::string_view text, size_t at) {
    auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : uint8_t(0); };
    uint8_t first = byte(at), second = byte(at + 1);
    if (first < 0x80) return 1;
    size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(at + i) & 0xC0) != 0x80) return 0;
    if (first == 0xE0 && second < 0xA0) return 0;
    if (first == 0xED && second > 0x9F) return 0;
    if (first == 0xF0 && second < 0x90) return 0;
    if (first == 0xF4 && second > 0x8F) return 0;
    return length;
}

// Calls take(piece) for each character, with U+FFFD for bytes that are none.
template <class Take>
void each_character(std::string_view text, Take take) {
    for (size_t at = 0; at < text.size();) {
        size_t length = sequence_length(text, at);
        take(length ? text.substr(at, length) : kReplacement);
        at += length ? length : 1;
    }
}

}  // namespace

std::string valid_utf8(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    each_character(text, [&](std::string_view c) { out += c; });
    return out;
}

std::string json_string(std::string_view text) {
    std::string out = "\"";
    each_character(text, [&](std::string_view c) {
        uint8_t first = uint8_t(c[0]);
        if (first == '"' || first == '\\')
            (out += '\\') += char(first);
        else if (first == '\n')
            out += "\\n";
        else if (first == '\t')
            out += "\\t";
        else if (first < 0x20 || first == 0x7F)
            out += fmt::format("\\u{:04x}", first);
        else
            out += c;
    });
    return out += '"';
}

std::string json_number(double number) {
    return std::isfinite(number) ? fmt::format("{}", number) : "null";
}

std::string xml_text(std::string_view text) {
    std::string out;
    each_character(text, [&](std::string_view c) {
        uint8_t first = uint8_t(c[0]);
        if (first == '&')
            out += "&amp;";
        else if (first == '<')
            out += "&lt;";
        else if (first == '>')
            out += "&gt;";
        else if (first == '"')
            out += "&quot;";
        else if (first == '\n' || first == '\t')
            out += char(first);
        else if (first < 0x20 || c == "\xEF\xBF\xBE" || c == "\xEF\xBF\xBF")
            out += kReplacement;
        else
            out += c;
    });
    return out;
}

std::string uri_of_path(std::string_view path) {
    constexpr std::string_view kPlain = "-._~/!$&'()*+,;=@";
    std::string out = path.starts_with('/') ? "file://" : "";
    for (char c : path) {
        bool letter = std::isalnum(uint8_t(c)) && uint8_t(c) < 0x80;
        if (letter || kPlain.find(c) != kPlain.npos)
            out += c;
        else
            out += fmt::format("%{:02X}", uint8_t(c));
    }
    return out;
}

}  // namespace kinora
