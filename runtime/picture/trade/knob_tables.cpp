// runtime/picture/trade/knob_tables.cpp: the table of knobs as text, markdown and JSON.
#include "runtime/picture/trade/knob_tables.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

using Json = nlohmann::ordered_json;

// A choice's text, a number's value.
Json json_of(const Knob& knob, std::string_view text) {
    if (knob.kind == KnobKind::Choice) return text;
    return *knob_value(knob, text);
}

std::string knobs_text() {
    std::string text;
    for (const Knob& knob : knobs())
        text += fmt::format("--{:<14} {:<8} {:<22} {}\n", knob.option, knob.stage,
                            fmt::format("{}", fmt::join(knob.settings, " ")), knob.trades);
    for (const PlayKnob& knob : play_knobs())
        text += fmt::format("kinora-play: {:<3} {:<8} {:<22} {}\n", knob.command, knob.stage,
                            fmt::format("{}", fmt::join(knob.settings, " ")), knob.trades);
    return text;
}

std::string knobs_json() {
    Json rows = Json::array();
    for (const Knob& knob : knobs()) {
        Json row = {{"name", knob.option},      {"program", "kinora-render"}, {"stage", knob.stage},
                    {"error", knob.error},      {"trades", knob.trades},      {"help", knob.help},
                    {"settings", Json::array()}};
        for (std::string_view setting : knob.settings)
            row["settings"].push_back(json_of(knob, setting));
        for (size_t p = 0; p < kPresets; ++p)
            row["presets"][kPresetNames[p]] = json_of(knob, knob.presets[p]);
        rows.push_back(std::move(row));
    }
    for (const PlayKnob& knob : play_knobs())
        rows.push_back({{"name", knob.command},
                        {"program", "kinora-play"},
                        {"stage", knob.stage},
                        {"error", knob.error},
                        {"trades", knob.trades},
                        {"begin", knob.begin},
                        {"settings", knob.settings}});
    return rows.dump(2) + "\n";
}

std::string knobs_markdown() {
    std::string text =
        "| option | settings, fastest to reference | stage | error | what the fast end loses |\n"
        "|---|---|---|---|---|\n";
    for (const Knob& knob : knobs())
        text += fmt::format("| `--{}` | `{}` | {} | {} | {} |\n", knob.option,
                            fmt::join(knob.settings, " "), knob.stage, knob.error, knob.trades);
    text +=
        "\nPictures of kinora-play that are not refined have two more. Commands switch them.\n\n"
        "| command | settings, fastest to reference | at the start | stage | error | what the fast "
        "end loses |\n|---|---|---|---|---|---|\n";
    for (const PlayKnob& knob : play_knobs())
        text += fmt::format("| `{}` | `{}` | {} | {} | {} | {} |\n", knob.command,
                            fmt::join(knob.settings, " "), knob.begin, knob.stage, knob.error,
                            knob.trades);
    return text;
}

std::string presets_markdown() {
    std::string text = fmt::format("| option | {} |\n|---|", fmt::join(kPresetNames, " | "));
    for (size_t p = 0; p < kPresets; ++p) text += "---|";
    text += '\n';
    for (const Knob& knob : knobs()) {
        text += fmt::format("| `--{}` |", knob.option);
        for (std::string_view preset : knob.presets)
            // Presets alone may say 0 where an option's range begins at 1.
            text += fmt::format(" {} |", preset == "0" && knob.low > 0 ? "the file's" : preset);
        text += '\n';
    }
    return text;
}

struct Format {
    std::string_view name;
    std::string (*print)();
};
constexpr Format kFormats[] = {{"text", knobs_text},
                               {"json", knobs_json},
                               {"markdown", knobs_markdown},
                               {"presets", presets_markdown}};

}  // namespace

std::vector<std::string_view> knob_formats() {
    std::vector<std::string_view> names;
    for (const Format& format : kFormats) names.push_back(format.name);
    return names;
}

std::string print_knobs(std::string_view format) {
    for (const Format& row : kFormats)
        if (row.name == format) return row.print();
    return {};
}

}  // namespace kinora
