// runtime/shading/insight.cpp: readings of a thread's counters, shared out to pixels.
#include "runtime/shading/insight.h"

#include <time.h>

#include "runtime/shading/shading_frame.h"

namespace kinora {

void PixelCosts::start(int picture_width, int picture_height) {
    width = picture_width;
    height = picture_height;
    for (std::vector<float>* plane : {&ns, &rays, &points, &filled, &lanes})
        plane->assign(size_t(width) * size_t(height), 0.0f);
}

CostScope::CostScope(PixelCosts* costs, const ThreadMemory& memory, const raytrace::HitBatch& hits,
                     std::span<const uint32_t> which)
    : costs_(costs), memory_(memory), hits_(hits), which_(which) {
    if (costs_) begin_ = read();
}

CostScope::Reading CostScope::read() const {
    const ShadingCounters& counters = memory_.counters;
    timespec now{};  // of this thread alone: what else the machine does is no cost of the pixel
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return {int64_t(now.tv_sec) * 1'000'000'000 + now.tv_nsec,
            counters.trace.rays + counters.trace.shadow_rays, counters.kernel_points,
            counters.kernel_lanes};
}

CostScope::~CostScope() {
    if (!costs_ || which_.empty()) return;
    const Reading end = read();
    const auto share = 1.0f / float(which_.size());
    for (uint32_t hit : which_) {
        const size_t pixel =
            size_t(hits_.pixel_y[hit]) * size_t(costs_->width) + hits_.pixel_x[hit];
        costs_->ns[pixel] += share * float(end.ns - begin_.ns);
        costs_->rays[pixel] += share * float(end.rays - begin_.rays);
        costs_->points[pixel] += 1;
        costs_->filled[pixel] += share * float(end.filled - begin_.filled);
        costs_->lanes[pixel] += share * float(end.lanes - begin_.lanes);
    }
}

}  // namespace kinora
