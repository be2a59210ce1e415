// runtime/scene/quality/quality.cpp: the presets, from the table of knobs.
#include "runtime/scene/quality/quality.h"

#include <array>

#include "runtime/base/check.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

std::span<const Quality> qualities() {
    static const std::array<Quality, kPresets> presets = [] {
        std::array<Quality, kPresets> made;
        for (size_t p = 0; p < kPresets; ++p) {
            made[p].name = kPresetNames[p];
            for (const Knob& knob : knobs()) CHECK(set_knob(knob, knob.presets[p], made[p]));
        }
        return made;
    }();
    return presets;
}

const Quality* find_quality(std::string_view name) {
    for (const Quality& quality : qualities())
        if (name == quality.name) return &quality;
    return nullptr;
}

}  // namespace kinora
