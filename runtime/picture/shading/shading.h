// runtime/picture/shading/shading.h: the looks of surfaces for the ray tracer: hits to grids to
// colours.
#pragma once

#include <atomic>
#include <memory>

#include "raytrace/tiles/integrator.h"
#include "runtime/base/diagnostic.h"
#include "runtime/picture/shading/frame/frame.h"

namespace kinora {

// Whether some shader of the scene reads the size of what a pixel shows; else rays carry none.
bool reads_footprints(const SceneShaders& scene);

// Wavefront shading (docs/decisions.md#lanes-and-wavefronts). One per pose; its memory is kept
// from frame to frame.
class Shading : public raytrace::SurfaceShading {
  public:
    Shading(const Scene& scene, const Pose& pose);
    ~Shading() override;

    // Before the first shade() of a frame at Pose::time: sizes the threads' memory, runs the frame
    // kernels. Rays see through max_layers surfaces, as those of the camera do. `all_inputs`: what
    // no kernel reads is wanted, too.
    void begin_frame(uint32_t seed, int max_layers, bool all_inputs = false);
    // The frame ends as soon as it can once this is not 0; null: never.
    void stop_by(const std::atomic<int>* flag);
    bool stopped() const override;
    // What the next frame is to show of its making, until its end.
    void show(const ShadingInsight& insight);
    // Memory for what the frame's pixels take, if nobody brings any.
    PixelCosts& costs();
    // After the last: sums counters; reports faults, one finding a source line.
    // `whole`: the picture was finished, so what it baked is written.
    ShadingCounters end_frame(Diagnostics& diagnostics, bool whole = true);
    // Instead of it, where nobody sees the picture: shaders printed and baked in vain.
    ShadingCounters drop_frame(Diagnostics& diagnostics);

    void shade(const raytrace::HitBatch& hits, int thread, raytrace::ShadeResult& result) override;
    bool reads_footprints() const override;
    float miss_distance() const override;
    void shade_misses(const raytrace::HitBatch& ends, int thread,
                      raytrace::ShadeResult& result) override;
    uint32_t medium_behind(const raytrace::HitBatch& hits, size_t k) const override;
    bool has_mattes() const override;
    bool is_matte(const raytrace::HitBatch& hits, size_t k) const override;

    // Runs the scene's imager over the finished picture, after integrate(). The number of its
    // pixels that were not finite; they become what `nan` says.
    size_t run_imager(raytrace::Film& film, raytrace::NanPolicy nan);

  private:
    struct Objects;
    std::unique_ptr<Objects> objects_;
};

}  // namespace kinora
