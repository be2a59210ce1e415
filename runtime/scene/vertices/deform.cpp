// runtime/scene/vertices/deform.cpp: morphs and skins into accel space; instance matrices.
#include "runtime/scene/vertices/deform.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

#include "runtime/base/memory/pages.h"
#include "runtime/base/stats.h"
#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

namespace {

bool changed_bit(const Pose& pose, uint32_t owner) {
    return pose.first_frame || (pose.changed[owner / 64] >> (owner % 64) & 1);
}

// Calls f(index) for what a frame may have to bring up to date: in the first frame for all.
template <class F>
void for_each_moving(const Pose& pose, size_t count, std::span<const uint32_t> moving, F&& f) {
    if (pose.first_frame)
        for (uint32_t k = 0; k < count; ++k) f(k);
    else
        for (uint32_t k : moving) f(k);
}

bool joints_moved(const Pose& pose, const Shape& shape) {
    if (pose.nodes[shape.node].moved) return true;
    return std::any_of(shape.joint_nodes.begin(), shape.joint_nodes.end(),
                       [&](uint32_t n) { return n != kNone && pose.nodes[n].moved; });
}

bool morph_changed(const Scene& scene, const Pose& pose, const Shape& shape) {
    const SceneDescription& description = *scene.description;
    for (uint32_t m = shape.morph; m != kNone; m = description.morphs[m].base)
        if (changed_bit(pose, uint32_t(description.nodes.size()) + m)) return true;
    return false;
}

void update_world(const Pose& pose, const Shape& shape, ShapePose& stands) {
    stands.world = pose.nodes[shape.node].world * shape.conversion;
    stands.mirrored = glm::determinant(dmat3(stands.world)) < 0;
}

// A skin is turned inside out by its joints, not by its node.
bool most_mirror(std::span<const skin::JointMatrix> joints) {
    auto mirrors = [](const skin::JointMatrix& m) {
        auto column = [&](int c) { return dvec3(m.c[c][0], m.c[c][1], m.c[c][2]); };
        return glm::dot(glm::cross(column(0), column(1)), column(2)) < 0;
    };
    return 2 * size_t(std::ranges::count_if(joints, mirrors)) > joints.size();
}

void morph(const Scene& scene, const Pose& pose, const Shape& shape, ShapePose& stands) {
    morph_weights(*scene.description, pose.values, shape.morph, stands.morph_weights);
    skin::deform(scene.morphs[shape.morph_data], stands.morph_weights, stands.morphed_positions,
                 stands.morphed_normals);
}

// The shaders on a mesh that no skin moves: in its own space, the node's matrix comes later.
void displace_mesh(const Scene& scene, Pose& pose, const Shape& shape, ShapePose& stands,
                   double& ms) {
    StageTimer timer(ms);
    const Mesh& mesh = scene.meshes[shape.mesh];
    bool morphed = shape.morph != kNone;
    std::ranges::copy(morphed ? stands.morphed_positions : mesh.positions,
                      stands.displaced_positions.begin());
    std::ranges::copy(morphed ? stands.morphed_normals : mesh.normals,
                      stands.displaced_normals.begin());
    shape.vertex_work->run(scene, pose, *stands.vertex_state,
                           {.node = shape.node,
                            .object_from_mesh = shape.conversion,
                            .anchor = mesh.anchor,
                            .positions = stands.displaced_positions,
                            .normals = stands.displaced_normals});
}

// On what a skin gives: from accel space to the node's and back.
void displace_skin(const Scene& scene, Pose& pose, const Shape& shape, ShapePose& stands,
                   double& ms) {
    StageTimer timer(ms);
    shape.vertex_work->run(scene, pose, *stands.vertex_state,
                           {.node = shape.node,
                            .object_from_mesh = glm::inverse(pose.nodes[shape.node].world),
                            .anchor = scene.origin,
                            .positions = stands.positions,
                            .normals = stands.normals,
                            .mirrored = stands.mirrored});
}

// Returns the vertices that it moved.
size_t deform_shape(const Scene& scene, Pose& pose, const Shape& shape, ShapePose& stands,
                    double& displace_ms) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    bool morphed = morph_changed(scene, pose, shape);
    if (morphed) morph(scene, pose, shape, stands);
    bool each_frame = shape.vertex_work && shape.vertex_work->each_frame;
    if (!morphed && !each_frame && !pose.first_frame && !joints_moved(pose, shape)) return 0;
    bool skinned = shape.skin != kNone;
    if (shape.vertex_work && !stands.vertex_state)
        stands.vertex_state = std::make_shared<VertexState>(*shape.vertex_work);
    if (shape.vertex_work && !skinned && (morphed || each_frame || pose.first_frame))
        displace_mesh(scene, pose, shape, stands, displace_ms);
    std::span<const vec4> positions = mesh.positions, normals = mesh.normals;
    if (shape.morph != kNone) {
        positions = stands.morphed_positions;
        normals = stands.morphed_normals;
    }
    if (shape.vertex_work && !skinned) {
        positions = stands.displaced_positions;
        normals = stands.displaced_normals;
    }
    move_by_joints(stands, shape.skin_mesh, positions, normals, stands.positions, stands.normals);
    if (shape.vertex_work && skinned) displace_skin(scene, pose, shape, stands, displace_ms);
    ++stands.positions_version;
    return stands.positions.size();
}

void pose_shape(const Scene& scene, const Pose& pose, const Shape& shape, ShapePose& stands) {
    update_world(pose, shape, stands);
    skin::Anchors anchors{scene.meshes[shape.mesh].anchor, scene.origin};
    if (shape.skin == kNone) {
        stands.palette.assign(stands.palette.size(), skin::joint_matrix(stands.world, anchors));
        return;
    }
    dmat4 to_world(1.0);
    if (!shape.in_world) to_world = pose.nodes[shape.node].world;
    if (shape.applies_below != kNone)
        to_world = to_world * glm::inverse(pose.nodes[shape.applies_below].world);
    // The palette reads matrices by joint; unresolved joints stay with the bind shape.
    for (size_t j = 0; j < shape.joint_nodes.size(); ++j) {
        uint32_t node = shape.joint_nodes[j];
        dmat4& world = stands.joint_world[j];
        world = node == kNone ? dmat4(1.0) : pose.nodes[node].world;
        if (!shape.in_world) world = to_world * world;
    }
    skin::pose(
        shape.skeleton, stands.joint_world, anchors, stands.palette,
        shape.in_world ? path_conversion(scene, shape.node) * shape.conversion : stands.world);
    stands.mirrored = most_mirror(std::span(stands.palette).subspan(1));
    std::ranges::transform(stands.palette.begin(),
                           stands.palette.begin() + ptrdiff_t(stands.dual_palette.size()),
                           stands.dual_palette.begin(), skin::dual_joint);
}

// The ray tracer's row of a surface.
void update_row(const Scene& scene, Pose& pose, uint32_t surface) {
    const Shape& shape = scene.shapes[scene.surfaces[surface].shape];
    const ShapePose& stands = pose.shapes[scene.surfaces[surface].shape];
    raytrace::Geometry& row = pose.rows[surface];
    row.positions_version = stands.positions_version;
    row.mirrored = stands.mirrored;
    if (shape.kind != raytrace::GeometryKind::Instanced) return;
    dmat4 to_accel(1.0), from_anchor(1.0);
    to_accel[3] = dvec4(-scene.origin, 1.0);
    from_anchor[3] = dvec4(scene.meshes[shape.mesh].anchor, 1.0);
    row.accel_from_local = to_accel * stands.world * from_anchor;
    row.mirrored = false;
}

}  // namespace

void pose_joints(const Scene& scene, Pose& pose) {
    for_each_moving(pose, scene.shapes.size(), scene.moving.shapes, [&](uint32_t s) {
        const Shape& shape = scene.shapes[s];
        if (shape.kind != raytrace::GeometryKind::Deforming) return;
        if (pose.first_frame || joints_moved(pose, shape))
            pose_shape(scene, pose, shape, pose.shapes[s]);
    });
}

void move_by_joints(const ShapePose& shape, const skin::SkinMesh& skin,
                    std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                    std::span<vec4> positions, std::span<vec4> normals) {
    if (shape.dual_palette.empty())
        skin::deform(skin, shape.palette, rest_positions, rest_normals, positions, normals);
    else
        skin::deform_dual(skin, shape.dual_palette, rest_positions, rest_normals, positions,
                          normals);
}

double deform(const Scene& scene, Pose& pose, uint64_t* vertices) {
    double displace_ms = 0;
    uint64_t moved = 0;
    for_each_moving(pose, scene.shapes.size(), scene.moving.shapes, [&](uint32_t s) {
        const Shape& shape = scene.shapes[s];
        ShapePose& stands = pose.shapes[s];
        switch (shape.kind) {
            case raytrace::GeometryKind::Deforming:
                moved += deform_shape(scene, pose, shape, stands, displace_ms);
                break;
            case raytrace::GeometryKind::Instanced:
                if (pose.nodes[shape.node].moved) update_world(pose, shape, stands);
                break;
            case raytrace::GeometryKind::Static:
                if (pose.first_frame) update_world(pose, shape, stands);
                break;
        }
    });
    for_each_moving(pose, scene.surfaces.size(), scene.moving.surfaces,
                    [&](uint32_t s) { update_row(scene, pose, s); });
    if (vertices) *vertices = moved;
    return displace_ms;
}

bool is_singular(const ShapePose& shape) {
    return glm::determinant(dmat3(shape.world)) == 0;
}

void bake_static(Scene& scene) {
    for (size_t s = 0; s < scene.shapes.size(); ++s) {
        Shape& shape = scene.shapes[s];
        if (shape.kind != raytrace::GeometryKind::Static) continue;
        ShapePose& stands = scene.start.shapes[s];
        update_world(scene.start, shape, stands);
        const Mesh& mesh = scene.meshes[shape.mesh];
        dmat3 linear(stands.world);
        resize_pages(shape.positions, mesh.positions.size());
        resize_pages(shape.normals, mesh.normals.size());
        stands.shown_positions = shape.positions;
        stands.shown_normals = shape.normals;
        if (is_singular(stands)) {  // triangles without area, which no ray hits
            std::fill(shape.positions.begin(), shape.positions.end(), vec4(0.0f));
            continue;
        }
        dvec3 offset = linear * mesh.anchor + dvec3(stands.world[3]) - scene.origin;
        dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                       glm::cross(linear[0], linear[1]));
        if (stands.mirrored) cofactor = -cofactor;
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            shape.positions[i] = vec4(vec3(linear * dvec3(mesh.positions[i]) + offset), 0.0f);
        for (size_t i = 0; i < mesh.normals.size(); ++i) {
            dvec3 n = cofactor * dvec3(mesh.normals[i]);
            double length = glm::length(n);
            shape.normals[i] = vec4(length > 0 ? vec3(n / length) : vec3(0.0f), 0.0f);
        }
    }
}

}  // namespace kinora
