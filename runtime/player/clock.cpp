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

double place_of(const TimeState& time, double frame) {
    if (!time.film) return frame;
    const size_t k = time.film->at(frame);
    constexpr double kMost = 1 - 1e-9;  // a gap is as short as any other step
    return double(k) + std::clamp(frame - time.film->frames[k].number, 0.0, kMost);
}

double frame_at(const TimeState& time, double place) {
    if (!time.film) return place;
    const std::vector<FilmFrame>& frames = time.film->frames;
    const double k = std::clamp(std::floor(place), 0.0, double(frames.size() - 1));
    return frames[size_t(k)].number + std::clamp(place - k, 0.0, 1.0);
}

double whole_frame(const TimeState& time, double frame) {
    return time.film ? time.film->frames[time.film->at(frame)].number : std::round(frame);
}

namespace {

// The frame becomes the one at a place, if that is in the range that plays.
void go_to_place(TimeState& time, double place) {
    const double first = place_of(time, range_first(time)), last = place_of(time, range_last(time));
    time.frame = place;
    confine(time, first, last, last - first + 1);
    time.frame = frame_at(time, time.frame);
}

}  // namespace

void advance_time(TimeState& time, double rate, double seconds) {
    if (time.playing) go_to_place(time, place_of(time, time.frame) + time.speed * rate * seconds);
}

void advance_one_frame(TimeState& time) {
    if (time.playing)
        go_to_place(time,
                    place_of(time, whole_frame(time, time.frame)) + (time.speed < 0 ? -1 : 1));
}

}  // namespace kinora
