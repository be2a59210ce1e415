// runtime/programs/tradeoff/thumbnails.h: small pictures of pictures and of their errors.
#pragma once

#include "runtime/picture/compare/picture.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

// PNG files in memory, at most 192 pixels wide: means of blocks of pixels.
std::vector<uint8_t> picture_thumbnail(const raytrace::Film& film, ColorEncoding encoding);
// FLIP from black over violet and orange to white, 0 to 1 by its root, so that little shows too.
std::vector<uint8_t> flip_thumbnail(const Plane& flip);

}  // namespace kinora
