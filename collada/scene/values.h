// collada/scene/values.h: numbers that animation can write, and how they are named.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/base/math.h"

namespace kinora::collada {

inline constexpr uint32_t kNone = ~0u;

// Up to 16 numbers that a channel can write.
struct Slot {
    std::array<double, 16> values{};
    uint8_t count = 0;  // 0: absent from the file (values then hold the format's default, if any)
    std::string sid;
    Location where;
    bool present() const { return count > 0; }
};

// --- what a channel or a <bind target> names ----------------------------------------------------

enum class Owner : uint8_t {
    None,
    Transform,      // nodes[owner].transforms[slot]
    Light,          // lights[owner].slots[slot]      (slot = LightSlot)
    Camera,         // cameras[owner].slots[slot]     (slot = CameraSlot)
    EffectParam,    // effects[owner].params[slot].value
    EffectCommon,   // effects[owner].common.slots[slot]  (slot = CommonSlot)
    MaterialParam,  // materials[owner].setparams[slot].value
    MorphWeight,    // morphs[owner].weights, the whole list; component = weight index
};

struct TargetRef {
    Owner kind = Owner::None;
    uint32_t owner = kNone;
    uint32_t slot = 0;
    uint32_t first = 0;         // first component of the slot's values that is written
    uint32_t count = 0;         // how many in a row
    bool whole_matrix = false;  // all 16 of a <matrix>: decomposed when LINEAR
};

}  // namespace kinora::collada
