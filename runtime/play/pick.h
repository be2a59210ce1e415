// runtime/play/pick.h: what lies under a pixel.
#pragma once

#include "runtime/play/picture.h"
#include "runtime/play/state.h"
#include "runtime/scene/scene.h"

namespace kinora {

// By a ray through the pixel's center, of the scene as the last frame has left it; the pixel is one
// of a picture of that width and height, of which `picture` (if it is there) gives the color.
PickedPixel pick_pixel(const Scene& scene, int x, int y, int width, int height,
                       const Picture* picture);

}  // namespace kinora
