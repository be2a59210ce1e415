// runtime/picture/shading/lighting/counted_samples.cpp
#include "runtime/picture/shading/lighting/counted_samples.h"

#include <algorithm>

#include "raytrace/sampling.h"

namespace kinora {

namespace {

std::span<const LightSampleRows*> rows_of(const LightAnswer& answer, Arena& arena) {
    size_t count = 0;
    for (const LightSampleRows* rows = answer.first(); rows; rows = rows->next) ++count;
    std::span<const LightSampleRows*> all = arena.allocate_span<const LightSampleRows*>(count);
    count = 0;
    for (const LightSampleRows* rows = answer.first(); rows; rows = rows->next) all[count++] = rows;
    return all;
}

}  // namespace

CountedSamples::CountedSamples(const LightAnswer& answer, const LightPoints& at, uint32_t most,
                               uint32_t light, Arena& arena)
    : sent_(answer.counts()),
      rows_(rows_of(answer, arena)),
      counts_(arena.allocate_span<float>(padded(at.count))),
      starts_(arena.allocate_span<float>(padded(at.count))),
      most_(most ? std::min(size_t(most), rows_.size()) : rows_.size()) {
    for (size_t i = 0; i < counts_.size(); ++i) {
        const size_t point = std::min(i, at.count - 1);
        counts_[i] = std::min(sent_[i], float(most_));
        starts_[i] = float(raytrace::unit_interval(
            raytrace::hash(at.series[point].seed, raytrace::hash(light, 0x9b05688cu))));
    }
}

const LightSampleRows* CountedSamples::find(size_t k, size_t point) const {
    const float counted = counts_[point], sent = sent_[point];
    if (!(float(k) < counted)) return nullptr;
    if (!(sent > counted)) return rows_[k];
    const auto chosen = size_t((float(k) + starts_[point]) * (sent / counted));
    return rows_[std::min(chosen, size_t(sent) - 1)];
}

}  // namespace kinora
