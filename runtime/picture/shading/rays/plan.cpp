// runtime/picture/shading/rays/plan.cpp: the samples of a plan in their order; plans and calls
// compared.
#include "runtime/picture/shading/rays/plan.h"

#include <bit>
#include <cstring>

namespace kinora {

size_t PlannedSamples::take(uint8_t* lane, uint32_t* number, size_t room) {
    size_t taken = 0;
    while (lane_ < jit::kMaxLanes) {
        const size_t all = count(lane_);
        for (; next_ < all && taken < room; ++next_, ++taken) {
            lane[taken] = uint8_t(lane_);
            number[taken] = next_;
        }
        if (next_ < all) break;
        next_ = 0;
        ++lane_;
    }
    return taken;
}

size_t PlannedSamples::count() const {
    size_t sum = 0;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) sum += count(lane);
    return sum;
}

bool same_rays(const RayPlan& a, const RayPlan& b) {
    if (std::memcmp(&a, &b, sizeof(a)) == 0) return true;  // as in most calls
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        if (a.count[lane] != b.count[lane]) return false;
        if (a.count[lane] == 0) continue;
        if (a.share[lane] != b.share[lane] || a.allowance[lane] != b.allowance[lane] ||
            a.way[lane].weight != b.way[lane].weight)
            return false;
    }
    return true;
}

bool same_arguments(const float* a, const float* b, int rows, uint32_t mask) {
    if (std::memcmp(a, b, size_t(rows) * jit::kMaxLanes * sizeof(float)) == 0) return true;
    uint32_t differs[jit::kMaxLanes] = {};
    for (int row = 0; row < rows; ++row, a += jit::kMaxLanes, b += jit::kMaxLanes)
        for (int lane = 0; lane < jit::kMaxLanes; ++lane)
            differs[lane] |= uint32_t(jit::bits_of(a[lane]) ^ jit::bits_of(b[lane]));
    for (; mask; mask &= mask - 1)
        if (differs[std::countr_zero(mask)]) return false;
    return true;
}

}  // namespace kinora
