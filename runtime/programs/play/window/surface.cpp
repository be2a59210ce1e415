// runtime/programs/play/window/surface.cpp: SDL's window surface; our RGBA to its format.
#include "runtime/programs/play/window/surface.h"

#include <SDL.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "runtime/base/memory/pages.h"
#include "runtime/programs/play/window/libsdl_p.h"

namespace kinora::play {

namespace {

// The format that X11 and Wayland have: b g r x.
void to_bgrx(const uint32_t* from, uint32_t* to, int count) {
    for (int i = 0; i < count; ++i) {
        const uint32_t p = from[i];
        to[i] = (p & 0xff00ff00u) | (p & 0xff) << 16 | (p >> 16 & 0xff);
    }
}

}  // namespace

Surface::Surface(const std::string& title, const WindowBounds& bounds) {
    if (!sdl().error().empty()) throw std::runtime_error(sdl().error());
    // Without a session bus SDL would start one for this process alone: a copy of it, and a wait.
    setenv("DBUS_SESSION_BUS_ADDRESS", "disabled:", 0);
    // Measured: 0.4 ms a frame this way, 7 to 13 ms through OpenGL.
    sdl().SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    sdl().SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    sdl().SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    sdl().SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
    sdl().SDL_SetHint(SDL_HINT_MOUSE_FOCUS_CLICKTHROUGH, "1");
    // Without a folder for Wayland's socket that driver only complains.
    if (!std::getenv("XDG_RUNTIME_DIR") && !std::getenv("SDL_VIDEODRIVER")) {
        if (!std::getenv("DISPLAY"))
            throw std::runtime_error("neither DISPLAY nor WAYLAND_DISPLAY leads to one");
        sdl().SDL_SetHint(SDL_HINT_VIDEODRIVER, "x11");
    }
    if (sdl().SDL_InitSubSystem(SDL_INIT_VIDEO) != 0)
        throw std::runtime_error(sdl().SDL_GetError());
    // SDL's last resort is a driver that shows nothing: only for those who name it.
    const std::string driver = sdl().SDL_GetCurrentVideoDriver();
    if ((driver == "offscreen" || driver == "dummy") && !std::getenv("SDL_VIDEODRIVER")) {
        sdl().SDL_QuitSubSystem(SDL_INIT_VIDEO);
        throw std::runtime_error("neither DISPLAY nor WAYLAND_DISPLAY leads to one");
    }
    const auto flags = static_cast<uint32_t>(SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI |
                                             (bounds.maximized ? SDL_WINDOW_MAXIMIZED : 0));
    window_ = sdl().SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                     bounds.width, bounds.height, flags);
    if (!window_ || !sdl().SDL_GetWindowSurface(window_)) {
        const std::string reason = sdl().SDL_GetError();
        if (window_) sdl().SDL_DestroyWindow(window_);
        sdl().SDL_QuitSubSystem(SDL_INIT_VIDEO);
        throw std::runtime_error(reason);
    }
    sdl().SDL_SetWindowMinimumSize(window_, 480, 320);
    sdl().SDL_EventState(SDL_DROPFILE, SDL_ENABLE);
}

Surface::~Surface() {
    sdl().SDL_DestroyWindow(window_);
    sdl().SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

Target Surface::frame() {
    const SDL_Surface* surface = sdl().SDL_GetWindowSurface(window_);
    if (!surface || surface->w <= 0 || surface->h <= 0) return target_ = {};
    // The X server shares them: a fault for each one took twice as long (4 MB: 20.7 ms, now 9.1).
    if (std::exchange(mapped_, surface->pixels) != surface->pixels)
        provide_pages(surface->pixels,
                      static_cast<size_t>(surface->h) * static_cast<size_t>(surface->pitch));
    pixels_.resize(static_cast<size_t>(surface->w) * static_cast<size_t>(surface->h));
    return target_ = {pixels_.data(), surface->w, surface->h, surface->w};
}

void Surface::present() {
    SDL_Surface* surface = sdl().SDL_GetWindowSurface(window_);
    if (!surface || !target_.pixels || surface->w != target_.width || surface->h != target_.height)
        return;
    if (SDL_MUSTLOCK(surface)) sdl().SDL_LockSurface(surface);
    auto* to = static_cast<uint8_t*>(surface->pixels);
    if (surface->format->format == SDL_PIXELFORMAT_RGB888 ||
        surface->format->format == SDL_PIXELFORMAT_ARGB8888) {
        for (int y = 0; y < surface->h; ++y)
            to_bgrx(pixels_.data() + static_cast<size_t>(y) * static_cast<size_t>(target_.width),
                    reinterpret_cast<uint32_t*>(to + y * surface->pitch), surface->w);
    } else {
        sdl().SDL_ConvertPixels(surface->w, surface->h, SDL_PIXELFORMAT_RGBA32, pixels_.data(),
                                target_.width * 4, surface->format->format, to, surface->pitch);
    }
    if (SDL_MUSTLOCK(surface)) sdl().SDL_UnlockSurface(surface);
    sdl().SDL_UpdateWindowSurface(window_);
}

int Surface::width() const {
    int width = 0;
    sdl().SDL_GetWindowSize(window_, &width, nullptr);
    return width;
}

int Surface::height() const {
    int height = 0;
    sdl().SDL_GetWindowSize(window_, nullptr, &height);
    return height;
}

float Surface::pixels_per_unit() const {
    const SDL_Surface* surface = sdl().SDL_GetWindowSurface(window_);
    const int units = width();
    return surface && units > 0 ? static_cast<float>(surface->w) / static_cast<float>(units) : 1;
}

float Surface::display_scale() const {
    float dots = 96;
    const int display = std::max(sdl().SDL_GetWindowDisplayIndex(window_), 0);
    if (sdl().SDL_GetDisplayDPI(display, nullptr, &dots, nullptr) != 0 || !(dots > 0)) dots = 96;
    const float wanted = std::round(dots / 96 / pixels_per_unit() * 4) / 4;
    return std::clamp(wanted, 1.0f, 3.0f);
}

bool Surface::full_screen() const {
    return sdl().SDL_GetWindowFlags(window_) & SDL_WINDOW_FULLSCREEN_DESKTOP;
}

void Surface::set_full_screen(bool on) {
    sdl().SDL_SetWindowFullscreen(window_, on ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

bool Surface::hidden() const {
    return sdl().SDL_GetWindowFlags(window_) & (SDL_WINDOW_MINIMIZED | SDL_WINDOW_HIDDEN);
}

WindowBounds Surface::bounds() const {
    WindowBounds bounds{width(), height(), false};
    bounds.maximized = sdl().SDL_GetWindowFlags(window_) & SDL_WINDOW_MAXIMIZED;
    return bounds;
}

void Surface::set_title(const std::string& title) {
    sdl().SDL_SetWindowTitle(window_, title.c_str());
}

}  // namespace kinora::play
