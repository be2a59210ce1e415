// collada/scene/node_occurrences.cpp: where the nodes of a scene occur, and the skins that they
// instance.
#include "collada/scene/node_occurrences.h"

#include "runtime/base/transform_matrix.h"

namespace kinora::collada {

namespace {

using MatrixOf = dmat4 (*)(const double*);
constexpr MatrixOf kMatrixOf[] = {translation_matrix, rotation_matrix, scale_matrix, rows_matrix,
                                  lookat_matrix,      skew_matrix};  // TransformKind

dmat4 matrix_of(const std::vector<Transform>& transforms) {
    dmat4 m(1.0);
    for (const Transform& t : transforms) {
        std::array<double, 16> v = t.slot.values;
        if (t.kind == TransformKind::Matrix)  // slots are column-major
            for (size_t i = 0; i < 16; ++i) v[i] = t.slot.values[i % 4 * 4 + i / 4];
        m = m * kMatrixOf[size_t(t.kind)](v.data());
    }
    return m;
}

}  // namespace

NodeOccurrences::NodeOccurrences(const SceneData& scene)
    : scene_(scene), nodes_(scene.nodes), occurrence_of_(nodes_.size(), kNone) {
    for (const Channel& channel : scene.channels)
        if (channel.ref.kind == Owner::Transform) start(channel);
    for (uint32_t root : scene.roots) walk(root);
    for (uint32_t i = 0; i < nodes_.size(); ++i)
        if (nodes_[i].parent == kNone) walk(i);
}

// The channel's first key into the node's transforms.
void NodeOccurrences::start(const Channel& channel) {
    const TargetRef& ref = channel.ref;
    const Sampler& sampler = scene_.samplers[channel.sampler];
    auto& transforms = started_.try_emplace(ref.owner, nodes_[ref.owner].transforms).first->second;
    auto& values = transforms[ref.slot].slot.values;
    for (uint32_t i = 0; i < ref.count && i < sampler.stride && i < sampler.values.size(); ++i)
        if (ref.first + i < values.size()) values[ref.first + i] = sampler.values[i];
}

// Without recursion, since instances may be chained as long as the file.
void NodeOccurrences::walk(uint32_t root) {
    struct Step {
        uint32_t node, parent, conversion;
    };
    std::vector<Step> todo{{root, kNone, nodes_[root].conversion}};
    while (!todo.empty()) {
        auto [at, parent, conversion] = todo.back();
        todo.pop_back();
        if (occurrence_of_[at] != kNone) continue;
        uint32_t occurrence = occurrence_of_[at] = uint32_t(all_.size());
        const Node& node = nodes_[at];
        dmat4 change = conversion == kNone ? dmat4(1.0) : scene_.conversions[conversion];
        dmat4 local = change * matrix_of(node.transforms), first = local;
        if (auto moved = started_.find(at); moved != started_.end())
            first = change * matrix_of(moved->second);
        if (parent == kNone)
            all_.push_back({at, parent, local, local, first});
        else
            all_.push_back(
                {at, parent, local, all_[parent].world * local, all_[parent].start * first});
        for (uint32_t child : node.children)
            todo.push_back({child, occurrence, nodes_[child].conversion});
        for (const NodeInstance& instance : node.instances)
            todo.push_back({instance.node, occurrence, instance.conversion});
    }
}

// As the scene is built (SceneBuilder::add_skin).
NodeOccurrences::SkinPoses NodeOccurrences::skin_poses(uint32_t occurrence,
                                                       const MeshInstance& mesh) const {
    constexpr size_t kMostAsked = 10'000;  // joints tell alike; a short file can name millions
    const Skin& skin = scene_.skins[mesh.skin];
    std::vector<bool> used(skin.inverse_bind.size());
    for (int32_t joint : skin.influence_joints)
        if (joint >= 0) used[size_t(joint)] = true;
    SkinPoses poses;
    auto& [rest, start, moving] = poses;
    std::vector<uint32_t> joints;
    for (size_t j = 0; j < mesh.joint_nodes.size() && j < used.size(); ++j) {
        uint32_t node = mesh.joint_nodes[j];
        if (node == kNone || occurrence_of_[node] == kNone) continue;
        joints.push_back(occurrence_of_[node]);
        if (rest.joints.size() == kMostAsked) continue;
        rest.joints.push_back({all_[joints.back()].world, skin.inverse_bind[j]});
        start.joints.push_back({all_[joints.back()].start, skin.inverse_bind[j]});
        if (used[j]) moving.push_back(rest.joints.back());
    }
    dmat4 conversion(1.0);
    if (mesh.conversion != kNone) conversion = scene_.conversions[mesh.conversion];
    rest.node = all_[occurrence].world * conversion;
    start.node = all_[occurrence].start * conversion;
    uint32_t shared =
        shared_ancestor(occurrence, joints, kNone, [&](uint32_t p) { return all_[p].parent; });
    if (shared != kNone) rest.shared = all_[shared].world;
    if (shared != kNone) start.shared = all_[shared].start;
    return poses;
}

}  // namespace kinora::collada
