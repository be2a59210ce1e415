// runtime/play/guide.h: what is at each pixel, by rays through their centers; and small pictures
// enlarged along the edges that these find.
#pragma once

#include "runtime/play/picture.h"
#include "runtime/scene/scene.h"

namespace kinora {

// Of the scene as it stands, for a picture of that size with the scene's view.
void make_guide(const Scene& scene, int width, int height, PictureGuide& guide);

// `small` to a picture of that size. The guide has the same size, or half of it, rounded up, in
// both directions. A pixel mixes the four small ones around it; those that lie on
// another surface, face elsewhere or are at another depth count next to nothing.
void enlarge(const raytrace::Film& small, const PictureGuide& guide, int width, int height,
             raytrace::Film& out);

}  // namespace kinora
