// runtime/scene/description/affine_map.h: partial derivatives along u and v on a triangle.
#pragma once

#include <algorithm>
#include <cmath>

namespace kinora {

// Partial derivatives along u, v of what varies linearly over a triangle by d1, d2 along its edges:
// d1 = du1 x_u + dv1 x_v, d2 = du2 x_u + dv2 x_v, solved (docs/decisions.md#spaces).
struct AffineMap {
    float inv[2][2] = {{1, 0}, {0, 1}};
    template <class T>
    T along_u(T d1, T d2) const {
        return inv[0][0] * d1 + inv[0][1] * d2;
    }
    template <class T>
    T along_v(T d1, T d2) const {
        return inv[1][0] * d1 + inv[1][1] * d2;
    }
};

// From the changes of u, v along both edges. False, and `map` as it was, where the triangle has no
// area in u, v.
inline bool solve(AffineMap& map, float du1, float dv1, float du2, float dv2) {
    float det = du1 * dv2 - du2 * dv1;
    float scale = std::max(std::abs(du1 * dv2), std::abs(du2 * dv1));
    if (!(std::abs(det) > 1e-6f * scale) || !(std::abs(det) > 1e-30f)) return false;
    map.inv[0][0] = dv2 / det;
    map.inv[0][1] = -dv1 / det;
    map.inv[1][0] = -du2 / det;
    map.inv[1][1] = du1 / det;
    return true;
}

}  // namespace kinora
