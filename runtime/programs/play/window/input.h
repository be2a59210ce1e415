// runtime/programs/play/window/input.h: SDL's events for Dear ImGui: mouse, keys, text, clipboard.
#pragma once

#include "runtime/base/math.h"

union SDL_Event;

namespace kinora::play {

// Of the current ImGui context, once.
void connect_input();
// One event. Positions are times `scale`, the pixels of a unit of the window.
void take_event(const SDL_Event& event, float scale);
// What W A S D Q E say, by where they lie on the keyboard: -1 to 1 along right, up, forwards.
dvec3 steering();
// The pointer's form, as ImGui wants it.
void show_pointer();
void free_pointers();

}  // namespace kinora::play
