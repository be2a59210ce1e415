// runtime/programs/play/window/libsdl_p.h: SDL, opened with the first window. It brings fifty other
// libraries along: a scene is being read meanwhile, and without a window none of them is loaded.
#pragma once

#include <SDL.h>

#include "runtime/base/shared_library.h"

namespace kinora::play {

struct Sdl : SharedLibrary {
    Sdl() : SharedLibrary(KINORA_SDL_LIBRARY, "windows are shown", "libsdl2-2.0-0") {}

    KINORA_FUNCTION(SDL_ConvertPixels);
    KINORA_FUNCTION(SDL_CreateSystemCursor);
    KINORA_FUNCTION(SDL_CreateWindow);
    KINORA_FUNCTION(SDL_DestroyWindow);
    KINORA_FUNCTION(SDL_EventState);
    KINORA_FUNCTION(SDL_FreeCursor);
    KINORA_FUNCTION(SDL_GetClipboardText);
    KINORA_FUNCTION(SDL_GetCurrentVideoDriver);
    KINORA_FUNCTION(SDL_GetDisplayDPI);
    KINORA_FUNCTION(SDL_GetError);
    KINORA_FUNCTION(SDL_GetKeyName);
    KINORA_FUNCTION(SDL_GetKeyboardState);
    KINORA_FUNCTION(SDL_GetWindowDisplayIndex);
    KINORA_FUNCTION(SDL_GetWindowFlags);
    KINORA_FUNCTION(SDL_GetWindowSize);
    KINORA_FUNCTION(SDL_GetWindowSurface);
    KINORA_FUNCTION(SDL_InitSubSystem);
    KINORA_FUNCTION(SDL_LockSurface);
    KINORA_FUNCTION(SDL_PollEvent);
    KINORA_FUNCTION(SDL_PushEvent);
    KINORA_FUNCTION(SDL_QuitSubSystem);
    KINORA_FUNCTION(SDL_RegisterEvents);
    KINORA_FUNCTION(SDL_SetClipboardText);
    KINORA_FUNCTION(SDL_SetCursor);
    KINORA_FUNCTION(SDL_SetHint);
    KINORA_FUNCTION(SDL_SetWindowFullscreen);
    KINORA_FUNCTION(SDL_SetWindowMinimumSize);
    KINORA_FUNCTION(SDL_SetWindowTitle);
    KINORA_FUNCTION(SDL_StartTextInput);
    KINORA_FUNCTION(SDL_UnlockSurface);
    KINORA_FUNCTION(SDL_UpdateWindowSurface);
    KINORA_FUNCTION(SDL_WaitEvent);
    KINORA_FUNCTION(SDL_WaitEventTimeout);
    KINORA_FUNCTION(SDL_free);
};

inline const Sdl& sdl() {
    return opened<Sdl>();
}

}  // namespace kinora::play
