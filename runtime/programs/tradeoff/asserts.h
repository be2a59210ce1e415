// runtime/programs/tradeoff/asserts.h: what a trade-off must come to: --assert.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/programs/tradeoff/results.h"

namespace kinora {

// "preset=final:flip<0.01": an error (or "ms", CPU time) of a preset, and its bound.
struct TradeAssert {
    std::string text, preset, metric;
    bool below = true;  // '<'; else '>'
    double bound = 0;
};

// Nothing, with a text in `error`, where it is none or names what there is not.
std::optional<TradeAssert> parse_trade_assert(const std::string& text, std::string& error);

// What does not hold, a line each: "preset=final:flip<0.01: flip is 0.02". An error that the noise
// hides counts as it is; what was not measured holds nothing.
std::vector<std::string> broken_asserts(const TradeResults& results,
                                        const std::vector<TradeAssert>& asserts);

}  // namespace kinora
