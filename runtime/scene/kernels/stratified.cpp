// runtime/scene/kernels/stratified.cpp: numbers of a pixel's sequences, sixteen lanes at a time.
#include "runtime/scene/kernels/stratified.h"

#include "jit/ir/kernel.h"
#include "raytrace/random/bits.h"

namespace kinora {

void answer_stratified(const jit::ServiceCall& call, const raytrace::SampleSeries* place) {
    auto argument = [&](int row, int lane) {
        return uint32_t(jit::bits_of(call.args[row * jit::kMaxLanes + lane]));
    };
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        const raytrace::SampleSeries from =
            place ? place[lane] : raytrace::SampleSeries{argument(0, lane), 0, false};
        const raytrace::SampleSeries series = raytrace::series_of(from, argument(1, lane));
        const uint32_t index = series.part * argument(3, lane) + argument(2, lane);
        const uint32_t bits[2] = {
            raytrace::owen_scramble_reversed(index, raytrace::first_scramble(series.seed)),
            raytrace::owen_scramble_reversed(raytrace::sobol_second_reversed(index),
                                             raytrace::second_scramble(series.seed))};
        for (int k = 0; k < 2; ++k)  // 24 bits: never 1
            call.results[k * jit::kMaxLanes + lane] = float(bits[k] >> 8) * 0x1p-24f;
    }
}

}  // namespace kinora
