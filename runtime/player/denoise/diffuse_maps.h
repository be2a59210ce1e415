// runtime/player/denoise/diffuse_maps.h: the diffuse textures of profile_COMMON's materials, as the
// filter sees them: what they show is no noise.
#pragma once

#include "runtime/player/denoise/planes.h"

namespace kinora {

class TextureStore;  // runtime/scene/images/texture_store.h
struct SceneShaders;

// Fills Planes::albedo: the brightness of the texture that is bound to the slot `diffuse` (of glTF:
// `base_color`) at each pixel with a variance; 0 where the material has none. Filtered over what
// lies between a pixel and its right neighbor. `textures`: null without any.
void fill_albedo(const SceneShapes& scene, const SceneShaders& shaders, TextureStore* textures,
                 const FirstHits& hits, Planes& planes);

}  // namespace kinora
