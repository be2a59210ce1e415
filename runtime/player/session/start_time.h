// runtime/player/session/start_time.h: when a scene begins that is opened.
#pragma once

namespace kinora {

struct StartTime {
    double at = 0;  // frames, or seconds
    bool in_seconds = false;
    double frame(double rate) const { return in_seconds ? at * rate : at; }
};

}  // namespace kinora
