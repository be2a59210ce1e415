// runtime/programs/validate/escaped_text.cpp: text inside JSON, XML and URIs.
#include "runtime/programs/validate/escaped_text.h"

#include <fmt/format.h>
#include <utf8.h>

#include <cmath>

namespace kinora {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

// Calls take(piece) for each character, with U+FFFD for each byte that is part of none.
template <class Take>
void each_character(std::string_view text, Take take) {
    const char *at = text.data(), *end = at + text.size();
    while (at < end) {
        for (const char* valid = utf8::find_invalid(at, end); at < valid;) {
            const char* first = at;
            utf8::unchecked::next(at);
            take(std::string_view(first, size_t(at - first)));
        }
        if (at == end) break;
        take(kReplacement);
        ++at;
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
