// runtime/base/numbers.h: numbers in texts, whatever the locale of the process is.
#pragma once

#include <charconv>
#include <optional>
#include <span>
#include <string_view>

namespace kinora {

// The number that a text begins with, spaces and a "+" before it allowed, and takes it off the
// text. Nothing, and the text as it was, where it begins with none or with one that T does not
// hold. "inf" and "nan" are floats.
template <class T>
std::optional<T> take_number(std::string_view& text) {
    std::string_view rest = text;
    while (!rest.empty() && (rest[0] == ' ' || (rest[0] >= '\t' && rest[0] <= '\r')))
        rest.remove_prefix(1);
    if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
    T value{};
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error != std::errc()) return std::nullopt;
    text = rest.substr(size_t(end - rest.data()));
    return value;
}

// The number that a whole text is.
template <class T>
std::optional<T> number_of(std::string_view text) {
    const std::optional<T> value = take_number<T>(text);
    return text.empty() ? value : std::nullopt;
}

// Takes as many numbers as `out` has, parted by `separator`, off the text. False, and `out` half
// written, where they are fewer.
template <class T>
bool take_numbers(std::string_view& text, char separator, std::span<T> out) {
    for (size_t i = 0; i < out.size(); ++i) {
        if (i > 0) {
            if (!text.starts_with(separator)) return false;
            text.remove_prefix(1);
        }
        const std::optional<T> value = take_number<T>(text);
        if (!value) return false;
        out[i] = *value;
    }
    return true;
}

// Whether a whole text is so many numbers.
template <class T>
bool read_numbers(std::string_view text, char separator, std::span<T> out) {
    return take_numbers(text, separator, out) && text.empty();
}

}  // namespace kinora
