// runtime/scene/build/core.cpp: where most of some points lie together, by medians.
#include "runtime/scene/build/core.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace kinora {

Core core_of(std::span<const dvec3> points, double share) {
    constexpr size_t kMost = 20'000;
    constexpr double kReach = 1.25;  // of the distance within which that share lies
    size_t step = points.size() / kMost + 1;
    std::vector<double> sorted;
    auto quantile = [&](double part, auto&& number) {
        sorted.clear();
        for (size_t i = 0; i < points.size(); i += step) sorted.push_back(number(points[i]));
        auto at = sorted.begin() + ptrdiff_t(part * double(sorted.size() - 1));
        std::nth_element(sorted.begin(), at, sorted.end());
        return *at;
    };
    Core core;
    if (points.empty()) return core;
    for (int k = 0; k < 3; ++k) core.middle[k] = quantile(0.5, [&](dvec3 p) { return p[k]; });
    core.reach = kReach * quantile(share, [&](dvec3 p) { return glm::length(p - core.middle); });
    return core;
}

}  // namespace kinora
