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

// d^2 / (area cos') of a sample from which L leads to a light that is as dense all over as on
// `area`.
float density_by_area(vec3 L, vec3 Ng, float area);

// Emission is found twice: by samples even in area, of that density by solid angle, and by rays of
// indirect light, whose density is up to 1 / PI. Each counts by its share of both (E. Veach and
// L. Guibas 1995, with the power 2 and a cutoff): the samples by this one, rays by the rest.
// Samples alone would be fireflies near a lamp, rays alone noise far from it.
float share_of_samples(float density);
// The same of what a ray from there meets of the light at a point of one of its triangles. Samples
// that are even in solid angle have all of it.
float share_of_samples(const AreaLight& light, vec3 from, const raytrace::HitBatch& hits,
                       uint32_t hit);

// How many samples each triangle of a light gets for its area: as many as it emits at its middle,
// and a tenth of the mean besides, since a texture may shine elsewhere. None where all are alike.
void find_powers(const ShadingFrame& frame, const KernelRunner& kernels, ThreadMemory& memory,
                 const AreaLight& light, std::vector<float>& powers);

}  // namespace kinora
