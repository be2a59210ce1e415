// collada/validate/lint_nodes.cpp: node matrices that flatten, that a skin ignores; many
// influences.
#include <algorithm>

#include "collada/scene/node_occurrences.h"
#include "collada/validate/lint_p.h"
#include "runtime/base/transform_matrix.h"

namespace kinora::collada {

namespace {

std::string label(const Node& node) {
    return node.id.empty() ? node.name : node.id;
}

// What the matrix of the node over a skin does there, by SkinSpace.
constexpr const char* kInstead[] = {"", "binds it with its matrix", "moves it with its matrix",
                                    "moves it with what its matrix has below the joints' ancestor"};

void check_flat(Lint& lint, const NodeOccurrences& occurrences, const NodeOccurrence& occurrence) {
    const Node& node = lint.scene.nodes[occurrence.node];
    bool shows = !node.meshes.empty() || !node.children.empty() || !node.instances.empty();
    if (shows && !occurrences.animated(occurrence.node) && is_singular(occurrence.local))
        lint.diag.report(Code::NODE_SINGULAR, node.where, label(node));
}

void check_skin(Lint& lint, const NodeOccurrences& occurrences, uint32_t occurrence,
                const MeshInstance& mesh) {
    const Skin& skin = lint.scene.skins[mesh.skin];
    auto [rest, start, moving] = occurrences.skin_poses(occurrence, mesh);
    SkinSpace space = skin_placement(skin.bind_shape_matrix, rest, start).space;
    if (space != SkinSpace::World)
        lint.diag.report(Code::SKIN_NODE_TRANSFORM, mesh.where,
                         label(lint.scene.nodes[occurrences.all()[occurrence].node]), skin.id,
                         kInstead[size_t(space)]);
    size_t mirroring = mirroring_joints(skin.bind_shape_matrix, moving);
    if (mirroring && mirroring < moving.size())
        lint.diag.report(Code::SKIN_MIXED_MIRROR, mesh.where, mirroring, moving.size(), skin.id);
}

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
    NodeOccurrences occurrences(lint.scene);
    for (const NodeOccurrence& occurrence : occurrences.all())
        check_flat(lint, occurrences, occurrence);
    for (uint32_t occurrence = 0; occurrence < occurrences.all().size(); ++occurrence)
        for (const MeshInstance& mesh : lint.scene.nodes[occurrences.all()[occurrence].node].meshes)
            if (mesh.skin != kNone) check_skin(lint, occurrences, occurrence, mesh);
    for (const Skin& skin : lint.scene.skins) check_influences(lint, skin);
}

}  // namespace kinora::collada
