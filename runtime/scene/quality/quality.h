// runtime/scene/quality/quality.h: the settings that trade speed for accuracy, and their named
// presets.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "anim/decompose.h"
#include "jit/math/math.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

enum class ShadowMode : uint8_t { Auto, Explicit, Off, All };
enum class DisplacementMode : uint8_t { True, Bump };
// How joints are blended: by their matrices, as COLLADA has it, or by dual quaternions.
enum class SkinMethod : uint8_t { Linear, Dual };
// How many lights of many are chosen for a point.
enum class ChosenLights : uint8_t {
    Auto,  // eight where there are many
    All,
    One,
    Two,
    Four,
    Eight,
    Sixteen,
    ThirtyTwo,
    SixtyFour
};

// A setting of each knob: a member a row of knobs.def, which explains it. A preset of --quality, or
// one with single options put over it. Requests and scenes hold it by value, and what obeys a knob
// reads its member there.
struct Quality {
    const char* name = "";  // of the preset
#define KNOB(type, member, value, ...) type member = value;
#include "runtime/scene/quality/knobs.def"
};

inline constexpr size_t kPresets = 4;
inline constexpr const char* kPresetNames[kPresets] = {"draft", "preview", "final", "reference"};
inline constexpr std::string_view kDefaultQuality = "final";

std::span<const Quality> qualities();                // in the order of kPresetNames
const Quality* find_quality(std::string_view name);  // null: no such preset

}  // namespace kinora
