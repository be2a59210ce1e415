// runtime/picture/shading/lighting/emission.h: what surfaces show without other light: the light of
// those that emit.
#pragma once

#include "runtime/picture/shading/lighting/area_light.h"

namespace kinora {

class KernelRunner;

// Ci of the surfaces at samples of a light, without lights and rays, as it is seen from the lit
// points; `lit` is the grid that the light's kernel runs on. What is no number or negative is 0.
void find_emission(const ShadingFrame& frame, const KernelRunner& kernels, const Grid& lit,
                   const LightSamples& samples, const LightPoints& at, std::span<vec3> emission);

// How many samples each triangle of a light gets for its area: as many as it emits at its middle,
// and a tenth of the mean besides, since a texture may shine elsewhere. None where all are alike.
void find_powers(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
                 const AreaLight& light, std::vector<float>& powers);

}  // namespace kinora
