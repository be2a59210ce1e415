// runtime/scene/kernels/stratified.h: the service "stratified": numbers of a pixel's sequences.
#pragma once

#include "jit/ir/kernel_call.h"
#include "runtime/scene/kernels/stratified_kernels.h"

namespace kinora {

// `places`: what the points of the call's lanes share with others.
void answer_stratified(const jit::ServiceCall& call, const SamplePlaces& places);

// Each point has a sequence of its own.
void answer_stratified(const jit::ServiceCall& call);

}  // namespace kinora
