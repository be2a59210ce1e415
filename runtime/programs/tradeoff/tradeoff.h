// runtime/programs/tradeoff/tradeoff.h: kinora-render --tradeoff: what each setting of each knob
// costs on a scene, and what it gets wrong.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kinora/open_scene.h"
#include "runtime/programs/tradeoff/results.h"

namespace kinora {

struct TradeoffRequest {
    const SceneRequest& scene;
    const ImportedScene& imported;                     // not yet built
    std::vector<std::pair<int64_t, double>> frames{};  // to choose from: number, seconds
    std::string fingerprint{};                         // of what pictures depend on besides knobs
    double budget_s = 120;
    size_t combinations = 24;
    bool tell = true;  // the plan and how far it is, on stderr
    const std::atomic<int>* stop = nullptr;
};

// Renders the scene with all variants. False: stopped, or the scene gives no picture.
bool measure_tradeoff(const TradeoffRequest& request, Diagnostics& diagnostics,
                      TradeResults& results);

std::string tradeoff_json(const TradeResults& results);
std::string tradeoff_csv(const TradeResults& results);
// One page that needs nothing else.
std::string tradeoff_html(const TradeResults& results);
// The presets, for a terminal.
std::string tradeoff_text(const TradeResults& results);

// tradeoff.json, .csv and .html in the folder, which is made. An exit code; stderr says what could
// not be written.
int write_tradeoff(const TradeResults& results, const std::string& folder);
// Likewise before anything is measured: whether the folder can be written to.
int try_tradeoff_folder(const std::string& folder);

}  // namespace kinora
