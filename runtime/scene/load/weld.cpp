// runtime/scene/load/weld.cpp: positions that are equal.
#include "runtime/scene/load/weld.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace kinora {

std::vector<uint32_t> welded(const std::vector<dvec3>& positions) {
    std::vector<uint32_t> order(positions.size()), result(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    auto key = [&](uint32_t p) {
        return std::tuple(positions[p].x, positions[p].y, positions[p].z, p);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t i = 0; i < order.size(); ++i) {
        bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        result[order[i]] = same ? result[order[i - 1]] : order[i];
    }
    return result;
}

}  // namespace kinora
