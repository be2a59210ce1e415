// runtime/shading/bake.h: point files as shaders read them: the services texture3d and photons.
#pragma once

#include "runtime/shading/grid.h"

namespace kinora {

// Values near P: the mean of up to 8 of the file's points with normals to P's side, weighed by
// (1 - distance / that of the farthest)^2; exactly a point's own where P is that point.
void look_up_points(const KernelHost& host, const jit::ServiceCall& call);

// PhotonKind::Map and Caustic: the power of the nearest photons by the area of the disc that holds
// them (H. W. Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, eq. 7.6), channel
// "power". Subsurface: as texture3d of "_ssdiffusion", else of "_radiance_t".
void look_up_photons(const KernelHost& host, const jit::ServiceCall& call);

}  // namespace kinora
