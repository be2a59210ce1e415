// runtime/scene/description/texture_name.cpp: texture names to strings and back:
// "path\x1fwwfd b b b b c s u u u u m i x": wraps, filter, data; border, turn, uv; mip, bias,
// level.
#include "runtime/scene/description/texture_name.h"
#include "runtime/base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace kinora {

namespace {
constexpr char kSeparator = '\x1f';
constexpr std::string_view kWrapLetters = "wmcb";

char filter_letter(const TextureName& name) {
    if (name.nearest || (name.nearest_magnified && name.nearest_minified)) return 'n';
    return name.nearest_magnified ? 'g' : name.nearest_minified ? 's' : 'l';
}
}  // namespace

std::string texture_name_string(const TextureName& name) {
    TextureName plain;
    bool is_plain = name.wrap_s == plain.wrap_s && name.wrap_t == plain.wrap_t &&
                    filter_letter(name) == 'l' && !name.data && name.mip == plain.mip &&
                    name.mip_bias == plain.mip_bias && name.mip_max_level == plain.mip_max_level &&
                    name.border == plain.border && name.turn == plain.turn && name.uv == plain.uv;
    if (is_plain) return name.path;
    return fmt::format("{}{}{}{}{}{} {} {} {} {} {} {}", name.path, kSeparator,
                       kWrapLetters[size_t(name.wrap_s)], kWrapLetters[size_t(name.wrap_t)],
                       filter_letter(name), name.data ? 'd' : 'c', fmt::join(name.border, " "),
                       fmt::join(name.turn, " "), fmt::join(name.uv, " "), int(name.mip),
                       name.mip_bias, name.mip_max_level);
}

TextureName parse_texture_name(std::string_view text) {
    TextureName name;
    size_t separator = text.find(kSeparator);
    name.path = std::string(text.substr(0, separator));
    if (separator == std::string_view::npos || text.size() < separator + 5) return name;
    std::string rest(text.substr(separator + 1));
    name.wrap_s = TextureWrap(kWrapLetters.find(rest[0]) & 3);
    name.wrap_t = TextureWrap(kWrapLetters.find(rest[1]) & 3);
    name.nearest = rest[2] == 'n';
    name.nearest_magnified = rest[2] == 'g';
    name.nearest_minified = rest[2] == 's';
    name.data = rest[3] == 'd';
    std::string_view numbers = text.substr(separator + 5);
    for (float* value :
         {&name.border[0], &name.border[1], &name.border[2], &name.border[3], &name.turn[0],
          &name.turn[1], &name.uv[0], &name.uv[1], &name.uv[2], &name.uv[3]}) {
        *value = take_number<float>(numbers).value_or(0.0f);
    }
    name.mip = TextureMip(std::clamp(take_number<int>(numbers).value_or(0), 0, 2));
    name.mip_bias = take_number<float>(numbers).value_or(0.0f);
    name.mip_max_level = uint8_t(std::clamp(take_number<int>(numbers).value_or(0), 0, 255));
    return name;
}

namespace {

struct WordRow {
    std::string_view word;
    bool (*is)(const TextureName&);
    void (*set)(TextureName&);
};
constexpr WordRow kWords[] = {
    {"data", [](const TextureName& n) { return n.data; }, [](TextureName& n) { n.data = true; }},
    {"nearest", [](const TextureName& n) { return filter_letter(n) == 'n'; },
     [](TextureName& n) { n.nearest = true; }},
    {"clamp_s", [](const TextureName& n) { return n.wrap_s == TextureWrap::Clamp; },
     [](TextureName& n) { n.wrap_s = TextureWrap::Clamp; }},
    {"clamp_t", [](const TextureName& n) { return n.wrap_t == TextureWrap::Clamp; },
     [](TextureName& n) { n.wrap_t = TextureWrap::Clamp; }},
    {"mirror_s", [](const TextureName& n) { return n.wrap_s == TextureWrap::Mirror; },
     [](TextureName& n) { n.wrap_s = TextureWrap::Mirror; }},
    {"mirror_t", [](const TextureName& n) { return n.wrap_t == TextureWrap::Mirror; },
     [](TextureName& n) { n.wrap_t = TextureWrap::Mirror; }},
    {"black_s", [](const TextureName& n) { return n.wrap_s == TextureWrap::Border; },
     [](TextureName& n) { n.wrap_s = TextureWrap::Border; }},
    {"black_t", [](const TextureName& n) { return n.wrap_t == TextureWrap::Border; },
     [](TextureName& n) { n.wrap_t = TextureWrap::Border; }},
};

}  // namespace

std::optional<std::string> texture_words(const TextureName& name) {
    std::string words;
    TextureName said;
    said.path = name.path;
    for (const WordRow& row : kWords) {
        if (!row.is(name)) continue;
        words += fmt::format("{}{}", words.empty() ? "" : ",", row.word);
        row.set(said);
    }
    if (texture_name_string(said) != texture_name_string(name)) return std::nullopt;
    return words;
}

bool set_texture_words(std::string_view words, TextureName& name) {
    bool all_known = true;
    while (!words.empty()) {
        std::string_view word = words.substr(0, words.find(','));
        words.remove_prefix(std::min(words.size(), word.size() + 1));
        bool known = false;
        for (const WordRow& row : kWords) {
            if (row.word != word) continue;
            row.set(name);
            known = true;
        }
        all_known &= known;
    }
    return all_known;
}

}  // namespace kinora
