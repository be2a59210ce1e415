// runtime/scene/build/shapes/skins.cpp: joints and influences of the shapes that a skin or morph
// deforms.
#include "runtime/scene/build/shapes/skins.h"

#include <glm/matrix.hpp>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/values.h"

namespace kinora {

NodePoses node_poses(const SceneNodes& scene, Pose& start) {
    NodePoses poses;
    if (scene.description->skins.empty()) return poses;
    auto keep = [&](std::vector<dmat4>& worlds) {
        for (const NodePose& node : start.nodes) worlds.push_back(node.world);
    };
    evaluate_anew(scene, start, std::nullopt);
    keep(poses.rest);
    evaluate_anew(scene, start, anim::time_range(scene.description->animation).begin);
    keep(poses.start);
    return poses;
}

SkinBinder::SkinBinder(const SceneNodes& scene, const NodeTree& tree, NodePoses poses,
                       Diagnostics& diagnostics)
    : scene_(scene), tree_(tree), poses_(std::move(poses)), diagnostics_(diagnostics) {}

void SkinBinder::bind(const MeshUse& use, const Mesh& mesh, Shape& shape) const {
    const SceneDescription& description = *scene_.description;
    std::string id = description.meshes[use.mesh].id;
    Location where;
    bool weights_told = false;
    if (use.skin != kNone) {
        const SkinDefinition& skin = description.skins[use.skin];
        id = skin.id;
        where = skin.where;
        weights_told = skin.weights_told;
        bind_joints(use, shape);
    }
    skin::SkinRepairs repairs;
    shape.skin_mesh =
        skin_mesh_of(scene_, use, mesh.positions.size(), mesh.normal_positions, nullptr, repairs);
    if (repairs.weight_sum && !weights_told)
        diagnostics_.report(Code::SKIN_WEIGHT_SUM, where, id, repairs.weight_sum,
                            repairs.worst_sum);
    if (repairs.dropped)
        diagnostics_.report(Code::SKIN_INFLUENCES_DROPPED, where, id, repairs.dropped,
                            repairs.largest_dropped);
    if (repairs.unweighted && !weights_told)
        diagnostics_.report(Code::SKIN_ZERO_INFLUENCE, where, id, repairs.unweighted);
}

void SkinBinder::bind_joints(const MeshUse& use, Shape& shape) const {
    const SkinDefinition& skin = scene_.description->skins[use.skin];
    uint32_t joints = uint32_t(skin.inverse_bind.size());
    shape.skeleton.inverse_bind = skin.inverse_bind;
    shape.skeleton.bind_shape = skin.bind_shape;
    for (uint32_t j = 0; j < joints; ++j) {
        shape.skeleton.nodes.push_back(j);
        uint32_t joint = j < use.joint_nodes.size() ? use.joint_nodes[j] : kNone;
        shape.joint_nodes.push_back(tree_.nearest_occurrence(joint, shape.node));
    }
    convert_binds(shape);
    choose_space(skin, shape);
}

// A skin and its joints may come from files of different units and axes: what the inverse bind
// matrices give is brought from the skin's document into that of each joint. Joints that are not
// there leave the bind shape where it is, in the scene's.
void SkinBinder::convert_binds(Shape& shape) const {
    dmat4 from_skin = path_conversion(scene_, shape.node) * shape.conversion;
    for (size_t j = 0; j < shape.joint_nodes.size(); ++j) {
        dmat4& inverse_bind = shape.skeleton.inverse_bind[j];
        if (shape.joint_nodes[j] == kNone) {
            inverse_bind = from_skin;
            continue;
        }
        dmat4 from_joint = path_conversion(scene_, shape.joint_nodes[j]);
        if (from_joint != from_skin)
            inverse_bind = glm::inverse(from_joint) * from_skin * inverse_bind;
    }
}

// The shape's node and joints in one of the poses; `shared` is their shared ancestor.
SkinPose SkinBinder::pose_of(const Shape& shape, std::span<const dmat4> world,
                             uint32_t shared) const {
    SkinPose pose;
    pose.node = world[shape.node];
    if (shared != kNone) pose.shared = world[shared];
    dmat4 before = glm::inverse(shape.conversion);
    for (size_t j = 0; j < shape.joint_nodes.size(); ++j)
        if (uint32_t joint = shape.joint_nodes[j]; joint != kNone)
            pose.joints.push_back({world[joint], shape.skeleton.inverse_bind[j] * before});
    return pose;
}

namespace {

// Those that some vertex hangs at and that are there, in the order of the pose's.
std::vector<RestJoint> moving_joints(const SkinDefinition& skin, const Shape& shape,
                                     const SkinPose& pose) {
    std::vector<bool> used(shape.joint_nodes.size());
    for (int32_t joint : skin.joints)
        if (joint >= 0 && size_t(joint) < used.size()) used[size_t(joint)] = true;
    std::vector<RestJoint> moving;
    size_t there = 0;
    for (size_t j = 0; j < used.size(); ++j) {
        if (shape.joint_nodes[j] == kNone) continue;
        if (used[j]) moving.push_back(pose.joints[there]);
        ++there;
    }
    return moving;
}

}  // namespace

// Whether the skin's result is in world space or its node's matrix applies
// (runtime/base/skin_space.h).
void SkinBinder::choose_space(const SkinDefinition& skin, Shape& shape) const {
    uint32_t shared = shared_ancestor(shape.node, shape.joint_nodes, kNone,
                                      [&](uint32_t n) { return tree_.parent(n); });
    SkinPose rest = pose_of(shape, poses_.rest, shared);
    SkinPose start = pose_of(shape, poses_.start, shared);
    std::vector<RestJoint> moving = moving_joints(skin, shape, rest);
    size_t mirroring = mirroring_joints(skin.bind_shape, moving);
    if (mirroring && mirroring < moving.size())
        diagnostics_.report(Code::SKIN_MIXED_MIRROR, skin.where, mirroring, moving.size(), skin.id);
    SkinPlacement found;
    if (!skin.in_world) found = skin_placement(skin.bind_shape, rest, start);
    SkinSpace space = found.space;
    if (space != SkinSpace::World)
        diagnostics_.report(Code::SKIN_NODE_TRANSFORM, skin.where, skin.id);
    if (space == SkinSpace::BindsNode)
        shape.skeleton.bind_shape = glm::inverse(shape.conversion) * found.bind * shape.conversion;
    shape.in_world = space == SkinSpace::World || space == SkinSpace::BindsNode;
    for (size_t j = 0; j < shape.joint_nodes.size() && !shape.in_world; ++j)
        if (shape.joint_nodes[j] == kNone)  // the node's matrix has the rest
            shape.skeleton.inverse_bind[j] = shape.conversion;
    if (space == SkinSpace::NodeBelow) shape.applies_below = shared;
}

skin::SkinMesh skin_mesh_of(const SceneResources& scene, const MeshUse& use, size_t vertices,
                            std::span<const uint32_t> normal_positions,
                            const std::vector<Stencil>* stencils, skin::SkinRepairs& repairs) {
    skin::InfluenceSource source;
    std::vector<uint32_t> first(vertices + 1, 0);
    std::vector<int32_t> joints;
    std::vector<double> weights;
    if (use.skin == kNone) {  // a morph alone: one matrix moves everything
        joints.assign(vertices, 0);
        weights.assign(vertices, 1.0);
        for (size_t i = 0; i < first.size(); ++i) first[i] = uint32_t(i);
        source.joint_count = 1;
    } else {
        const SkinDefinition& skin = scene.description->skins[use.skin];
        first.assign(skin.offsets.begin(), skin.offsets.end());
        joints = skin.joints;
        weights.assign(skin.weights.begin(), skin.weights.end());
        source.joint_count = uint32_t(skin.inverse_bind.size());
        if (stencils) dice_influences(*stencils, first, joints, weights);
    }
    source.first = first;
    source.joints = joints;
    source.weights = weights;
    source.max_influences = scene.options.quality.influences;
    return skin::build_skin(source, normal_positions, &repairs);
}

}  // namespace kinora
