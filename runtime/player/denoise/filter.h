// runtime/player/denoise/filter.h: the passes of the a-trous filter over a picture.
#pragma once

#include <vector>

#include "runtime/player/denoise/planes.h"

namespace kinora {

class AtrousFilter {
  public:
    static constexpr int kPasses = 4;  // 1, 2, 4 and 8 pixels between the taps

    // A picture whose variances are known.
    void start(Planes& planes);
    // The next pass. Stretches of a row without noise are copied.
    void pass(Planes& planes);

  private:
    int step_ = 1;
    std::vector<float> c_[4], variance_;  // where a pass writes
};

}  // namespace kinora
