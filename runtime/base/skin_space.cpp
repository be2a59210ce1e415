// runtime/base/skin_space.cpp: where a COLLADA skin stands: in world space, or at the node that
// instances it.
#include "runtime/base/skin_space.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace kinora {

namespace {

double apart(const dmat4& a, const dmat4& b, int columns = 4) {
    double most = 0;
    for (int c = 0; c < columns; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

bool is_near(const dmat4& a, const dmat4& b, double tolerance) {
    double size = 1;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) size = std::max(size, std::abs(b[c][r]));
    return apart(a, b) <= tolerance * size;
}

}  // namespace

SkinSpace skin_space(const dmat4& bind_shape, const dmat4& node, const dmat4& shared,
                     std::span<const RestJoint> joints) {
    constexpr double kExact = 1e-9, kWritten = 1e-3;  // numbers of files have few digits
    const dmat4 identity(1.0);
    if (!is_near(bind_shape, identity, kExact) || is_near(node, identity, kExact))
        return SkinSpace::World;
    auto all_near = [&](const dmat4& wanted) {
        return !joints.empty() &&
               std::all_of(joints.begin(), joints.end(), [&](const RestJoint& j) {
                   return is_near(j.world * j.inverse_bind, wanted, kWritten);
               });
    };
    if (all_near(node)) return SkinSpace::World;
    if (all_near(identity)) return SkinSpace::BindsNode;
    // No pose of the bind tells. Is what moves node and joints in the joints' results? Turns and
    // scales show it better than places, which poses move more.
    bool turns = apart(shared, identity, 3) > kWritten;
    double with = 0, without = 0;
    for (const RestJoint& j : joints) {
        with += apart(j.world * j.inverse_bind, shared, turns ? 3 : 4);
        without += apart(j.world * j.inverse_bind, identity, turns ? 3 : 4);
    }
    if (!(with < without)) return SkinSpace::Node;
    return is_near(node, shared, kExact) ? SkinSpace::World : SkinSpace::NodeBelow;
}

size_t mirroring_joints(const dmat4& bind_shape, std::span<const RestJoint> joints) {
    return size_t(std::ranges::count_if(joints, [&](const RestJoint& j) {
        return glm::determinant(dmat3(j.world * j.inverse_bind * bind_shape)) < 0;
    }));
}

}  // namespace kinora
