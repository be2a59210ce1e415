// runtime/player/show_picture.h: what a picture shows of its film.
#pragma once

#include "runtime/player/display.h"
#include "runtime/player/picture/picture.h"

namespace kinora {

// Fills `rgba` and `numbers` of a picture that has all else, and draws rays over it. A film of
// another size is enlarged by the guide, through `enlarged` where bytes alone do not do.
void show_picture(DisplaySettings settings, raytrace::Film& enlarged, Picture& to);

}  // namespace kinora
