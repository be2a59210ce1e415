// runtime/scene/images/texture_p.h: what the files of texture services share.
#pragma once

#include "runtime/scene/images/texture_sample.h"
#include "runtime/scene/images/texture_store.h"

namespace kinora {

// The texture of a name, null for ""; one that cannot be read is noted as asked for.
const Texture* find_texture(TextureStore& store, int32_t name);

// An environment of six faces: the lanes of `mask`, whose directions are finite and not 0.
void lookup_cube(const StoredImage& image, const jit::ServiceCall& call, uint32_t mask);

}  // namespace kinora
