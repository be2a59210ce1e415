// runtime/programs/play/window/surface.h: a window without OpenGL, and its pixels.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/programs/play/raster/raster.h"

struct SDL_Window;

namespace kinora::play {

struct WindowBounds {
    int width = 1280, height = 800;
    bool maximized = false;
};

class Surface {
  public:
    // Throws std::runtime_error with SDL's words where there is no display.
    Surface(const std::string& title, const WindowBounds& bounds);
    ~Surface();
    Surface(const Surface&) = delete;

    // Memory for a frame, of the window's present size in pixels; empty while it has none.
    Target frame();
    // Shows what frame() gave.
    void present();

    // Of the window's units, in which the mouse is told, and how many pixels one of them has.
    int width() const;
    int height() const;
    float pixels_per_unit() const;
    // Of text and widgets, by the display's dots an inch: 1, 1.25 ... 3.
    float display_scale() const;

    bool full_screen() const;
    void set_full_screen(bool on);
    bool hidden() const;  // minimised, or covered as far as the system tells
    WindowBounds bounds() const;
    void set_title(const std::string& title);

  private:
    SDL_Window* window_ = nullptr;
    std::vector<uint32_t> pixels_;
    Target target_;
    const void* mapped_ = nullptr;  // the pixels whose pages are there
};

}  // namespace kinora::play
