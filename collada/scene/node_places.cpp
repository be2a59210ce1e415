// collada/scene/node_places.cpp: where the nodes of a scene stand, and the skins that they
// instance.
#include "collada/scene/node_places.h"

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

NodePlaces::NodePlaces(const SceneData& scene)
    : scene_(scene), nodes_(scene.nodes), place_of_(nodes_.size(), kNone) {
    for (const Channel& channel : scene.channels)
        if (channel.ref.kind == Owner::Transform) start(channel);
    for (uint32_t root : scene.roots) walk(root);
    for (uint32_t i = 0; i < nodes_.size(); ++i)
        if (nodes_[i].parent == kNone) walk(i);
}

// The channel's first key into the node's transforms.
void NodePlaces::start(const Channel& channel) {
    const TargetRef& ref = channel.ref;
    const Sampler& sampler = scene_.samplers[channel.sampler];
    auto& transforms = started_.try_emplace(ref.owner, nodes_[ref.owner].transforms).first->second;
    auto& values = transforms[ref.slot].slot.values;
    for (uint32_t i = 0; i < ref.count && i < sampler.stride && i < sampler.values.size(); ++i)
        if (ref.first + i < values.size()) values[ref.first + i] = sampler.values[i];
}

// Without recursion, since instances may be chained as long as the file.
void NodePlaces::walk(uint32_t root) {
    std::vector<std::pair<uint32_t, uint32_t>> todo{{root, kNone}};
    while (!todo.empty()) {
        auto [at, parent] = todo.back();
        todo.pop_back();
        if (place_of_[at] != kNone) continue;
        uint32_t place = place_of_[at] = uint32_t(places_.size());
        const Node& node = nodes_[at];
        dmat4 local = matrix_of(node.transforms), first = local;
        if (auto moved = started_.find(at); moved != started_.end())
            first = matrix_of(moved->second);
        if (parent == kNone)
            places_.push_back({at, parent, local, local, first});
        else
            places_.push_back(
                {at, parent, local, places_[parent].world * local, places_[parent].start * first});
        for (uint32_t child : node.children) todo.emplace_back(child, place);
        for (const NodeInstance& instance : node.instances) todo.emplace_back(instance.node, place);
    }
}

// As the scene is built (SceneBuilder::add_skin).
NodePlaces::SkinPoses NodePlaces::skin_poses(uint32_t place, const MeshInstance& mesh) const {
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
        if (node == kNone || place_of_[node] == kNone) continue;
        joints.push_back(place_of_[node]);
        if (rest.joints.size() == kMostAsked) continue;
        rest.joints.push_back({places_[joints.back()].world, skin.inverse_bind[j]});
        start.joints.push_back({places_[joints.back()].start, skin.inverse_bind[j]});
        if (used[j]) moving.push_back(rest.joints.back());
    }
    dmat4 conversion(1.0);
    if (mesh.conversion != kNone) conversion = scene_.conversions[mesh.conversion];
    rest.node = places_[place].world * conversion;
    start.node = places_[place].start * conversion;
    uint32_t shared =
        shared_ancestor(place, joints, kNone, [&](uint32_t p) { return places_[p].parent; });
    if (shared != kNone) rest.shared = places_[shared].world;
    if (shared != kNone) start.shared = places_[shared].start;
    return poses;
}

}  // namespace kinora::collada
