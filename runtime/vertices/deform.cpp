// runtime/vertices/deform.cpp: morphs and skins into accel space; instance matrices.
#include "runtime/vertices/deform.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

#include "runtime/base/stats.h"
#include "runtime/description/morph_weights.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/transforms.h"
#include "runtime/vertices/vertex_work.h"

namespace kinora {

namespace {

bool changed_bit(const Scene& scene, uint32_t owner) {
    return scene.first_frame || (scene.changed[owner / 64] >> (owner % 64) & 1);
}

// Calls f(index) for what a frame may have to bring up to date: in the first frame for all.
template <class F>
void for_each_moving(const Scene& scene, size_t count, std::span<const uint32_t> moving, F&& f) {
    if (scene.first_frame)
        for (uint32_t k = 0; k < count; ++k) f(k);
    else
        for (uint32_t k : moving) f(k);
}

bool joints_moved(const Scene& scene, const Shape& shape) {
    if (scene.nodes[shape.node].moved) return true;
    return std::any_of(shape.joint_nodes.begin(), shape.joint_nodes.end(),
                       [&](uint32_t n) { return n != kNone && scene.nodes[n].moved; });
}

bool morph_changed(const Scene& scene, const Shape& shape) {
    const SceneDescription& description = *scene.description;
    for (uint32_t m = shape.morph; m != kNone; m = description.morphs[m].base)
        if (changed_bit(scene, uint32_t(description.nodes.size()) + m)) return true;
    return false;
}

void update_world(const Scene& scene, Shape& shape) {
    shape.world = scene.nodes[shape.node].world * shape.conversion;
    shape.mirrored = glm::determinant(dmat3(shape.world)) < 0;
}

// A skin is turned inside out by its joints, not by its node.
bool most_mirror(std::span<const skin::JointMatrix> joints) {
    auto mirrors = [](const skin::JointMatrix& m) {
        auto column = [&](int c) { return dvec3(m.c[c][0], m.c[c][1], m.c[c][2]); };
        return glm::dot(glm::cross(column(0), column(1)), column(2)) < 0;
    };
    return 2 * size_t(std::ranges::count_if(joints, mirrors)) > joints.size();
}

void morph(Scene& scene, Shape& shape) {
    morph_weights(*scene.description, scene.values, shape.morph, shape.morph_weights);
    skin::deform(scene.morphs[shape.morph_data], shape.morph_weights, shape.morphed_positions,
                 shape.morphed_normals);
}

// The shaders on a mesh that no skin moves: in its own space, the node's matrix comes later.
void displace_mesh(Scene& scene, Shape& shape, double& ms) {
    StageTimer timer(ms);
    const Mesh& mesh = scene.meshes[shape.mesh];
    bool morphed = shape.morph != kNone;
    std::ranges::copy(morphed ? shape.morphed_positions : mesh.positions,
                      shape.displaced_positions.begin());
    std::ranges::copy(morphed ? shape.morphed_normals : mesh.normals,
                      shape.displaced_normals.begin());
    shape.vertex_work->run(scene, shape.node, shape.conversion, mesh.anchor,
                           shape.displaced_positions, shape.displaced_normals);
}

// On what a skin gives: from accel space to the node's and back.
void displace_skin(Scene& scene, Shape& shape, double& ms) {
    StageTimer timer(ms);
    shape.vertex_work->run(scene, shape.node, glm::inverse(scene.nodes[shape.node].world),
                           scene.origin, shape.positions, shape.normals, shape.mirrored);
}

// Returns the vertices that it moved.
size_t deform_shape(Scene& scene, Shape& shape, double& displace_ms) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    bool morphed = morph_changed(scene, shape);
    if (morphed) morph(scene, shape);
    bool each_frame = shape.vertex_work && shape.vertex_work->each_frame;
    if (!morphed && !each_frame && !scene.first_frame && !joints_moved(scene, shape)) return 0;
    bool skinned = shape.skin != kNone;
    if (shape.vertex_work && !skinned && (morphed || each_frame || scene.first_frame))
        displace_mesh(scene, shape, displace_ms);
    std::span<const vec4> positions = mesh.positions, normals = mesh.normals;
    if (shape.morph != kNone) {
        positions = shape.morphed_positions;
        normals = shape.morphed_normals;
    }
    if (shape.vertex_work && !skinned) {
        positions = shape.displaced_positions;
        normals = shape.displaced_normals;
    }
    move_by_joints(shape, shape.skin_mesh, positions, normals, shape.positions, shape.normals);
    if (shape.vertex_work && skinned) displace_skin(scene, shape, displace_ms);
    ++shape.positions_version;
    return shape.positions.size();
}

}  // namespace

namespace {

void pose_shape(const Scene& scene, Shape& shape) {
    update_world(scene, shape);
    skin::Anchors anchors{scene.meshes[shape.mesh].anchor, scene.origin};
    if (shape.skin == kNone) {
        shape.palette.assign(shape.palette.size(), skin::joint_matrix(shape.world, anchors));
        return;
    }
    dmat4 to_world(1.0);
    if (!shape.in_world) to_world = scene.nodes[shape.node].world;
    if (shape.applies_below != kNone)
        to_world = to_world * glm::inverse(scene.nodes[shape.applies_below].world);
    // The palette reads matrices by joint; unresolved joints stay with the bind shape.
    for (size_t j = 0; j < shape.joint_nodes.size(); ++j) {
        uint32_t node = shape.joint_nodes[j];
        dmat4& world = shape.joint_world[j];
        world = node == kNone ? dmat4(1.0) : scene.nodes[node].world;
        if (!shape.in_world) world = to_world * world;
    }
    skin::pose(
        shape.skeleton, shape.joint_world, anchors, shape.palette,
        shape.in_world ? path_conversion(scene, shape.node) * shape.conversion : shape.world);
    shape.mirrored = most_mirror(std::span(shape.palette).subspan(1));
    std::ranges::transform(shape.palette.begin(),
                           shape.palette.begin() + ptrdiff_t(shape.dual_palette.size()),
                           shape.dual_palette.begin(), skin::dual_joint);
}

// The ray tracer's row of a surface.
void update_row(Scene& scene, uint32_t surface) {
    const Shape& shape = scene.shapes[scene.surfaces[surface].shape];
    raytrace::Geometry& row = scene.geometry[surface];
    row.positions_version = shape.positions_version;
    row.mirrored = shape.mirrored;
    if (shape.kind != raytrace::GeometryKind::Instanced) return;
    dmat4 to_accel(1.0), from_anchor(1.0);
    to_accel[3] = dvec4(-scene.origin, 1.0);
    from_anchor[3] = dvec4(scene.meshes[shape.mesh].anchor, 1.0);
    row.accel_from_local = to_accel * shape.world * from_anchor;
    row.mirrored = false;
}

}  // namespace

void pose(Scene& scene) {
    for_each_moving(scene, scene.shapes.size(), scene.moving.shapes, [&](uint32_t s) {
        Shape& shape = scene.shapes[s];
        if (shape.kind != raytrace::GeometryKind::Deforming) return;
        if (scene.first_frame || joints_moved(scene, shape)) pose_shape(scene, shape);
    });
}

void move_by_joints(const Shape& shape, const skin::SkinMesh& skin,
                    std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                    std::span<vec4> positions, std::span<vec4> normals) {
    if (shape.dual_palette.empty())
        skin::deform(skin, shape.palette, rest_positions, rest_normals, positions, normals);
    else
        skin::deform_dual(skin, shape.dual_palette, rest_positions, rest_normals, positions,
                          normals);
}

double deform(Scene& scene, uint64_t* vertices) {
    double displace_ms = 0;
    uint64_t moved = 0;
    for_each_moving(scene, scene.shapes.size(), scene.moving.shapes, [&](uint32_t s) {
        Shape& shape = scene.shapes[s];
        if (shape.kind == raytrace::GeometryKind::Deforming)
            moved += deform_shape(scene, shape, displace_ms);
        if (shape.kind == raytrace::GeometryKind::Instanced && scene.nodes[shape.node].moved)
            update_world(scene, shape);
    });
    for_each_moving(scene, scene.surfaces.size(), scene.moving.surfaces,
                    [&](uint32_t s) { update_row(scene, s); });
    if (vertices) *vertices = moved;
    return displace_ms;
}

bool is_singular(const Shape& shape) {
    return glm::determinant(dmat3(shape.world)) == 0;
}

void bake_static(Scene& scene) {
    for (Shape& shape : scene.shapes) {
        if (shape.kind != raytrace::GeometryKind::Static) continue;
        update_world(scene, shape);
        const Mesh& mesh = scene.meshes[shape.mesh];
        dmat3 linear(shape.world);
        ++shape.positions_version;
        if (is_singular(shape)) {  // triangles without area, which no ray hits
            std::fill(shape.positions.begin(), shape.positions.end(), vec4(0.0f));
            continue;
        }
        dvec3 offset = linear * mesh.anchor + dvec3(shape.world[3]) - scene.origin;
        dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                       glm::cross(linear[0], linear[1]));
        if (shape.mirrored) cofactor = -cofactor;
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
