// runtime/player/picture/guide.h: what is at each pixel, by rays through their centers; and small
// pictures enlarged along the edges that these find.
#pragma once

#include <span>

#include "runtime/base/parallel.h"
#include "runtime/picture/shading/first_hits/first_hits.h"
#include "runtime/player/picture/picture.h"
#include "runtime/scene/pose.h"

namespace kinora {

// Of the scene as it stands, for a picture of that size with the scene's view.
void make_guide(const Pose& pose, int width, int height, PictureGuide& guide);

// The same of the first hits of a film that was just rendered: a guide of its size.
void take_guide(const FirstHits& hits, const raytrace::Camera& camera, PictureGuide& guide);

// As make_guide(), with rays only beside edges of a smaller guide: elsewhere that one's pixels are
// taken, and enlarge() does the same with both.
void refine_guide(const Pose& pose, const PictureGuide& small, int width, int height,
                  PictureGuide& guide);

// `small` to a picture of that size, by a guide of any. A pixel mixes the four small ones around
// it; those that lie on another surface, face elsewhere or are at another depth count next to
// nothing.
void enlarge(const raytrace::Film& small, const PictureGuide& guide, int width, int height,
             raytrace::Film& out);
// The same row by row, in any order and on all threads: take(y, pixels of the row).
using TakeRow = FunctionRef<void(int y, std::span<const vec4> pixels)>;
void enlarge_rows(const raytrace::Film& small, const PictureGuide& guide, int width, int height,
                  TakeRow take);

}  // namespace kinora
