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

constexpr double kWritten = 1e-3;  // numbers of files have few digits
constexpr double kNothing = 1e-5;  // and matrices that are the identity were multiplied as floats

// What a matrix does below `shared`: what moves and scales node and joints alike is left out.
dmat4 below(const dmat4& shared, const dmat4& m) {
    return glm::determinant(dmat3(shared)) == 0 ? m : glm::inverse(shared) * m;
}

// Whether the joints move the mesh to the node.
bool binds_at_node(const SkinPose& pose) {
    const dmat4 node = below(pose.shared, pose.node);
    return std::ranges::all_of(pose.joints, [&](const RestJoint& j) {
        return is_near(below(pose.shared, j.world * j.inverse_bind), node, kWritten);
    });
}

bool binds_nowhere(const SkinPose& pose) {
    return std::ranges::all_of(pose.joints, [&](const RestJoint& j) {
        return is_near(j.world * j.inverse_bind, dmat4(1.0), kWritten);
    });
}

// What no pose of the bind tells: is what moves node and joints in the joints' results? Turns and
// scales show it better than positions, which poses move more.
SkinSpace guess(const SkinPose& pose) {
    const dmat4 identity(1.0);
    bool turns = apart(pose.shared, identity, 3) > kWritten;
    double with = 0, without = 0;
    for (const RestJoint& j : pose.joints) {
        with += apart(j.world * j.inverse_bind, pose.shared, turns ? 3 : 4);
        without += apart(j.world * j.inverse_bind, identity, turns ? 3 : 4);
    }
    if (!(with < without)) return SkinSpace::Node;
    const bool apart_from_shared = !is_near(below(pose.shared, pose.node), identity, kNothing);
    return apart_from_shared ? SkinSpace::NodeBelow : SkinSpace::World;
}

}  // namespace

SkinPlacement skin_placement(const dmat4& bind_shape, const SkinPose& rest, const SkinPose& start) {
    const dmat4 identity(1.0);
    bool still = is_near(rest.node, identity, kNothing) && is_near(start.node, identity, kNothing);
    if (!is_near(bind_shape, identity, kNothing) || still) return {};
    for (const SkinPose* pose : {&rest, &start}) {
        if (pose->joints.empty()) continue;
        if (binds_at_node(*pose)) return {};
        if (binds_nowhere(*pose)) return {SkinSpace::BindsNode, pose->node};
    }
    return {guess(is_near(rest.node, identity, kNothing) ? start : rest), {}};
}

size_t mirroring_joints(const dmat4& bind_shape, std::span<const RestJoint> joints) {
    return size_t(std::ranges::count_if(joints, [&](const RestJoint& j) {
        return glm::determinant(dmat3(j.world * j.inverse_bind * bind_shape)) < 0;
    }));
}

}  // namespace kinora
