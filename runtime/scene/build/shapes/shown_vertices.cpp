// runtime/scene/build/shapes/shown_vertices.cpp: the vertices of triangles, where they stand in the
// world.
#include "runtime/scene/build/shapes/shown_vertices.h"

#include <cmath>

namespace kinora {

namespace {

std::vector<uint32_t> used_positions(const Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const MeshGroup& group : mesh.groups)
        for (uint32_t i : group.triangles) used[i] = true;
    std::vector<uint32_t> result;
    for (uint32_t i = 0; i < used.size(); ++i)
        if (used[i]) result.push_back(i);
    return result;
}

}  // namespace

ShownVertices::ShownVertices(const SceneShapes& scene, const Pose& pose)
    : scene_(scene), pose_(pose), used_(scene.meshes.size()) {
    for (const Shape& shape : scene.shapes)
        if (used_[shape.mesh].empty()) used_[shape.mesh] = used_positions(scene.meshes[shape.mesh]);
}

std::span<const dvec3> ShownVertices::of(uint32_t index) {
    const Shape& shape = scene_.shapes[index];
    const Mesh& mesh = scene_.meshes[shape.mesh];
    bool deforms = shape.kind == raytrace::GeometryKind::Deforming;
    dmat4 world = pose_.nodes[shape.node].world * shape.conversion;
    world_.clear();
    for (uint32_t i : used_[shape.mesh]) {
        dvec3 p = deforms ? dvec3(pose_.shapes[index].positions[i]) + scene_.origin
                          : dvec3(world * dvec4(dvec3(mesh.positions[i]) + mesh.anchor, 1.0));
        if (std::isfinite(p.x + p.y + p.z)) world_.push_back(p);
    }
    return world_;
}

}  // namespace kinora
