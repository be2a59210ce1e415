// runtime/play/pixel_insight.h: what lies under a pixel, and the clicked pixel looked into.
#pragma once

#include <memory>

#include "runtime/play/picture/picture.h"
#include "runtime/play/pixel/pixel_story.h"
#include "runtime/play/render_loop.h"
#include "runtime/play/state.h"
#include "runtime/scene/scene.h"

namespace kinora {

// By a ray through the pixel's center, of the pose as the last frame has left it; the pixel is one
// of a picture of that width and height, of which `picture` (if it is there) gives the color.
PickedPixel pick_pixel(const Scene& scene, const Pose& pose, int x, int y, int width, int height,
                       const Picture* picture);

// How the first sample of the pixel in the refined picture came by its color. On the thread of the
// pictures.
std::shared_ptr<const PixelStory> story_of(ShownScene& scene, const ViewOrder& order, int x, int y);

}  // namespace kinora
