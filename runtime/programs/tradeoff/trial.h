// runtime/programs/tradeoff/trial.h: what renders cost, by small ones.
#pragma once

#include "runtime/programs/tradeoff/plan.h"
#include "runtime/programs/tradeoff/renders.h"

namespace kinora {

struct TrialRequest {
    PosedScene &final_scene, &reference_scene;  // scenes at these presets
    const TradeFrame& frame;
    int width = 0, height = 0;  // asked for
    double budget_ms = 0;
};

// Without what building takes. By a small frame, then by one of the size asked for, if that takes
// little of the budget. The renders are left with some size of these.
TrialCosts trial_costs(TradeRenders& renders, const TrialRequest& request);

}  // namespace kinora
