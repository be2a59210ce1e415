// runtime/programs/play/window/keys.cpp: SDL's key events to names.
#include "runtime/programs/play/window/keys.h"

#include <SDL.h>

#include "runtime/programs/play/window/libsdl_p.h"

namespace kinora::play {

namespace {

bool is_modifier(int key) {
    switch (key) {
        case SDLK_LCTRL:
        case SDLK_RCTRL:
        case SDLK_LSHIFT:
        case SDLK_RSHIFT:
        case SDLK_LALT:
        case SDLK_RALT:
        case SDLK_LGUI:
        case SDLK_RGUI:
        case SDLK_MODE:
        case SDLK_CAPSLOCK:
        case SDLK_NUMLOCKCLEAR:
            return true;
        default:
            return false;
    }
}

// The number pad does what the keys do that it stands for.
int plain_key(int key) {
    if (key >= SDLK_KP_1 && key <= SDLK_KP_9) return SDLK_1 + (key - SDLK_KP_1);
    switch (key) {
        case SDLK_KP_0:
            return SDLK_0;
        case SDLK_KP_ENTER:
            return SDLK_RETURN;
        case SDLK_KP_PLUS:
            return SDLK_PLUS;
        case SDLK_KP_MINUS:
            return SDLK_MINUS;
        default:
            return key;
    }
}

}  // namespace

std::string key_name(int key, unsigned modifiers) {
    if (is_modifier(key)) return {};
    const std::string name = sdl().SDL_GetKeyName(plain_key(key));
    if (name.empty()) return {};
    std::string out;
    if (modifiers & KMOD_CTRL) out += "Ctrl+";
    if (modifiers & KMOD_ALT) out += "Alt+";
    if (modifiers & KMOD_SHIFT) out += "Shift+";
    return out + name;
}

}  // namespace kinora::play
