// runtime/player/pixel/draw_rays.h: a pixel's rays as lines over a picture, of whatever camera.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "raytrace/camera.h"
#include "runtime/player/pixel/pixel_story.h"

namespace kinora {

// Where a picture of that camera shows a segment, in its pixels from the top left corner; nothing
// where that lies behind the camera. `from` and `to`: world space; `origin`: of the camera's space.
std::optional<std::pair<dvec2, dvec2>> seen_segment(const raytrace::Camera& camera, dvec3 origin,
                                                    dvec3 from, dvec3 to);

// White: of the eye; blue: reflected and the like; yellow: to a light; red: to a light, blocked.
// Those that meet nothing are faint. `rgba` is a picture of width x height, whatever size the
// camera's is.
void draw_rays(std::span<const StoryRay> rays, const raytrace::Camera& camera, dvec3 origin,
               int width, int height, std::vector<uint8_t>& rgba);

}  // namespace kinora
