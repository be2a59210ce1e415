// runtime/skin_space.cpp: where a COLLADA skin stands: in world space, or at the node that instances
// it.
#include "runtime/skin_space.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

bool is_near(const dmat4& a, const dmat4& b, double tolerance) {
    double size = 1, apart = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            size = std::max(size, std::abs(b[c][r]));
            apart = std::max(apart, std::abs(a[c][r] - b[c][r]));
        }
    return apart <= tolerance * size;
}

}  // namespace

SkinSpace skin_space(const dmat4& bind_shape, const dmat4& node,
                     std::span<const RestJoint> joints) {
    constexpr double kExact = 1e-9, kWritten = 1e-3;  // numbers of files have few digits
    const dmat4 identity(1.0);
    if (!is_near(bind_shape, identity, kExact) || is_near(node, identity, kExact))
        return SkinSpace::World;
    auto all_near = [&](const dmat4& wanted) {
        return !joints.empty() && std::all_of(joints.begin(), joints.end(), [&](const RestJoint& j) {
            return is_near(j.world * j.inverse_bind, wanted, kWritten);
        });
    };
    if (all_near(node)) return SkinSpace::World;
    return all_near(identity) ? SkinSpace::BindsNode : SkinSpace::Node;
}

}  // namespace kinora
