// runtime/player/clock.h: how the frame shown moves as seconds go by.
#pragma once

#include "runtime/player/state.h"

namespace kinora {

// The range that plays: in and out where they are set, else the whole.
double range_first(const TimeState& time);
double range_last(const TimeState& time);

// Where a frame lies among those that there are. A film's lie side by side, whatever their numbers,
// and the first is at 0; else a frame's place is its number.
double place_of(const TimeState& time, double frame);
double frame_at(const TimeState& time, double place);
// The frame where nothing plays. In a film it is the one whose picture is seen, else the nearest.
double whole_frame(const TimeState& time, double frame);

// `seconds` of playback at `rate` frames a second. At the range's ends it begins again, turns back
// or stops, as the mode says. Loops count the last frame as long as every other.
void advance_time(TimeState& time, double rate, double seconds);

// One frame on in the direction it plays, for playback that shows every frame.
void advance_one_frame(TimeState& time);

}  // namespace kinora
