// collada/lint_nodes.cpp: node matrices that flatten, that a skin ignores; many influences.
#include <algorithm>
#include <cmath>

#include "collada/lint_p.h"
#include "runtime/base/skin_space.h"
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

bool flattens(const dmat4& m) {
    dvec3 a(m[0]), b(m[1]), c(m[2]);
    double volume = a.x * (b.y * c.z - b.z * c.y) - b.x * (a.y * c.z - a.z * c.y) +
                    c.x * (a.y * b.z - a.z * b.y);
    double size = std::hypot(a.x, a.y, a.z) * std::hypot(b.x, b.y, b.z) * std::hypot(c.x, c.y, c.z);
    return !(std::abs(volume) > 1e-12 * size);
}

std::string label(const Node& node) {
    return node.id.empty() ? node.name : node.id;
}

// What the matrix of the node over a skin does there, by SkinSpace.
constexpr const char* kInstead[] = {"", "binds it with its matrix", "moves it with its matrix",
                                    "moves it with what its matrix has below the joints' ancestor"};

// Where a node definition stands by the first way that leads to it; parents come first.
struct Place {
    uint32_t node;
    uint32_t parent;     // a place, or kNone
    dmat4 world, start;  // as the file leaves it, and at the first keys
};

// Without recursion, since instances may be chained as long as the file.
class NodeWalk {
  public:
    explicit NodeWalk(Lint& lint)
        : lint_(lint),
          nodes_(lint.scene.nodes),
          place_of_(nodes_.size(), kNone),
          animated_(nodes_.size()) {
        for (const Channel& channel : lint.scene.channels)
            if (channel.ref.kind == Owner::Transform) start(channel);
    }

    void run() {
        for (uint32_t root : lint_.scene.roots) walk(root);
        for (uint32_t i = 0; i < nodes_.size(); ++i)
            if (nodes_[i].parent == kNone) walk(i);
        for (uint32_t place = 0; place < places_.size(); ++place)
            for (const MeshInstance& mesh : nodes_[places_[place].node].meshes)
                if (mesh.skin != kNone) check_skin(place, mesh);
    }

  private:
    // The channel's first key into the node's transforms.
    void start(const Channel& channel) {
        const TargetRef& ref = channel.ref;
        animated_[ref.owner] = true;
        const Sampler& sampler = lint_.scene.samplers[channel.sampler];
        auto& transforms =
            started_.try_emplace(ref.owner, nodes_[ref.owner].transforms).first->second;
        auto& values = transforms[ref.slot].slot.values;
        for (uint32_t i = 0; i < ref.count && i < sampler.stride && i < sampler.values.size(); ++i)
            if (ref.first + i < values.size()) values[ref.first + i] = sampler.values[i];
    }

    void walk(uint32_t root) {
        std::vector<std::pair<uint32_t, uint32_t>> todo{{root, kNone}};
        while (!todo.empty()) {
            auto [at, parent] = todo.back();
            todo.pop_back();
            if (place_of_[at] != kNone) continue;
            uint32_t place = place_of_[at] = uint32_t(places_.size());
            const Node& node = nodes_[at];
            dmat4 local = matrix_of(node.transforms), first = local;
            check_flat(node, at, local);
            if (auto moved = started_.find(at); moved != started_.end())
                first = matrix_of(moved->second);
            if (parent == kNone)
                places_.push_back({at, parent, local, first});
            else
                places_.push_back(
                    {at, parent, places_[parent].world * local, places_[parent].start * first});
            for (uint32_t child : node.children) todo.emplace_back(child, place);
            for (const NodeInstance& instance : node.instances)
                todo.emplace_back(instance.node, place);
        }
    }

    void check_flat(const Node& node, uint32_t number, const dmat4& local) {
        bool shows = !node.meshes.empty() || !node.children.empty() || !node.instances.empty();
        if (shows && !animated_[number] && flattens(local))
            lint_.diag.report(Code::NODE_SINGULAR, node.where, label(node));
    }

    // As the scene is built (SceneBuilder::add_skin).
    void check_skin(uint32_t place, const MeshInstance& mesh) {
        const Skin& skin = lint_.scene.skins[mesh.skin];
        std::vector<bool> used(skin.inverse_bind.size());
        for (int32_t joint : skin.influence_joints)
            if (joint >= 0) used[size_t(joint)] = true;
        SkinPose rest, start;
        std::vector<RestJoint> moving;
        std::vector<uint32_t> joints;
        for (size_t j = 0; j < mesh.joint_nodes.size() && j < used.size(); ++j) {
            uint32_t node = mesh.joint_nodes[j];
            if (node == kNone || place_of_[node] == kNone) continue;
            joints.push_back(place_of_[node]);
            rest.joints.push_back({places_[joints.back()].world, skin.inverse_bind[j]});
            start.joints.push_back({places_[joints.back()].start, skin.inverse_bind[j]});
            if (used[j]) moving.push_back(rest.joints.back());
        }
        dmat4 conversion(1.0);
        if (mesh.conversion != kNone) conversion = lint_.scene.conversions[mesh.conversion];
        rest.node = places_[place].world * conversion;
        start.node = places_[place].start * conversion;
        uint32_t shared =
            shared_ancestor(place, joints, kNone, [&](uint32_t p) { return places_[p].parent; });
        if (shared != kNone) rest.shared = places_[shared].world;
        if (shared != kNone) start.shared = places_[shared].start;
        SkinSpace space = skin_place(skin.bind_shape_matrix, rest, start).space;
        if (space != SkinSpace::World)
            lint_.diag.report(Code::SKIN_NODE_TRANSFORM, mesh.where,
                              label(nodes_[places_[place].node]), skin.id, kInstead[size_t(space)]);
        size_t mirroring = mirroring_joints(skin.bind_shape_matrix, moving);
        if (mirroring && mirroring < moving.size())
            lint_.diag.report(Code::SKIN_MIXED_MIRROR, mesh.where, mirroring, moving.size(),
                              skin.id);
    }

    Lint& lint_;
    const std::vector<Node>& nodes_;
    std::vector<Place> places_;
    std::vector<uint32_t> place_of_;  // by node definition
    std::vector<bool> animated_;
    std::unordered_map<uint32_t, std::vector<Transform>> started_;  // of nodes that channels move
};

void check_influences(Lint& lint, const Skin& skin) {
    constexpr uint32_t kUsual = 4;
    uint32_t vertices = 0, most = 0;
    for (size_t i = 0; i + 1 < skin.offsets.size(); ++i) {
        uint32_t count = skin.offsets[i + 1] - skin.offsets[i];
        vertices += count > kUsual;
        most = std::max(most, count);
    }
    if (vertices) lint.diag.report(Code::SKIN_MANY_INFLUENCES, skin.where, vertices, most);
}

}  // namespace

void lint_nodes(Lint& lint) {
    NodeWalk(lint).run();
    for (const Skin& skin : lint.scene.skins) check_influences(lint, skin);
}

}  // namespace kinora::collada
