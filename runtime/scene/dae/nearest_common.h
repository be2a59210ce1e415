// runtime/scene/dae/nearest_common.h: glTF's materials, and none, as COLLADA's shading models.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// A use of collada_*.sl, whose numbers stand in the description's values or behind them in
// `numbers`.
struct CommonSurface {
    ShaderUse use;
    std::vector<std::string> lost;  // what the model has no way to say
};

// gltf_unlit.sl, gltf_pbr.sl or default_surface.sl.
bool has_nearest_common(const ShaderUse& surface);

// The nearest look: <constant> for what is unlit, <lambert> for the default, else <blinn>. Its
// highlight is as high and as wide as that of GGX where the half vector is near the normal: with a
// = roughness ^ 2, F0 / (4 a^2) times a cosine to the power of 2 / a^2 - 2.
// `values` are the description's, at any time.
CommonSurface nearest_common(const ShaderUse& surface, std::span<const double> values,
                             std::vector<double>& numbers);

}  // namespace kinora
