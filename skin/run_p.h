// skin/run_p.h: a kernel by its name, run over a skin.
#pragma once

#include <span>

#include "skin/skin.h"

namespace kinora::skin {

enum class Blending : uint8_t { Linear, Dual };

// As deform and deform_dual have them; the palette holds 16 floats a joint.
struct DeformArrays {
    const SkinMesh& skin;
    const float* palette;
    std::span<const vec4> rest_positions, rest_normals;
    std::span<vec4> positions, normals;
};

void run_kernel(const char* name, Blending blending, const DeformArrays& arrays);

}  // namespace kinora::skin
