// runtime/quality.cpp: the table of qualities (DESIGN.md section 6).
#include "runtime/quality.h"

namespace kinora {

namespace {
using jit::math::Tier;
constexpr Quality kQualities[] = {
    // name       spp   math            robust  displacement   dice  rebuild
    {"draft", 1, Tier::Fast, false, DisplacementMode::Bump, 8, false},
    {"preview", 4, Tier::Fast, true, DisplacementMode::True, 4, false},
    {"final", 64, Tier::Precise, true, DisplacementMode::True, 2, false},
    {"reference", 1024, Tier::Precise, true, DisplacementMode::True, 1, true},
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
