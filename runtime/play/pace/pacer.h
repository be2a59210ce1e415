// runtime/play/pace/pacer.h: how many pixels a frame may have so that playback holds its rate.
// Times in, sizes out; it reads no clock.
#pragma once

#include <array>
#include <cstddef>

namespace kinora {

class Pacer {
  public:
    // Frames are to take that many ms. The next sizes follow; what is known of times is kept.
    void aim_at(double frame_ms) { target_ = frame_ms; }
    // Share of the picture's width and height that the next frame is to have: 1 .. the last step's.
    double scale() const;
    // The last frame, of that scale, took so many ms; so many of these whatever its size.
    void add(double ms, double fixed_ms = 0);
    // Another scene, of which nothing is known: its first frame has the fewest pixels.
    void begin();

    // Sizes differ by 2^(1/8) in width: pixels by about 0.84.
    static constexpr size_t kSteps = 17;
    static double scale_of(size_t step);

  private:
    static constexpr size_t kFew = 3;      // frames that say that it is too slow by much
    static constexpr size_t kWindow = 15;  // frames that say that it is a little off
    static constexpr int kFirstPatience = 15, kMostPatience = 480;
    static constexpr double kMuch = 1.15;  // times the target
    static constexpr double kRoom =
        0.95;  // a larger picture is tried where it would take this much

    double time_at(size_t step, size_t frames) const;
    size_t fitting(double ms, size_t frames) const;
    void shrink(size_t step);
    void forget();

    struct Cost {
        double whole = 0, fixed = 0;  // ms: of all pixels, and whatever their number
    };
    double target_ = 1000.0 / 30;
    size_t step_ = 0;                     // 0: all pixels
    bool first_ = false;                  // the next time is that of a scene's first frame
    std::array<Cost, kWindow> recent_{};  // the newest first
    size_t known_ = 0;                    // of them
    int calm_ = 0;                        // frames for which a larger picture would have fitted
    int patience_ = kFirstPatience;       // so many of them make it larger
    int since_larger_ = kFirstPatience;   // frames since it last became larger
};

}  // namespace kinora
