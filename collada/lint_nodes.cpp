// collada/lint_nodes.cpp: node matrices that flatten, that a skin ignores; many influences.
#include <algorithm>
#include <cmath>

#include "collada/lint_p.h"

namespace kinora::collada {

namespace {

double radians_of(double degrees) {
    return degrees * (3.14159265358979323846 / 180);
}

// Rodrigues' formula; no turn about an axis without direction.
dmat4 rotation(const std::array<double, 16>& v) {
    double length = std::hypot(v[0], v[1], v[2]);
    dmat4 m(1.0);
    if (!(length > 0)) return m;
    double a[3] = {v[0] / length, v[1] / length, v[2] / length};
    double c = std::cos(radians_of(v[3])), s = std::sin(radians_of(v[3]));
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) {
            int third = 3 - column - row;
            double turn = column == row ? 0 : ((row - column + 3) % 3 == 1 ? s : -s) * a[third];
            m[column][row] = (1 - c) * a[column] * a[row] + (column == row ? c : 0) + turn;
        }
    return m;
}

// The matrix of a transform at rest; <lookat> and <skew>, which are never the identity by chance,
// as one that is none and flattens nothing.
dmat4 rest_matrix(const Transform& transform) {
    const auto& v = transform.slot.values;
    dmat4 m(1.0);
    switch (transform.kind) {
        case TransformKind::Translate:
            m[3] = {v[0], v[1], v[2], 1};
            break;
        case TransformKind::Rotate:
            return rotation(v);
        case TransformKind::Scale:
            for (int i = 0; i < 3; ++i) m[i][i] = v[size_t(i)];
            break;
        case TransformKind::Matrix:
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r) m[c][r] = v[size_t(c * 4 + r)];
            break;
        case TransformKind::Lookat:
        case TransformKind::Skew:
            m[3] = {1e-3, 2e-3, 3e-3, 1};
            break;
    }
    return m;
}

dmat4 rest_matrix(const Node& node) {
    dmat4 m(1.0);
    for (const Transform& t : node.transforms) m = m * rest_matrix(t);
    return m;
}

bool is_identity(const dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!(std::abs(m[c][r] - (c == r)) <= 1e-6)) return false;
    return true;
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

// Each node definition once, by the first way that leads to it; without recursion, since instances
// may be chained as long as the file.
class NodeWalk {
  public:
    explicit NodeWalk(Lint& lint)
        : lint_(lint), nodes_(lint.scene.nodes), seen_(nodes_.size()), animated_(nodes_.size()) {
        for (const Channel& channel : lint.scene.channels)
            if (channel.ref.kind == Owner::Transform) animated_[channel.ref.owner] = true;
    }

    void run() {
        for (uint32_t root : lint_.scene.roots) walk(root);
        for (uint32_t i = 0; i < nodes_.size(); ++i)
            if (nodes_[i].parent == kNone) walk(i);
    }

  private:
    void walk(uint32_t root) {
        std::vector<std::pair<uint32_t, dmat4>> todo{{root, dmat4(1.0)}};
        while (!todo.empty()) {
            auto [at, above] = todo.back();
            todo.pop_back();
            if (seen_[at]) continue;
            seen_[at] = true;
            const Node& node = nodes_[at];
            dmat4 local = rest_matrix(node);
            dmat4 world = above * local;
            check(node, at, local, world);
            for (uint32_t child : node.children) todo.emplace_back(child, world);
            for (const NodeInstance& instance : node.instances)
                todo.emplace_back(instance.node, world);
        }
    }

    void check(const Node& node, uint32_t number, const dmat4& local, const dmat4& world) {
        bool shows = !node.meshes.empty() || !node.children.empty() || !node.instances.empty();
        if (shows && !animated_[number] && flattens(local))
            lint_.diag.report(Code::NODE_SINGULAR, node.where, label(node));
        for (const MeshInstance& mesh : node.meshes) {
            if (mesh.skin == kNone) continue;
            const Skin& skin = lint_.scene.skins[mesh.skin];
            if (is_identity(skin.bind_shape_matrix) && !is_identity(world))
                lint_.diag.report(Code::SKIN_NODE_TRANSFORM, mesh.where, label(node), skin.id);
        }
    }

    Lint& lint_;
    const std::vector<Node>& nodes_;
    std::vector<bool> seen_, animated_;
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
