// runtime/scene/build/shapes/shapes.cpp: meshes on nodes.
#include "runtime/scene/build/shapes/shapes.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "runtime/scene/build/shapes/mesh.h"
#include "runtime/scene/build/shapes/morphs.h"
#include "runtime/scene/description/displacements.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

Shape::Shape() = default;
Shape::~Shape() = default;
Shape::Shape(Shape&&) noexcept = default;
Shape& Shape::operator=(Shape&&) noexcept = default;

namespace {
constexpr size_t kMostSurfaces = 1'000'000;

// Meshes whose definitions are read after they are built: by displacement, which dices them anew,
// and by morphs.
std::vector<bool> read_again(const SceneDescription& description) {
    bool displaced = std::any_of(
        description.materials.begin(), description.materials.end(),
        [](const MaterialDefinition& m) { return displaces(m) || !m.transformations.empty(); });
    std::vector<bool> result(description.meshes.size(), displaced);
    for (const MorphDefinition& morph : description.morphs)
        for (uint32_t target : morph.targets)
            if (target < result.size()) result[target] = true;
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            if (use.morph != kNone) result[use.mesh] = true;
    return result;
}

// Its attributes stay: surfaces point at them.
void release_geometry(MeshDefinition& mesh) {
    std::vector<dvec3>().swap(mesh.positions);
    for (PrimitiveGroup& group : mesh.groups) std::vector<uint32_t>().swap(group.triangles);
}

// Those that are there.
std::span<const MeshUse> meshes_of(const SceneDescription& description, const Node& node) {
    if (node.hidden || !node.chosen) return {};
    return description.nodes[node.definition].meshes;
}

// How often nodes use each mesh.
std::vector<size_t> add_meshes(const SceneNodes& nodes, SceneShapes& scene) {
    SceneDescription& description = *nodes.description;
    std::vector<bool> deforms(description.meshes.size(), false);
    std::vector<size_t> uses(description.meshes.size(), 0);
    for (const Node& node : nodes.nodes)
        for (const MeshUse& use : meshes_of(description, node)) {
            deforms[use.mesh] = deforms[use.mesh] || use.skin != kNone || use.morph != kNone;
            ++uses[use.mesh];
        }
    std::vector<bool> kept = read_again(description);
    for (size_t m = 0; m < description.meshes.size(); ++m) {
        scene.meshes.push_back(uses[m] ? build_mesh(description.meshes[m], deforms[m]) : Mesh());
        scene.meshes.back().definition = uint32_t(m);
        if (!kept[m]) release_geometry(description.meshes[m]);
    }
    return uses;
}

// `uses`: how many shapes the mesh has.
raytrace::GeometryKind kind_of(const MeshUse& use, const Node& node, const Mesh& mesh, bool lasts,
                               size_t uses) {
    if (use.skin != kNone || use.morph != kNone) return raytrace::GeometryKind::Deforming;
    size_t triangles = 0;
    for (const MeshGroup& group : mesh.groups) triangles += group.triangles.size() / 3;
    if (node.can_move || lasts || (uses > 1 && triangles > kBakedTriangles / uses))
        return raytrace::GeometryKind::Instanced;
    return raytrace::GeometryKind::Static;
}

void add_shape(const SceneNodes& nodes, SceneShapes& scene, Pose& start, const MeshUse& use,
               uint32_t node, size_t uses, const SkinBinder& skins, Diagnostics& diagnostics) {
    const Mesh& mesh = scene.meshes[use.mesh];
    Shape& shape = scene.shapes.emplace_back();
    shape.mesh = use.mesh;
    shape.node = node;
    shape.skin = use.skin;
    shape.morph = use.morph;
    shape.conversion = use.conversion;
    shape.kind =
        kind_of(use, nodes.nodes[node], mesh, nodes.description->meshes[use.mesh].lasts, uses);
    if (use.morph != kNone) add_morph(*nodes.description, scene, use.morph, shape, diagnostics);
    if (shape.kind == raytrace::GeometryKind::Deforming) skins.bind(use, mesh, shape);
    ShapePose& stands = start.shapes.emplace_back();
    size_shape(nodes, mesh, shape, stands);
    stands.world = start.nodes[node].world * shape.conversion;
    stands.mirrored = glm::determinant(dmat3(stands.world)) < 0;
}

uint32_t seen_by(const Visibility& visibility) {
    return (visibility.camera ? raytrace::kSeenByCamera : 0) |
           (visibility.reflections ? raytrace::kSeenByReflections : 0) |
           (visibility.diffuse ? raytrace::kSeenByDiffuse : 0) |
           (visibility.shadows ? raytrace::kSeenByShadows : 0);
}

// Of the last shape: one a group of its mesh.
void add_surfaces(SceneShapes& scene, const MeshUse& use, std::vector<SurfaceUse>& surface_uses) {
    const Mesh& mesh = scene.meshes[use.mesh];
    for (uint32_t g = 0; g < mesh.groups.size(); ++g) {
        Surface surface;
        surface.shape = uint32_t(scene.shapes.size() - 1);
        surface.group = g;
        surface.seen_by = seen_by(use.visibility);
        surface.matte = use.visibility.matte;
        scene.surfaces.push_back(surface);
        SurfaceUse& added = surface_uses.emplace_back();
        added.mesh = &use;
        for (const MaterialUse& material : use.materials)
            if (material.symbol == mesh.groups[g].symbol) added.material = &material;
    }
}

}  // namespace

std::vector<SurfaceUse> add_shapes(const SceneNodes& nodes, SceneShapes& scene, Pose& start,
                                   const SkinBinder& skins, Diagnostics& diagnostics) {
    std::vector<size_t> uses = add_meshes(nodes, scene);
    std::vector<SurfaceUse> surface_uses;
    for (uint32_t n = 0; n < nodes.nodes.size(); ++n)
        for (const MeshUse& use : meshes_of(*nodes.description, nodes.nodes[n])) {
            size_t groups = scene.meshes[use.mesh].groups.size();
            if (groups == 0) continue;
            if (scene.surfaces.size() + groups > kMostSurfaces) {
                diagnostics.report(Code::SCENE_LIMIT, Location{}, kMostSurfaces);
                return surface_uses;
            }
            add_shape(nodes, scene, start, use, n, uses[use.mesh], skins, diagnostics);
            add_surfaces(scene, use, surface_uses);
        }
    return surface_uses;
}

}  // namespace kinora
