// runtime/trade/quality.h: the speed/accuracy trade: named presets of knob settings.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "anim/decompose.h"
#include "jit/math/math.h"
#include "runtime/images/image_io.h"
#include "runtime/scene/scene.h"

namespace kinora {

// One preset of --quality; an option given by itself wins over it. A member a row of knobs.def.
struct Quality {
    const char* name = "";
#define KNOB(type, member, ...) type member{};
#include "runtime/trade/knobs.def"
};

inline constexpr size_t kPresets = 4;
inline constexpr const char* kPresetNames[kPresets] = {"draft", "preview", "final", "reference"};
inline constexpr std::string_view kDefaultQuality = "final";

std::span<const Quality> qualities();                // in the order of kPresetNames
const Quality* find_quality(std::string_view name);  // null: no such preset

}  // namespace kinora
