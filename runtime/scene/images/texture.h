// runtime/scene/images/texture.h: textures as shaders and scenes see them.
#pragma once

#include "jit/ir/kernel.h"
#include "runtime/base/math.h"
#include "runtime/scene/description/texture_name.h"

namespace kinora {

struct SceneDescription;
class TextureStore;

// The services "texture" and "environment" (rsl/model/services.def lists arguments and
// results). `store` answers for names. Thread-safe; without locks and allocations once the names
// have been met. A name is texture_name.h's string. s, t = 0, 0 is the lower left corner of the
// image; a lookup whose s or t is NaN, and one of the name "", gives the fill colour. Grey images
// answer as r = g = b. Channels the image has not are the fill colour; alpha, channel 3, is 1. An
// image that cannot be read gives magenta and black checks and a finding of TextureStore::report.
// Lookups are filtered as the shader says, at most by `best`.
void lookup_texture(const jit::ServiceCall& call, TextureStore& store,
                    TextureFilter best = TextureFilter::Anisotropic);

// The map is a latitude-longitude image, or one of six faces one above the other, as OpenEXR
// defines them. Of the first: y is up, the centre looks along +z and +x lies a quarter of the width
// left of it. R is taken as it is, in the map's own space. The direction 0 gives the fill colour.
void lookup_environment(const jit::ServiceCall& call, TextureStore& store,
                        TextureFilter best = TextureFilter::Anisotropic);

// The service "shadow": the share of the footprint of a point in "current" that lies behind what a
// depth map saw. The map is an image that holds the matrices worldtocamera and worldtoscreen (or
// worldtoNDC), as OpenImageIO names them, and depths in its first channel. Any other gives 0.
void lookup_shadow(const jit::ServiceCall& call, const dmat4& world_from_current,
                   TextureStore& store);

// The service "textureinfo". Fields: resolution, channels, type ("texture", "environment" or
// "shadow"), exists, viewingmatrix and projectionmatrix (world to camera, to screen).
void lookup_texture_info(const jit::ServiceCall& call, TextureStore& store);

// Reads, in parallel, the images named by the string parameters of a scene's materials and lights,
// so that no frame has to. Strings that name no file are no error: they may not be images at all.
void preload_textures(const SceneDescription& description, TextureStore& store);

// The same of the images that calls in the shaders' texts name. Where no point comes to a call its
// image is read for nothing.
void preload_named_pictures(const SceneDescription& description, TextureStore& store);

}  // namespace kinora
