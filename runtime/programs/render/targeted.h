// runtime/programs/render/targeted.h: the samples of each frame for --target-ms and --target-error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/picture/frame/frame.h"
#include "runtime/programs/tradeoff/choose_settings.h"

namespace kinora {

class TargetedFrames {
  public:
    TargetedFrames(const FrameTarget& target, const ChosenSettings& chosen);

    // "--target-ms 25: settings of preview (...), some 13 samples a frame"
    std::string begin_text() const;

    // The samples of a frame: by the clock, or by small pictures of it with other seeds. 0: one of
    // these was stopped. `render` renders the frame with so many samples and that seed beside its
    // own.
    using RenderPass = FunctionRef<bool(int samples, uint32_t seed, raytrace::Film& film)>;
    int samples(RenderPass render);
    // What it took, without writing.
    void took(int samples, double ms);

    // What the frames took or are estimated to be off by; "" of none.
    std::string end_text() const;

  private:
    struct Done {
        int samples;
        double ms, error;
    };
    int samples_by_noise(RenderPass render);

    FrameTarget target_;
    ChosenSettings chosen_;
    FramePace pace_;
    std::vector<Done> done_;
    raytrace::Film films_[2];
    double estimated_ = 0;  // the error of the frame under way, without the margin
};

}  // namespace kinora
