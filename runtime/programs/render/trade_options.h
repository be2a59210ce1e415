// runtime/programs/render/trade_options.h: the options that measure or choose the trade of speed
// and accuracy.
#pragma once

#include "runtime/programs/common/command_line.h"
#include "runtime/programs/render/options.h"

namespace kinora {

// As they stand on the command line.
struct TradeGiven {
    std::string budget, target_error;
    CLI::Option* samples = nullptr;  // --spp
};

// After the knobs were declared.
void declare_trade(CLI::App& app, TradeGiven& given, RenderOptions& o);
// Throws CLI::Error where options do not go together.
void interpret_trade(const TradeGiven& given, RenderOptions& o);

}  // namespace kinora
