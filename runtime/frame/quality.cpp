// runtime/frame/quality.cpp: the table of qualities (docs/decisions.md#speed-against-accuracy).
#include "runtime/frame/quality.h"

namespace kinora {

namespace {
using jit::math::Tier;
constexpr Quality kQualities[] = {
    // name       spp   math            robust  displacement   dice  rebuild  rays  bounces  split
    {"draft", 1, Tier::Fast, false, DisplacementMode::Bump, 8, false, 4, 1, 1},
    {"preview", 4, Tier::Fast, true, DisplacementMode::True, 4, false, 8, 1, 1},
    {"final", 64, Tier::Precise, true, DisplacementMode::True, 2, false, 16, 1, 1},
    {"reference", 1024, Tier::Precise, true, DisplacementMode::True, 1, true, 16, 2, 2},
};
}  // namespace

std::span<const Quality> qualities() {
    return kQualities;
}

const Quality* find_quality(std::string_view name) {
    for (const Quality& quality : kQualities)
        if (name == quality.name) return &quality;
    return nullptr;
}

}  // namespace kinora
