// runtime/programs/tradeoff/survey.h: which settings do anything in a scene, found by small
// renders.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "runtime/programs/tradeoff/renders.h"

namespace kinora {

struct SurveyedVariant {
    bool same = false;  // as its base: the bits of all pictures, and the work that was counted
    double weight = 1;  // CPU time of a sample, to one of `final`
};

struct SurveyRequest {
    std::span<const Variant> variants{};  // the presets first
    std::span<const TradeFrame> frames{};
    PosedScene *preview_scene = nullptr, *final_scene = nullptr;  // scenes at these presets
    int width = 0, height = 0;                                    // asked for
    double most_ms = 0;  // variants that come later are not looked at
};

// One for each variant. `how` says what was rendered: "32x24 pixels with 4 samples". The renders
// are left with a smaller size. Settings of samples and of the traversal never count as the same:
// what they save is not counted.
std::vector<SurveyedVariant> survey_variants(TradeRenders& renders, const SurveyRequest& request,
                                             std::string& how);

}  // namespace kinora
