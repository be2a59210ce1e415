// runtime/scene/pose.cpp: room for all that a time decides.
#include "runtime/scene/pose.h"

#include "runtime/base/memory/pages.h"
#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

void size_deforming(const SceneResources& scene, const Mesh& mesh, const Shape& shape,
                    ShapePose& stands) {
    const size_t positions = mesh.positions.size(), normals = mesh.normals.size();
    resize_pages(stands.positions, positions);
    resize_pages(stands.normals, normals);
    // Matrix 0 is of vertices without a joint; without a skin the node's matrix is the only other.
    const bool skinned = shape.skin != kNone;
    const size_t joints = skinned ? shape.joint_nodes.size() : 1;
    stands.palette.resize(joints + 1);
    if (skinned) stands.joint_world.resize(joints, dmat4(1.0));
    if (skinned && scene.options.quality.skin_method == SkinMethod::Dual)
        stands.dual_palette.resize(joints + 1);
    if (shape.morph != kNone) {
        stands.morph_weights.resize(chain_targets(*scene.description, shape.morph));
        stands.morphed_positions.resize(positions);
        stands.morphed_normals.resize(normals);
    }
    if (shape.vertex_work && !skinned) {
        stands.displaced_positions.resize(positions);
        stands.displaced_normals.resize(normals);
    }
}

}  // namespace

void size_shape(const SceneResources& scene, const Mesh& mesh, const Shape& shape,
                ShapePose& stands) {
    stands = {};
    switch (shape.kind) {
        case raytrace::GeometryKind::Instanced:
            stands.shown_positions = mesh.positions;
            stands.shown_normals = mesh.normals;
            break;
        case raytrace::GeometryKind::Static:
            stands.shown_positions = shape.positions;
            stands.shown_normals = shape.normals;
            break;
        case raytrace::GeometryKind::Deforming:
            size_deforming(scene, mesh, shape, stands);
            stands.shown_positions = stands.positions;
            stands.shown_normals = stands.normals;
            break;
    }
}

void size_outputs(const SceneShapes& scene, Pose& pose) {
    pose.vertex_outputs.resize(scene.vertex_outputs.size());
    for (size_t o = 0; o < scene.vertex_outputs.size(); ++o)
        pose.vertex_outputs[o].resize(scene.vertex_outputs[o]);
}

std::span<const float> values_of(const VertexAttribute& attribute, const Pose& pose) {
    return attribute.output == kNone ? attribute.values : pose.vertex_outputs[attribute.output];
}

Pose::Pose(const Scene& scene)
    : camera(scene.start.camera),
      values(scene.start.values),
      changed(scene.start.changed.size(), 0),
      nodes(scene.nodes.size()),
      shapes(scene.shapes.size()),
      watched(scene.watched.size()),
      rows(scene.rows),
      accel(accel_policy(scene.options)),
      watch_dark(scene.watch_dark) {
    size_outputs(scene, *this);
    for (size_t s = 0; s < shapes.size(); ++s) {
        const Shape& shape = scene.shapes[s];
        size_shape(scene, scene.meshes[shape.mesh], shape, shapes[s]);
    }
    for (size_t s = 0; s < rows.size(); ++s)
        rows[s].positions = shapes[scene.surfaces[s].shape].shown_positions;
}

}  // namespace kinora
