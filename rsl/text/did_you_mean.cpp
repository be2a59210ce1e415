// rsl/text/did_you_mean.cpp: near names of the language, which has many of one or two letters.
#include "rsl/text/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

// "Pp": a letter that was hit twice, or held a key long.
bool doubled(std::string_view word, std::string_view letter) {
    return letter.size() == 1 && word.size() == 2 && lower(word[0]) == lower(letter[0]) &&
           lower(word[1]) == lower(letter[0]);
}

// "noiz": all but the last letter of one and the last two of the other.
bool same_beginning(std::string_view word, std::string_view name) {
    constexpr size_t kLeast = 3;
    size_t longer = std::max(word.size(), name.size());
    size_t shorter = std::min(word.size(), name.size());
    if (shorter <= kLeast || longer > shorter + 1) return false;
    return word.substr(0, shorter - 1) == name.substr(0, shorter - 1);
}

}  // namespace

bool same_letters(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view did_you_mean(std::string_view word, const std::vector<std::string_view>& names) {
    auto first = [&](auto fits) {
        auto found = std::find_if(names.begin(), names.end(),
                                  [&](std::string_view name) { return fits(word, name); });
        return found == names.end() ? std::string_view() : *found;
    };
    if (std::string_view name = first(same_letters); !name.empty()) return name;
    if (std::string_view name = first(doubled); !name.empty()) return name;
    std::string_view near = nearest_name(word, names);
    // Any letter is near any other.
    return near.size() > 1 ? near : first(same_beginning);
}

std::string meant_help(std::string_view word, const std::vector<std::string_view>& names) {
    std::string_view name = did_you_mean(word, names);
    return name.empty() ? "" : fmt::format("did you mean '{}'?", name);
}

}  // namespace kinora::rsl
