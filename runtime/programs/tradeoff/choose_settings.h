// runtime/programs/tradeoff/choose_settings.h: the settings for --target-ms and --target-error.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kinora/open_scene.h"
#include "runtime/picture/trade/target.h"

namespace kinora {

struct SettingsRequest {
    const SceneRequest& scene;
    const ImportedScene& imported;  // not yet built
    // Number and seconds; the middle one is probed. For a time: those to render. For an error: the
    // same for all parts of the shot.
    std::vector<std::pair<int64_t, double>> frames{};
    FrameTarget target{};
    bool fixed = false;         // the command line says the settings: samples alone are chosen
    std::string measured{};     // tradeoff.json or its folder; "": none
    std::string fingerprint{};  // as --tradeoff has it
    const std::atomic<int>* stop = nullptr;
};

struct ChosenSettings {
    Quality quality{};
    FrameCost cost{};         // of a time: what a probe says of its frames
    int fewest_samples = 1;   // of an error: with which its settings were measured
    double noise_target = 0;  // of an error: what is left for the noise
    std::string from{};       // "preview", "combination 3 of out/tradeoff.json"
    std::string said{};       // what a user is told of it besides
};

// Probes the presets, or takes a row of what was measured. For a time, probing ends after 5 % of
// what the shot may take, or 20 s if that is more. Nothing, with the reason: no settings reach the
// target, the scene gives no picture, or it was stopped.
std::optional<ChosenSettings> choose_settings(const SettingsRequest& request,
                                              Diagnostics& diagnostics, std::string& why_not);

// The error of one picture against another of the same size.
double target_error(const raytrace::Film& picture, const raytrace::Film& reference,
                    TargetMetric metric);

}  // namespace kinora
