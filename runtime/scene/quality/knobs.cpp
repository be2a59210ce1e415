// runtime/scene/quality/knobs.cpp: the rows of knobs.def, read and written as texts.
#include "runtime/scene/quality/knobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <concepts>

#include "runtime/base/check.h"

namespace kinora {

namespace {

std::vector<std::string_view> words_in(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        size_t end = std::min(text.find(' '), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

template <class T>
constexpr KnobKind kind_of(bool has_words) {
    if (has_words) return KnobKind::Choice;
    return std::floating_point<T> ? KnobKind::Real : KnobKind::Whole;
}

std::vector<Knob> make_knobs() {
    return {
#define KNOB(type, member, value_, option, words, low, high, settings, draft, preview, final_, \
             reference, stage, error, trades, help)                                            \
    Knob{kind_of<type>(sizeof(words) > 1),                                                     \
         option,                                                                               \
         words_in(words),                                                                      \
         low,                                                                                  \
         high,                                                                                 \
         words_in(settings),                                                                   \
         {draft, preview, final_, reference},                                                  \
         stage,                                                                                \
         error,                                                                                \
         trades,                                                                               \
         help,                                                                                 \
         [](const Quality& q) { return double(q.member); },                                    \
         [](Quality& q, double value) { q.member = type(value); }},
#include "runtime/scene/quality/knobs.def"
    };
}

std::vector<PlayKnob> make_play_knobs() {
    return {
#define PLAY_KNOB(command, settings, begin, stage, error, trades) \
    PlayKnob{command, words_in(settings), begin, stage, error, trades},
#include "runtime/scene/quality/knobs.def"
    };
}

bool same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](char x, char y) { return std::tolower(uint8_t(x)) == std::tolower(uint8_t(y)); });
}

}  // namespace

std::span<const Knob> knobs() {
    static const std::vector<Knob> table = make_knobs();
    return table;
}

std::span<const PlayKnob> play_knobs() {
    static const std::vector<PlayKnob> table = make_play_knobs();
    return table;
}

const Knob* find_knob(std::string_view option) {
    for (const Knob& knob : knobs())
        if (knob.option == option) return &knob;
    return nullptr;
}

std::optional<double> knob_value(const Knob& knob, std::string_view text) {
    for (size_t w = 0; w < knob.words.size(); ++w)
        if (same_word(text, knob.words[w])) return double(w);
    if (knob.kind == KnobKind::Choice) return std::nullopt;
    double value = 0;
    const char* last = text.data() + text.size();
    auto [end, error] = std::from_chars(text.data(), last, value);
    bool whole = knob.kind == KnobKind::Real || value == std::floor(value);
    if (error != std::errc() || end != last || !whole) return std::nullopt;
    return value;
}

bool set_knob(const Knob& knob, std::string_view text, Quality& quality) {
    std::optional<double> value = knob_value(knob, text);
    if (value) knob.set(quality, *value);
    return value.has_value();
}

std::string knob_text(const Knob& knob, const Quality& quality) {
    double value = knob.get(quality);
    if (knob.kind != KnobKind::Choice) return fmt::format("{}", value);
    CHECK_LT(size_t(value), knob.words.size());
    return std::string(knob.words[size_t(value)]);
}

std::string knob_texts(const Quality& quality) {
    std::string text;
    for (const Knob& knob : knobs())
        text +=
            fmt::format("{}{}={}", text.empty() ? "" : " ", knob.option, knob_text(knob, quality));
    return text;
}

}  // namespace kinora
