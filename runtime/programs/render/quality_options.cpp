// runtime/programs/render/quality_options.cpp: --quality, and an option for each knob.
#include "runtime/programs/render/quality_options.h"

#include <algorithm>
#include <span>

#include "runtime/picture/trade/knob_tables.h"

namespace kinora {

namespace {

std::vector<std::string_view> quality_names() {
    std::vector<std::string_view> names;
    for (const Quality& row : qualities()) names.push_back(row.name);
    return names;
}

// "samples per pixel (1, 4, 64, 1024)": what the presets have, unless the help says it.
std::string help_of(const Knob& knob) {
    if (knob.help.ends_with(')')) return std::string(knob.help);
    auto rest = std::span(knob.presets).subspan(1);
    bool same = std::ranges::all_of(rest, [&](auto& p) { return p == knob.presets[0]; });
    return same ? fmt::format("{} ({})", knob.help, knob.presets[0])
                : fmt::format("{} ({})", knob.help, fmt::join(knob.presets, ", "));
}

void declare_knob(CLI::App& app, const Knob& knob, GivenKnob& given) {
    std::string option = fmt::format("--{}", knob.option), help = help_of(knob);
    switch (knob.kind) {
        case KnobKind::Choice: {
            auto take = [&, option](const std::string& text) {
                given.choice = knob_value(knob, text);
                if (!given.choice) throw CLI::ValidationError(option, none_of(text, knob.words));
            };
            app.add_option_function<std::string>(option, take, help)->type_name("NAME");
            break;
        }
        case KnobKind::Whole:
            app.add_option(option, given.whole, help)
                ->check(CLI::Range(int(knob.low), int(knob.high)));
            break;
        case KnobKind::Real:
            app.add_option(option, given.real, help);
            break;
    }
}

}  // namespace

void declare_quality(CLI::App& app, QualityGiven& given, RenderOptions& o) {
    app.add_option("--quality", given.preset,
                   fmt::format("{} ({})", fmt::join(quality_names(), ", "), kDefaultQuality));
    for (size_t k = 0; k < knobs().size(); ++k) declare_knob(app, knobs()[k], given.knobs[k]);
    app.add_option("--dice-limit", given.dice_limit,
                   "most triangles of displaced surfaces (4000000)")
        ->check(CLI::Range(size_t(1), size_t(1) << 31));
    app.add_option("--filter-width", o.filter_width, "in pixels (the filter's own)");
    app.add_option("--seed", o.seed, "of all sampling (0)");
    app.add_option_function<std::string>(
           "--knobs",
           [](const std::string& format) {
               std::fputs(print_knobs(format).c_str(), stdout);
               throw CLI::Success();
           },
           fmt::format("prints the table of these settings: {}", fmt::join(knob_formats(), ", ")))
        ->check(one_of(knob_formats()))
        ->trigger_on_parse();
}

void interpret_quality(const QualityGiven& given, RenderOptions& o) {
    const bool chosen = !given.preset.empty();
    const Quality* row = find_quality(chosen ? given.preset : kDefaultQuality);
    o.fixed_settings = chosen;
    if (!row) throw CLI::ValidationError("--quality", none_of(given.preset, quality_names()));
    o.quality = *row;
    o.preset = row->name;
    for (size_t k = 0; k < knobs().size(); ++k) {
        const Knob& knob = knobs()[k];
        const GivenKnob& value = given.knobs[k];
        o.fixed_settings |= value.choice || value.whole || value.real;
        if (value.choice) knob.set(o.quality, *value.choice);
        if (value.whole) knob.set(o.quality, double(*value.whole));
        if (!value.real) continue;
        std::string takes = fmt::format("takes {} to {}", knob.low, knob.high);
        check_range(fmt::format("--{}", knob.option).c_str(), *value.real, knob.low, knob.high,
                    takes.c_str());
        knob.set(o.quality, *value.real);
    }
    o.dice_limit = given.dice_limit.value_or(0);
}

void check_range(const char* option, double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high)) throw CLI::ValidationError(option, what);
}

}  // namespace kinora
