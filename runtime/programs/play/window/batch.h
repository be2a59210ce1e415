// runtime/programs/play/window/batch.h: which events one turn of the window takes.
#pragma once

#include <SDL_events.h>

namespace kinora::play {

// ImGui sees states, so that a button that goes down and up in a turn would
// be lost, and so would the last step of a drag, and the order of keys: such an event waits for the
// next turn.
class Batch {
  public:
    // `pressed`: a button of the mouse is down as the turn begins.
    explicit Batch(bool pressed) : pressed_(pressed) {}

    bool takes(const SDL_Event& event) {
        switch (event.type) {
            case SDL_MOUSEBUTTONDOWN:
            case SDL_MOUSEBUTTONUP: {
                const unsigned bit = 1u << (event.button.button & 31);
                if (buttons_ & bit) return false;
                if (dragged_) return false;
                buttons_ |= bit;
                return true;
            }
            case SDL_KEYDOWN:
                if (key_) return false;
                key_ = true;
                return true;
            case SDL_KEYUP:
                return !key_;  // of Ctrl too: Ctrl+V is no V
            case SDL_MOUSEMOTION:
                if (buttons_) return false;  // a press is where it was
                dragged_ = pressed_;
                return true;
            default:
                return true;
        }
    }

  private:
    const bool pressed_;
    bool dragged_ = false, key_ = false;
    unsigned buttons_ = 0;
};

}  // namespace kinora::play
