// runtime/picture/shading/lighting/lamp_probe.h: which samples suit a light on geometry.
#pragma once

#include "runtime/picture/shading/lighting/area_light.h"

namespace kinora {

class KernelRunner;

// Whether samples of a light that are even in the solid angle of its shape vary no more than those
// by area, at points about it. So it is where Cl falls with the square of the distance and the
// cosine, as that of a lamp of one radiance does; not where a shader sends the same light from all
// points, or from elsewhere. The light's kernel decides, by some of its samples. A light without a
// shape has none by angle.
bool suits_by_angle(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
                    const AreaLight& light, size_t number,
                    std::span<const LightOutputs> statements);

}  // namespace kinora
