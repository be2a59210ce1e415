// runtime/play/pixel_insight.h: the clicked pixel of an order, looked into.
#pragma once

#include <memory>

#include "runtime/play/pixel/pixel_story.h"
#include "runtime/play/render_loop.h"

namespace kinora {

// How the first sample of the pixel in the refined picture came by its color. On the thread of the
// pictures.
std::shared_ptr<const PixelStory> story_of(ShownScene& scene, const ViewOrder& order, int x, int y);

}  // namespace kinora
