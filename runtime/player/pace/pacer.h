// runtime/player/pace/pacer.h: how many pixels a frame may have so that playback holds its rate.
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
    // The last frame, of that scale, took so many ms; so many of these whatever its size, and so
    // many for what only pictures need that are less than kNeedsGuide as wide (their edges).
    void add(double ms, double fixed_ms = 0, double guide_ms = 0);
    bool is_late(double ms) const { return ms > target_; }
    // Another scene, of which nothing is known: its first frame has few pixels.
    void begin();
    // The next frame is not waited for any longer than these ms: a smaller one is done sooner.
    // Of the smallest size it is waited for without end, while time goes on only where no frame was
    // done for two seconds.
    double limit(bool time_goes_on) const;
    // The last frame was let go after so many ms: nobody knows how long it would have taken.
    void cut(double ms, double fixed_ms = 0);

    // Sizes differ by 2^(1/8) in width: pixels by about 0.84. Those behind the usual ones are for
    // frames that even so would take several times what they may.
    static constexpr size_t kUsualSteps = 17, kSteps = 33;
    static double scale_of(size_t step);
    static constexpr double kNeedsGuide = 0.5;

  private:
    static constexpr size_t kFew = 3;      // frames that say that it is too slow by much
    static constexpr size_t kWindow = 15;  // frames that say that it is a little off
    static constexpr int kFirstPatience = 4, kMostPatience = 120;
    static constexpr double kMuch = 1.15;  // times what a frame may take
    static constexpr double kRoom =
        0.95;  // a larger picture is tried where it would take this much

    struct Cost {
        double whole = 0, fixed = 0;  // ms: of all pixels, and whatever their number
        double guide = 0;             // where there are few
    };
    double load(const Cost& cost, size_t step) const;
    double load_at(size_t step, size_t frames) const;
    double most_load(size_t step, size_t frames) const;
    void remember(double ms, double fixed_ms, double guide_ms);
    bool shrink(size_t frames);
    void become_smaller(size_t step);
    void grow();

    double target_ = 1000.0 / 30;
    size_t step_ = 0;                     // 0: all pixels
    bool first_ = false;                  // the next time is that of a scene's first frame
    std::array<Cost, kWindow> recent_{};  // the newest first
    size_t known_ = 0;                    // of them
    double in_vain_ = 0;                  // ms of the frames let go since the last that was done
    int calm_ = 0;                        // frames for which a larger picture would have fitted
    int patience_ = kFirstPatience;       // so many of them make it larger
    int since_larger_ = kMostPatience;    // frames since it last became larger
};

}  // namespace kinora
