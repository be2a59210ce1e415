// runtime/player/clock.cpp: time goes on: to the range's end, round it, or to and fro.
#include "runtime/player/clock.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

double modulo(double x, double period) {
    double rest = std::fmod(x, period);
    return rest < 0 ? rest + period : rest;
}

// Into [first, last] by the mode. `length` is that of a round.
void confine(TimeState& time, double first, double last, double round) {
    if (time.frame >= first && time.frame < first + round && time.loop == LoopMode::Loop) return;
    switch (time.loop) {
        case LoopMode::Loop:
            time.frame = first + modulo(time.frame - first, round);
            return;
        case LoopMode::PingPong: {
            double length = last - first;
            if (length <= 0) {
                time.frame = first;
                return;
            }
            double at = modulo(time.frame - first, 2 * length);
            bool back = at > length;
            if (time.frame < first || time.frame > last) {
                // Which way it goes after so many turns.
                bool forward = time.speed > 0;
                double walked = forward ? time.frame - first : last - time.frame;
                if (int64_t(std::floor(walked / length)) % 2 != 0) time.speed = -time.speed;
            }
            time.frame = first + (back ? 2 * length - at : at);
            return;
        }
        case LoopMode::Once:
            if (time.frame < first || time.frame > last) time.playing = false;
            time.frame = std::clamp(time.frame, first, last);
            return;
    }
}

}  // namespace

double range_first(const TimeState& time) {
    return time.in.value_or(time.first);
}

double range_last(const TimeState& time) {
    return std::max(time.out.value_or(time.last), range_first(time));
}

void advance_time(TimeState& time, double rate, double seconds) {
    if (!time.playing) return;
    double first = range_first(time), last = range_last(time);
    time.frame += time.speed * rate * seconds;
    confine(time, first, last, last - first + 1);
}

void advance_one_frame(TimeState& time) {
    if (!time.playing) return;
    double first = range_first(time), last = range_last(time);
    time.frame = std::round(time.frame) + (time.speed < 0 ? -1 : 1);
    confine(time, first, last, last - first + 1);
}

}  // namespace kinora
