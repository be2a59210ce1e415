// runtime/picture/shading/imager.h: the scene's imager over the finished picture.
#pragma once

#include "raytrace/film.h"
#include "runtime/picture/shading/kernel_runner.h"

namespace kinora {

class Imager {
  public:
    Imager(const ShadingFrame& frame, const ThreadMemories& threads, KernelRunner& kernels)
        : frame_(frame), threads_(threads), kernels_(kernels) {}
    // In parallel. The number of pixels that were not finite; they become what `nan` says.
    size_t run(raytrace::Film& film, raytrace::NanPolicy nan);

  private:
    size_t run_pixels(raytrace::Film& film, size_t first, size_t count, raytrace::NanPolicy nan);

    const ShadingFrame& frame_;
    const ThreadMemories& threads_;
    KernelRunner& kernels_;
};

}  // namespace kinora
