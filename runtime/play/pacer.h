// runtime/play/pacer.h: how many pixels a frame may have so that playback holds its rate. Times in,
// sizes out; it reads no clock.
#pragma once

#include <array>
#include <cstddef>

namespace kinora {

class Pacer {
  public:
    // Frames are to take that many ms. The next sizes follow; what is known of times is kept.
    void aim_at(double frame_ms) { target_ = frame_ms; }
    // Share of the picture's width and height that the next frame is to have: 1 .. kLeastScale.
    double scale() const;
    // The last frame, of that scale, took so many ms.
    void add(double ms);
    // Another scene: nothing is known.
    void forget();

    // Sizes differ by 2^(1/4) in width: pixels by about 0.7.
    static constexpr size_t kSteps = 9;
    static double scale_of(size_t step);

  private:
    double median() const;
    size_t fitting(double ms_of_all_pixels) const;

    double target_ = 1000.0 / 30;
    size_t step_ = 0;                    // 0: all pixels
    std::array<double, 3> recent_{};     // ms that all pixels would have taken
    size_t known_ = 0;                   // of them
    int calm_ = 0;                       // frames for which a larger picture would have fitted
    int patience_ = kFirstPatience;      // so many of them make it larger
    int since_larger_ = kFirstPatience;  // frames since it last became larger

    static constexpr int kFirstPatience = 15, kMostPatience = 480;
    static constexpr double kRoom = 0.8;  // a larger picture is tried where it would take this much
};

}  // namespace kinora
