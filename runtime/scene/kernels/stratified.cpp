// runtime/scene/kernels/stratified.cpp: numbers of a pixel's sequences, sixteen lanes at a time.
#include "runtime/scene/kernels/stratified.h"

#include "jit/ir/kernel.h"
#include "rsl/model/renderer_services.h"

namespace kinora {

namespace {

const float* argument(const jit::ServiceCall& call, int row) {
    return call.args + row * jit::kMaxLanes;
}

consteval int row_of(std::string_view name) {
    return rsl::service_argument(rsl::Service::stratified, name).first;
}

}  // namespace

void answer_stratified(const jit::ServiceCall& call, const SamplePlaces& places) {
    static_assert(kSampleLanes == jit::kMaxLanes);
    stratified_kernels().draw(places, argument(call, row_of("sequence")),
                              argument(call, row_of("index")), argument(call, row_of("count")),
                              call.results);
}

void answer_stratified(const jit::ServiceCall& call) {
    SamplePlaces places{};
    for (int lane = 0; lane < kSampleLanes; ++lane)
        places.seed[lane] = uint32_t(jit::bits_of(argument(call, row_of("point"))[lane]));
    answer_stratified(call, places);
}

}  // namespace kinora
