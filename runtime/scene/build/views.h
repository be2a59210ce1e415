// runtime/scene/build/views.h: the directions that scenes are looked at from when no camera of
// theirs is.
#pragma once

#include <span>
#include <string_view>

#include "runtime/scene/build/framing.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// A word that --camera takes instead of a name.
struct ViewWord {
    std::string_view word;
    double right, up, back;  // where the eye is, in the up axis' frame
    bool parallel;           // unless a field of view is asked for
};
std::span<const ViewWord> view_words();
const ViewWord* find_view(std::string_view word);  // null: it is none

// The frame of COLLADA's up_axis (1.4.1, chapter 5): right, up and towards the viewer.
ViewAxes up_axis_frame(UpAxis up);

// Of a view towards the eye in direction `back`, of any length; `frame` says what is up. Straight
// from above and below, right stays right.
ViewAxes axes_towards(dvec3 back, const ViewAxes& frame);

}  // namespace kinora
