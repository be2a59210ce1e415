// runtime/trade/knob_tables.cpp: the table of knobs as text, markdown and JSON.
#include "runtime/trade/knob_tables.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "runtime/trade/knobs.h"

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
    return text;
}

std::string knobs_json() {
    Json rows = Json::array();
    for (const Knob& knob : knobs()) {
        Json row = {{"name", knob.option},   {"stage", knob.stage}, {"error", knob.error},
                    {"trades", knob.trades}, {"help", knob.help},   {"settings", Json::array()}};
        for (std::string_view setting : knob.settings)
            row["settings"].push_back(json_of(knob, setting));
        for (size_t p = 0; p < kPresets; ++p)
            row["presets"][kPresetNames[p]] = json_of(knob, knob.presets[p]);
        rows.push_back(std::move(row));
    }
    return rows.dump(2) + "\n";
}

std::string knobs_markdown() {
    std::string text =
        "| option | settings, fastest to reference | stage | error | what the fast end loses |\n"
        "|---|---|---|---|---|\n";
    for (const Knob& knob : knobs())
        text += fmt::format("| `--{}` | `{}` | {} | {} | {} |\n", knob.option,
                            fmt::join(knob.settings, " "), knob.stage, knob.error, knob.trades);
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

Json number(double low) {
    return {{"type", "number"}, {"minimum", low}};
}

// The settings of a row: each knob, and nothing else.
Json settings_schema() {
    Json schema = {{"type", "object"}, {"additionalProperties", false}};
    for (const Knob& knob : knobs()) {
        Json& property = schema["properties"][std::string(knob.option)];
        if (knob.kind == KnobKind::Choice)
            property = {{"enum", knob.words}};
        else
            property = {{"type", knob.kind == KnobKind::Whole ? "integer" : "number"}};
        property["description"] = knob.help;
        schema["required"].push_back(knob.option);
    }
    return schema;
}

Json object_schema(Json properties) {
    Json schema = {{"type", "object"}, {"additionalProperties", false}};
    for (const auto& [name, value] : properties.items()) schema["required"].push_back(name);
    schema["properties"] = std::move(properties);
    return schema;
}

Json errors_schema() {
    Json share = {{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
    Json bound = {{"type", Json::array({"number", "null"})}};  // null: infinite
    return object_schema({{"non_finite", number(0)},
                          {"mask_mismatch", share},
                          {"rmse", bound},
                          {"relative_mse", bound},
                          {"psnr", bound},
                          {"ssim", {{"type", "number"}, {"minimum", -1}, {"maximum", 1}}},
                          {"flip", share},
                          {"flip_p99", share},
                          {"hdr_flip", share}});
}

Json row_schema() {
    Json text = {{"type", "string"}};
    Json row = object_schema({{"name", text},
                              {"kind", {{"enum", {"preset", "knob", "combination"}}}},
                              {"around", text},
                              {"knob", text},
                              {"stage", text},
                              {"settings", settings_schema()},
                              {"measured", {{"type", "boolean"}}}});
    Json more = {{"ms", number(0)},
                 {"ms_low", number(0)},
                 {"ms_high", number(0)},
                 {"ratio", number(0)},
                 {"ratio_low", number(0)},
                 {"ratio_high", number(0)},
                 {"times", number(1)},
                 {"errors", errors_schema()},
                 {"below_floor", {{"type", "boolean"}}},
                 {"on_front", {{"type", "boolean"}}}};
    row["if"] = {{"properties", {{"measured", {{"const", true}}}}}};
    for (const auto& [name, value] : more.items()) {
        row["then"]["required"].push_back(name);
        row["properties"][name] = value;
    }
    row["properties"]["why_not"] = text;
    row["else"]["required"] = {"why_not"};
    return row;
}

}  // namespace

std::string tradeoff_schema() {
    Json text = {{"type", "string"}}, count = {{"type", "integer"}, {"minimum", 0}};
    Json schema = object_schema(
        {{"program", text},
         {"fingerprint", text},
         {"scene", text},
         {"target", text},
         {"threads", count},
         {"width", count},
         {"height", count},
         {"frames", {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "integer"}}}}},
         {"reference_samples", count},
         {"budget_seconds", number(0)},
         {"spent_seconds", number(0)},
         {"reference_seconds", number(0)},
         {"noise_floor", errors_schema()},
         {"rows", {{"type", "array"}, {"items", row_schema()}}}});
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "tradeoff.json of kinora-render --tradeoff";
    return schema.dump(2) + "\n";
}

namespace {

struct Format {
    std::string_view name;
    std::string (*print)();
};
constexpr Format kFormats[] = {{"text", knobs_text},
                               {"json", knobs_json},
                               {"schema", tradeoff_schema},
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
