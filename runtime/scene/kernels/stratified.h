// runtime/scene/kernels/stratified.h: the service "stratified": numbers of a pixel's sequences.
#pragma once

#include "jit/ir/kernel_call.h"
#include "raytrace/random/series.h"

namespace kinora {

// `place`: what the points of the call's lanes share with others; null: nothing, so that each
// point has a sequence of its own.
void answer_stratified(const jit::ServiceCall& call, const raytrace::SampleSeries* place);

}  // namespace kinora
