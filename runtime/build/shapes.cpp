// runtime/build/shapes.cpp: meshes on nodes, with the morphs and skins that deform them.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/skin_space.h"
#include "runtime/build/mesh.h"
#include "runtime/build/scene_p.h"
#include "runtime/description/findings.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {
constexpr size_t kMostSurfaces = 1'000'000;

// Meshes whose definitions are read after they are built: by displacement, which dices them anew,
// and by morphs.
std::vector<bool> read_again(const SceneDescription& description) {
    bool displaced = std::any_of(description.materials.begin(), description.materials.end(),
                                 [](const MaterialDefinition& m) {
                                     return !m.displacements.empty() || !m.transformations.empty();
                                 });
    std::vector<bool> result(description.meshes.size(), displaced);
    for (const MorphDefinition& morph : description.morphs)
        for (uint32_t target : morph.targets)
            if (target < result.size()) result[target] = true;
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            if (use.morph != kNone) result[use.mesh] = true;
    return result;
}

// Its attributes stay: looks point at them.
void release_geometry(MeshDefinition& mesh) {
    std::vector<dvec3>().swap(mesh.positions);
    for (PrimitiveGroup& group : mesh.groups) std::vector<uint32_t>().swap(group.triangles);
}
}  // namespace

// Those that are there.
std::span<const MeshUse> SceneBuilder::meshes_of(const Node& node) const {
    if (node.hidden || !node.chosen) return {};
    return description_.nodes[node.definition].meshes;
}

void SceneBuilder::place_meshes() {
    Scene& scene = *scene_;
    std::vector<bool> deforms(description_.meshes.size(), false);
    std::vector<size_t> uses(description_.meshes.size(), 0);
    for (const Node& node : scene.nodes)
        for (const MeshUse& use : meshes_of(node)) {
            deforms[use.mesh] = deforms[use.mesh] || use.skin != kNone || use.morph != kNone;
            ++uses[use.mesh];
        }
    std::vector<bool> kept = read_again(description_);
    for (size_t m = 0; m < description_.meshes.size(); ++m) {
        scene.meshes.push_back(uses[m] ? build_mesh(description_.meshes[m], deforms[m]) : Mesh());
        scene.meshes.back().definition = uint32_t(m);
        if (!kept[m]) release_geometry(description_.meshes[m]);
    }
    for (uint32_t n = 0; n < scene.nodes.size(); ++n)
        for (const MeshUse& use : meshes_of(scene.nodes[n])) {
            if (scene.meshes[use.mesh].groups.empty()) continue;
            if (scene.surfaces.size() + scene.meshes[use.mesh].groups.size() > kMostSurfaces) {
                diagnostics_.report(Code::SCENE_LIMIT, Location{}, kMostSurfaces);
                return;
            }
            place_mesh(use, n, uses[use.mesh]);
        }
}

void SceneBuilder::place_mesh(const MeshUse& use, uint32_t node, size_t uses) {
    Scene& scene = *scene_;
    const Mesh& mesh = scene.meshes[use.mesh];
    uint32_t index = uint32_t(scene.shapes.size());
    Shape& shape = scene.shapes.emplace_back();
    shape.mesh = use.mesh;
    shape.node = node;
    shape.skin = use.skin;
    shape.morph = use.morph;
    shape.conversion = use.conversion;
    size_t triangles = 0;
    for (const MeshGroup& group : mesh.groups) triangles += group.triangles.size() / 3;
    if (use.skin != kNone || use.morph != kNone) {
        shape.kind = raytrace::GeometryKind::Deforming;
        if (use.morph != kNone) add_morph(use, shape);
        add_skin(use, node, shape);
    } else if (scene.nodes[node].can_move || (uses > 1 && triangles > kBakedTriangles / uses)) {
        shape.kind = raytrace::GeometryKind::Instanced;
    }
    shape.world = scene.nodes[node].world * shape.conversion;
    shape.mirrored = glm::determinant(dmat3(shape.world)) < 0;
    if (shape.kind != raytrace::GeometryKind::Instanced) {
        shape.positions.resize(mesh.positions.size());
        shape.normals.resize(mesh.normals.size());
    }
    for (uint32_t g = 0; g < mesh.groups.size(); ++g) {
        Surface surface;
        surface.shape = index;
        surface.group = g;
        scene.surfaces.push_back(surface);
        uses_.push_back(&use);
    }
}

void SceneBuilder::add_morph(const MeshUse& use, Shape& shape) {
    Scene& scene = *scene_;
    const Mesh& mesh = scene.meshes[use.mesh];
    scene.morphs.resize(description_.morphs.size());
    shape.morph_data = use.morph;
    shape.morphed_positions.resize(mesh.positions.size());
    shape.morphed_normals.resize(mesh.normals.size());
    if (!scene.morphs[use.morph].base_positions.empty()) return;
    const MorphDefinition& definition = description_.morphs[use.morph];
    std::vector<vec3> base(mesh.positions.begin(), mesh.positions.end());
    std::vector<vec3> base_normals(mesh.normals.begin(), mesh.normals.end());
    std::vector<std::vector<vec3>> positions, normals;
    for (uint32_t t : definition.targets) {
        const MeshDefinition& target = description_.meshes[t];
        auto& p = positions.emplace_back();
        for (const dvec3& x : target.positions)
            p.push_back(vec3(x - (definition.relative ? dvec3(0.0) : mesh.anchor)));
        normals.push_back(
            target_normals(target, mesh, description_.meshes[use.mesh], definition.relative));
    }
    std::vector<skin::MorphTargetSource> sources;
    for (size_t t = 0; t < positions.size(); ++t) sources.push_back({positions[t], normals[t]});
    uint32_t mismatched = 0;
    scene.morphs[use.morph] = skin::build_morph(
        definition.relative ? skin::MorphMethod::Relative : skin::MorphMethod::Normalized, base,
        base_normals, sources, &mismatched);
    if (mismatched)
        diagnostics_.report(Code::MORPH_VERTEX_COUNT, definition.where, definition.id, mismatched);
}

// A target's normals in the order of the base's entries: the file's, where target and base have the
// same corners; smooth ones where neither has any; else none (the base's stay).
std::vector<vec3> SceneBuilder::target_normals(const MeshDefinition& target, const Mesh& base,
                                               const MeshDefinition& base_definition,
                                               bool relative) {
    auto normals_of = [](const PrimitiveGroup& group) {
        const VertexAttribute* found = nullptr;
        for (const VertexAttribute& a : group.attributes)
            if (a.semantic == "NORMAL" && a.stride >= 3) found = &a;
        return found;
    };
    std::vector<vec3> result(base.normals.size(), vec3(0.0f));
    bool smooth = true;
    for (const PrimitiveGroup& group : base_definition.groups) smooth &= !normals_of(group);
    if (smooth && target.positions.size() == base_definition.positions.size()) {
        MeshDefinition moved = base_definition;
        for (size_t i = 0; i < moved.positions.size(); ++i)
            moved.positions[i] = target.positions[i] + (relative ? moved.positions[i] : dvec3(0.0));
        Mesh mesh = build_mesh(moved, true);
        for (size_t i = 0; i < result.size(); ++i)
            result[i] = vec3(mesh.normals[i]) - (relative ? vec3(base.normals[i]) : vec3(0.0f));
        return result;
    }
    if (target.groups.size() != base_definition.groups.size()) return {};
    for (size_t g = 0; g < target.groups.size(); ++g) {
        const VertexAttribute* normals = normals_of(target.groups[g]);
        const std::vector<uint32_t>& entries = base.groups[g].normal_corners;
        if (!normals || normals->corners.size() != entries.size()) return {};
        for (size_t c = 0; c < entries.size(); ++c) {
            const float* v = &normals->values[size_t(normals->corners[c]) * normals->stride];
            result[entries[c]] = vec3(v[0], v[1], v[2]);
        }
    }
    return result;
}

// A skin and its joints may come from files of different units and axes: what the inverse bind
// matrices give is brought from the skin's document into that of each joint. Joints that are not
// there leave the bind shape where it is, in the scene's.
void SceneBuilder::convert_skin(uint32_t node, Shape& shape) {
    dmat4 from_skin = path_conversion(*scene_, node) * shape.conversion;
    for (size_t j = 0; j < shape.joint_nodes.size(); ++j) {
        dmat4& inverse_bind = shape.skeleton.inverse_bind[j];
        if (shape.joint_nodes[j] == kNone) {
            inverse_bind = from_skin;
            continue;
        }
        dmat4 from_joint = path_conversion(*scene_, shape.joint_nodes[j]);
        if (from_joint != from_skin)
            inverse_bind = glm::inverse(from_joint) * from_skin * inverse_bind;
    }
}

void SceneBuilder::add_skin(const MeshUse& use, uint32_t node, Shape& shape) {
    Scene& scene = *scene_;
    std::string id = description_.meshes[use.mesh].id;
    Location where;
    uint32_t joints = 1;
    if (use.skin != kNone) {
        const SkinDefinition& definition = description_.skins[use.skin];
        id = definition.id;
        where = definition.where;
        joints = uint32_t(definition.inverse_bind.size());
        shape.skeleton.inverse_bind = definition.inverse_bind;
        shape.skeleton.bind_shape = definition.bind_shape;
        for (uint32_t j = 0; j < joints; ++j) {
            shape.skeleton.nodes.push_back(j);
            uint32_t joint = j < use.joint_nodes.size() ? use.joint_nodes[j] : kNone;
            shape.joint_nodes.push_back(nearest_occurrence(joint, node));
        }
        shape.joint_world.resize(joints, dmat4(1.0));
        convert_skin(node, shape);
        std::vector<bool> used(joints);
        for (int32_t joint : definition.joints)
            if (joint >= 0 && size_t(joint) < used.size()) used[size_t(joint)] = true;
        SkinPose rest, start;
        std::vector<RestJoint> moving;
        rest.node = rest_world_[node];
        start.node = start_world_[node];
        dmat4 before = glm::inverse(shape.conversion);
        for (size_t j = 0; j < joints; ++j) {
            uint32_t joint = shape.joint_nodes[j];
            if (joint == kNone) continue;
            dmat4 inverse_bind = shape.skeleton.inverse_bind[j] * before;
            rest.joints.push_back({rest_world_[joint], inverse_bind});
            start.joints.push_back({start_world_[joint], inverse_bind});
            if (used[j]) moving.push_back(rest.joints.back());
        }
        size_t mirroring = mirroring_joints(definition.bind_shape, moving);
        if (mirroring && mirroring < moving.size())
            diagnostics_.report(Code::SKIN_MIXED_MIRROR, where, mirroring, moving.size(), id);
        uint32_t shared = shared_ancestor(node, shape.joint_nodes, kNone,
                                          [&](uint32_t n) { return scene.nodes[n].parent; });
        if (shared != kNone) rest.shared = rest_world_[shared];
        if (shared != kNone) start.shared = start_world_[shared];
        SkinPlace place;
        if (!definition.in_world) place = skin_place(definition.bind_shape, rest, start);
        SkinSpace space = place.space;
        if (space != SkinSpace::World) diagnostics_.report(Code::SKIN_NODE_TRANSFORM, where, id);
        if (space == SkinSpace::BindsNode)
            shape.skeleton.bind_shape = before * place.bind * shape.conversion;
        shape.in_world = space == SkinSpace::World || space == SkinSpace::BindsNode;
        for (size_t j = 0; j < joints && !shape.in_world; ++j)  // the node's matrix has the rest
            if (shape.joint_nodes[j] == kNone) shape.skeleton.inverse_bind[j] = shape.conversion;
        if (space == SkinSpace::NodeBelow) shape.placed_below = shared;
    }
    skin::SkinRepairs repairs;
    const Mesh& mesh = scene.meshes[shape.mesh];
    shape.skin_mesh =
        skin_mesh_of(use, mesh.positions.size(), mesh.normal_positions, nullptr, repairs);
    shape.palette.resize(joints + 1);
    if (repairs.weight_sum)
        diagnostics_.report(Code::SKIN_WEIGHT_SUM, where, id, repairs.weight_sum,
                            repairs.worst_sum);
    if (repairs.unweighted)
        diagnostics_.report(Code::SKIN_ZERO_INFLUENCE, where, id, repairs.unweighted);
}

// The influences of a mesh: as the file has them, or between its vertices where the mesh was diced.
skin::SkinMesh SceneBuilder::skin_mesh_of(const MeshUse& use, size_t vertices,
                                          std::span<const uint32_t> normal_positions,
                                          const std::vector<Stencil>* stencils,
                                          skin::SkinRepairs& repairs) {
    skin::InfluenceSource source;
    std::vector<uint32_t> first(vertices + 1, 0);
    std::vector<int32_t> joints;
    std::vector<double> weights;
    if (use.skin == kNone) {  // a morph alone: one matrix moves everything
        joints.assign(vertices, 0);
        weights.assign(vertices, 1.0);
        for (size_t i = 0; i < first.size(); ++i) first[i] = uint32_t(i);
        source.joint_count = 1;
    } else {
        const SkinDefinition& definition = description_.skins[use.skin];
        first.assign(definition.offsets.begin(), definition.offsets.end());
        joints = definition.joints;
        weights.assign(definition.weights.begin(), definition.weights.end());
        source.joint_count = uint32_t(definition.inverse_bind.size());
        if (stencils) dice_influences(*stencils, first, joints, weights);
    }
    source.first = first;
    source.joints = joints;
    source.weights = weights;
    return skin::build_skin(source, normal_positions, &repairs);
}

}  // namespace kinora
