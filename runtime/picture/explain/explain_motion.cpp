// runtime/picture/explain/explain_motion.cpp: which meshes deform, move and stand, and by which
// channels.
#include <fmt/format.h>

#include "runtime/picture/explain/explain_p.h"
#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/vertices/vertex_work.h"
#include "skin/narrowest.h"

namespace kinora {

namespace {

const std::string& id_or_name(const std::string& id, const std::string& name) {
    return id.empty() ? name : id;
}

std::string shown_shape(const Scene& scene, const Shape& shape) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    std::string node = shown_node(scene, shape.node);
    if (mesh.definition == kNone) return fmt::format("a mesh on {}", node);
    const MeshDefinition& definition = scene.description->meshes[mesh.definition];
    return fmt::format("{} on {}", id_or_name(definition.id, definition.name), node);
}

// What linear blending takes from the limbs of a pose. Before a frame no pose is known.
void explain_blending(const Shape& shape, const ShapePose& stands, const std::string& subject,
                      ExplainedRows& rows) {
    if (!stands.dual_palette.empty()) {
        rows.add(subject, "rotations are blended: a twist keeps its radius", "--skin dual");
        return;
    }
    const double left = skin::narrowest(shape.skin_mesh, stands.palette);
    rows.add(
        subject,
        fmt::format("matrices are blended: where it is narrowed most, {:.3g} of the radius is left "
                    "in the last frame",
                    left),
        "COLLADA means it so; --skin dual keeps the radius");
}

std::string why_it_deforms(const Scene& scene, const Shape& shape) {
    std::string why;
    auto add = [&](const std::string& text) { why += (why.empty() ? "" : ", ") + text; };
    if (shape.skin != kNone)
        add(fmt::format("skin '{}' of {} joints, {} influences of a vertex",
                        scene.description->skins[shape.skin].id, shape.joint_nodes.size(),
                        scene.options.quality.influences
                            ? fmt::format("at most {}", scene.options.quality.influences)
                            : std::string("all")));
    if (shape.morph != kNone)
        add(fmt::format("a morph of {} targets", chain_targets(*scene.description, shape.morph)));
    if (shape.vertex_work && shape.vertex_work->each_frame)
        add("its displacement reads what changes from frame to frame");
    return why;
}

}  // namespace

std::string shown_node(const Scene& scene, uint32_t node) {
    const NodeDefinition& definition = scene.description->nodes[scene.nodes[node].definition];
    const std::string& shown = id_or_name(definition.id, definition.name);
    return shown.empty() ? fmt::format("node {}", node) : shown;
}

void explain_meshes(const Scene& scene, const Pose& pose, ExplainedRows& rows) {
    for (size_t s = 0; s < scene.shapes.size(); ++s) {
        const Shape& shape = scene.shapes[s];
        const bool moves = scene.nodes[shape.node].can_move;
        const std::string subject = shown_shape(scene, shape);
        switch (shape.kind) {
            case raytrace::GeometryKind::Deforming:
                rows.add(subject, "deforms: vertices and tree are brought up to date each frame",
                         why_it_deforms(scene, shape));
                if (shape.skin != kNone && !pose.first_frame)
                    explain_blending(shape, pose.shapes[s], subject, rows);
                break;
            case raytrace::GeometryKind::Instanced:
                if (moves)
                    rows.add(subject, "moves: one matrix a frame",
                             "its node or one above is animated");
                else
                    rows.leave_out(subject, "stands: one tree serves all that show the mesh",
                                   "nothing above it is animated");
                break;
            default:
                rows.leave_out(subject, "stands: placed once", "nothing above it is animated");
        }
    }
    size_t hidden = 0;
    for (const Node& node : scene.nodes)
        hidden += (node.hidden || !node.chosen) &&
                  !scene.description->nodes[node.definition].meshes.empty();
    if (hidden)
        rows.leave_out(fmt::format("{} nodes with meshes", hidden), "not built",
                       "--hide or --only");
}

void explain_animation(const Scene& scene, const Pose&, ExplainedRows& rows) {
    const anim::Animation& animation = scene.description->animation;
    size_t writing = 0;
    for (size_t c = 0; c + 1 < animation.first_write.size(); ++c)
        writing += animation.first_write[c] < animation.first_write[c + 1];
    if (writing)
        rows.add(fmt::format("{} channels", writing), "evaluated each frame",
                 "they write what the scene reads");
    if (animation.channels.size() > writing)
        rows.leave_out(fmt::format("{} channels", animation.channels.size() - writing),
                       "never evaluated", "without keys, or another channel writes the same");
    size_t moving = 0;
    for (const Node& node : scene.nodes) moving += node.can_move;
    if (moving) rows.add(fmt::format("{} nodes", moving), "matrices when they change", "animated");
    if (scene.nodes.size() > moving)
        rows.leave_out(fmt::format("{} nodes", scene.nodes.size() - moving), "matrices made once",
                       "nothing above them is animated");
}

}  // namespace kinora
