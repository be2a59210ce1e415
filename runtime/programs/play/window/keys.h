// runtime/programs/play/window/keys.h: keys by the names that the table of commands has.
#pragma once

#include <string>

union SDL_Event;

namespace kinora::play {

// "Ctrl+Shift+S", "Left", "F12", "[" of a key event; "" of a modifier alone. Signs that Shift makes
// ("?") are named as they are typed on that keyboard's plain key.
std::string key_name(int key, unsigned modifiers);

}  // namespace kinora::play
