// runtime/picture/shading/rays/plan.h: the rays that a call sends: how many from each lane, one by
// one.
#pragma once

#include <algorithm>
#include <iterator>

#include "runtime/picture/shading/rays/lanes.h"

namespace kinora {

// What a traced ray counts for.
struct TracedRay {
    float factor = 1;  // of what it sees; 0: it is not shot
    float weight = 1;  // RayBatch::weight
};

// The rays that a call sends from each lane.
struct RayPlan {
    int count[jit::kMaxLanes] = {};
    float share[jit::kMaxLanes] = {};
    float allowance[jit::kMaxLanes] = {};  // RayBatch::allowance of each ray
    TracedRay way[jit::kMaxLanes];

    bool any() const {
        return std::any_of(std::begin(count), std::end(count), [](int n) { return n > 0; });
    }
};

// The samples of a plan, lane by lane.
class PlannedSamples {
  public:
    PlannedSamples(const Lanes& lanes, const RayPlan& plan) : lanes_(lanes), plan_(plan) {}
    // Up to `room` of those left; none at the end.
    size_t take(uint8_t* lane, uint32_t* number, size_t room);
    // The samples of all lanes.
    size_t count() const;

  private:
    size_t count(int lane) const { return lanes_.asks(lane) ? size_t(plan_.count[lane]) : 0; }

    const Lanes& lanes_;
    const RayPlan& plan_;
    int lane_ = 0;
    uint32_t next_ = 0;
};

// Whether the lanes of two plans that send rays send the same.
bool same_rays(const RayPlan& a, const RayPlan& b);
// Whether so many rows of arguments are the same in the lanes of the mask, bit for bit.
bool same_arguments(const float* a, const float* b, int rows, uint32_t mask);

}  // namespace kinora
