// runtime/programs/tradeoff/trial.h: what renders cost, by small ones.
#pragma once

#include "runtime/programs/tradeoff/plan.h"
#include "runtime/programs/tradeoff/renders.h"

namespace kinora {

// Of scenes at `final` and `reference`; without what building takes. `width` and `height` are those
// asked for. The renders are left with a smaller size.
TrialCosts trial_costs(TradeRenders& renders, Scene& final_scene, Scene& reference_scene,
                       const TradeFrame& frame, int width, int height);

}  // namespace kinora
