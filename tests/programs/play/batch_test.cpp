// tests/programs/play/batch_test.cpp: events that come in one turn of a slow window.
#include "runtime/programs/play/window/batch.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kinora::play {
namespace {

SDL_Event event(uint32_t type, int what = 0) {
    SDL_Event made{};
    made.type = type;
    if (type == SDL_MOUSEBUTTONDOWN || type == SDL_MOUSEBUTTONUP)
        made.button.button = static_cast<uint8_t>(what);
    if (type == SDL_KEYDOWN || type == SDL_KEYUP)
        made.key.keysym.scancode = static_cast<SDL_Scancode>(what);
    return made;
}

// m: the mouse moves; D, U: its left button; R, r: its right one; K, k: a key down and up; J, j:
// another one, Ctrl say. The turns that they fall into when they are all there at once, parted by
// '|'.
std::string turns(const std::string& events) {
    std::string out;
    bool pressed = false;
    for (size_t at = 0; at < events.size();) {
        Batch batch(pressed);
        if (at > 0) out += '|';
        for (size_t first = at; at < events.size(); ++at) {
            const char c = events[at];
            const SDL_Event one = c == 'm'   ? event(SDL_MOUSEMOTION)
                                  : c == 'D' ? event(SDL_MOUSEBUTTONDOWN, 1)
                                  : c == 'U' ? event(SDL_MOUSEBUTTONUP, 1)
                                  : c == 'R' ? event(SDL_MOUSEBUTTONDOWN, 3)
                                  : c == 'r' ? event(SDL_MOUSEBUTTONUP, 3)
                                  : c == 'K' ? event(SDL_KEYDOWN, 4)
                                  : c == 'J' ? event(SDL_KEYDOWN, 5)
                                  : c == 'j' ? event(SDL_KEYUP, 5)
                                             : event(SDL_KEYUP, 4);
            if (!batch.takes(one)) {
                EXPECT_GT(at, first) << "a turn that takes nothing";
                break;
            }
            if (c == 'D') pressed = true;
            if (c == 'U') pressed = false;
            out += c;
        }
    }
    return out;
}

TEST(Batch, AClickTakesTwoTurns) {
    EXPECT_EQ(turns("mDU"), "mD|U");
    EXPECT_EQ(turns("mDUmDU"), "mD|U|mD|U");
    EXPECT_EQ(turns("mDUDU"), "mD|U|D|U");
}

// The button comes up where the mouse is by then: the way there is seen with the button down.
TEST(Batch, ADragKeepsItsLastStep) {
    EXPECT_EQ(turns("mDmmmU"), "mD|mmm|U");
    EXPECT_EQ(turns("mDmUmDmU"), "mD|m|U|mD|m|U");
    EXPECT_EQ(turns("DmRmrU"), "D|m|R|m|rU");
}

TEST(Batch, KeysKeepTheirOrder) {
    EXPECT_EQ(turns("Kk"), "K|k");
    EXPECT_EQ(turns("KJk"), "K|J|k");
    EXPECT_EQ(turns("JKjk"), "J|K|jk") << "Ctrl is still down in the turn that sees V";
    EXPECT_EQ(turns("mKm"), "mKm");
}

}  // namespace
}  // namespace kinora::play
