// runtime/scene/quality/knobs.h: the rows of knobs.def as values that programs can walk.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/quality/quality.h"

namespace kinora {

enum class KnobKind : uint8_t { Choice, Whole, Real };

// A row; knobs.def explains the columns.
struct Knob {
    KnobKind kind;
    std::string_view option;  // "spp" for --spp; its name in tradeoff.json
    std::vector<std::string_view> words;
    double low, high;
    std::vector<std::string_view> settings;
    std::array<std::string_view, kPresets> presets;
    std::string_view stage, error, trades, help;
    double (*get)(const Quality&);  // of a choice: the index of its word
    void (*set)(Quality&, double);
};

std::span<const Knob> knobs();

// A row of kinora-play alone.
struct PlayKnob {
    std::string_view command;  // of runtime/player/commands.def, which switches it
    std::vector<std::string_view> settings;
    std::string_view begin, stage, error, trades;
};
std::span<const PlayKnob> play_knobs();

const Knob* find_knob(std::string_view option);  // null: no such knob

// What an option's text means, as `get` gives it; nothing: no such word, or no number. A choice is
// found whatever its case. Ranges are the caller's.
std::optional<double> knob_value(const Knob& knob, std::string_view text);
bool set_knob(const Knob& knob, std::string_view text, Quality& quality);
// The shortest text that means it: "64", "1.3", "precise".
std::string knob_text(const Knob& knob, const Quality& quality);
// All of them: "spp=64 filter=gaussian ...". Qualities are equal where these texts are.
std::string knob_texts(const Quality& quality);

}  // namespace kinora
