// runtime/programs/tradeoff/asserts.cpp: reads and checks them.
#include "runtime/programs/tradeoff/asserts.h"

#include <fmt/format.h>

#include <charconv>

namespace kinora {

namespace {

constexpr std::string_view kTakes =
    "takes preset=NAME:ERROR<NUMBER, such as preset=final:flip<0.01";
constexpr std::string_view kTime = "ms";

std::string known_errors() {
    std::string names(kTime);
    for (const TradeMetric& metric : trade_metrics()) names += fmt::format(", {}", metric.name);
    return names;
}

std::string broken_by(const TradeResults& results, const TradeAssert& wanted) {
    size_t preset = size_t(find_quality(wanted.preset) - qualities().data());
    if (preset >= results.rows.size() || !results.rows[preset].measured())
        return fmt::format("{}: {} was not measured", wanted.text, wanted.preset);
    const TradeRow& row = results.rows[preset];
    const TradeMetric* metric = find_trade_metric(wanted.metric);
    double value = metric ? metric->get(row.errors) : row.times.ms.median;
    // Not a number holds nothing.
    bool holds = wanted.below ? value < wanted.bound : value > wanted.bound;
    if (holds) return "";
    bool noise = metric && within_floor(*metric, row.errors, results.floor);
    return fmt::format("{}: {} is {:.4g}{}", wanted.text, wanted.metric, value,
                       noise ? ", which is within the noise of the reference: a larger --budget "
                               "may lower it"
                             : "");
}

}  // namespace

std::optional<TradeAssert> parse_trade_assert(const std::string& text, std::string& error) {
    constexpr std::string_view kBegin = "preset=";
    TradeAssert parsed{.text = text, .preset = "", .metric = ""};
    size_t colon = text.find(':'), sign = text.find_first_of("<>");
    error = fmt::format("{}; not '{}'", kTakes, text);
    if (!text.starts_with(kBegin) || colon == std::string::npos || sign == std::string::npos ||
        sign < colon)
        return std::nullopt;
    parsed.preset = text.substr(kBegin.size(), colon - kBegin.size());
    parsed.metric = text.substr(colon + 1, sign - colon - 1);
    parsed.below = text[sign] == '<';
    const char* last = text.data() + text.size();
    auto [end, code] = std::from_chars(text.data() + sign + 1, last, parsed.bound);
    if (code != std::errc() || end != last) return std::nullopt;
    if (!find_quality(parsed.preset)) {
        error = fmt::format("'{}' is no preset: draft, preview, final, reference", parsed.preset);
        return std::nullopt;
    }
    if (parsed.metric != kTime && !find_trade_metric(parsed.metric)) {
        error = fmt::format("'{}' is none of {}", parsed.metric, known_errors());
        return std::nullopt;
    }
    error.clear();
    return parsed;
}

std::vector<std::string> broken_asserts(const TradeResults& results,
                                        const std::vector<TradeAssert>& asserts) {
    std::vector<std::string> broken;
    for (const TradeAssert& wanted : asserts)
        if (std::string text = broken_by(results, wanted); !text.empty()) broken.push_back(text);
    return broken;
}

}  // namespace kinora
