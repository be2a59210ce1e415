// runtime/scene/build/displacement/diced_shapes.cpp: shapes whose mesh was diced.
#include "runtime/scene/build/displacement/diced_shapes.h"

#include <array>

#include "runtime/scene/build/displacement/diced_attributes.h"
#include "runtime/scene/build/shapes/shapes.h"
#include "runtime/scene/build/shapes/skins.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

namespace {

// What moves the vertices of each group.
std::vector<VertexWork::Use> vertex_uses(const Scene& scene, std::span<const uint32_t> surfaces,
                                         const Mesh& mesh) {
    std::vector<VertexWork::Use> uses;
    for (size_t g = 0; g < surfaces.size(); ++g) {
        const Surface& surface = scene.surfaces[surfaces[g]];
        VertexWork::Use& use = uses.emplace_back();
        use.st = surface.st;
        use.attributes = mesh.own_groups[g].get();
        std::array<const VertexUse*, VertexWork::kStages> stages = {&surface.transformation,
                                                                    &surface.displacement};
        for (size_t s = 0; s < stages.size(); ++s) {
            if (stages[s]->instance == kNone) continue;
            use.looks[s] = scene.vertex_instances[stages[s]->instance].get();
            use.varying[s] = stages[s]->varying;
        }
    }
    return uses;
}

void include_moved(Mesh& mesh) {
    for (const vec4& p : mesh.positions) {
        mesh.low = glm::min(mesh.low, dvec3(p) + mesh.anchor);
        mesh.high = glm::max(mesh.high, dvec3(p) + mesh.anchor);
    }
}

// A skin and morph for the vertices that the watched edges hang at.
void deform_watched(const Scene& scene, const Shape& shape, const MeshUse& use,
                    WatchedEdges& watched) {
    const std::vector<Stencil>& vertices = watched.vertices;
    skin::SkinRepairs reported;
    if (shape.morph != kNone)
        watched.morph = dice_morph(scene.morphs[shape.morph_data], vertices, {});
    watched.skin = skin_mesh_of(scene, use, vertices.size(), {}, &vertices, reported);
}

// The shape has its diced mesh, and still the morph of the mesh as read.
void make_deforming(Scene& scene, Shape& shape, const MeshUse& use, const DicedMesh& diced) {
    shape.kind = raytrace::GeometryKind::Deforming;
    const Mesh& mesh = scene.meshes[shape.mesh];
    if (shape.morph != kNone) {
        scene.morphs.push_back(dice_morph(scene.morphs[shape.morph_data], diced.position_stencils,
                                          diced.normal_stencils));
        shape.morph_data = uint32_t(scene.morphs.size() - 1);
    }
    skin::SkinRepairs reported;  // when the mesh was read
    shape.skin_mesh = skin_mesh_of(scene, use, mesh.positions.size(), mesh.normal_positions,
                                   &diced.position_stencils, reported);
}

// Vertices are moved in each frame: so each pose has what the shaders give them.
void number_outputs(Scene& scene, const Mesh& mesh) {
    for (const auto& group : mesh.own_groups)
        for (VertexAttribute& attribute : group->attributes) {
            if (!attribute.semantic.starts_with("vertex:")) continue;
            attribute.output = uint32_t(scene.vertex_outputs.size());
            scene.vertex_outputs.push_back(attribute.values.size());
            std::vector<float>().swap(attribute.values);
        }
}

}  // namespace

void put_on_shapes(Scene& scene, const DisplacedMesh& from, DicedMesh& made, const MeshUse& use,
                   WatchedEdges* watched, Diagnostics& diagnostics) {
    bind_diced_attributes(scene, scene, from, made);
    bool instanced = from.shapes.size() > 1 && made.triangles() > kBakedTriangles;
    bool once = !from.deforms && !from.each_frame;
    Mesh& mesh = made.mesh;
    Shape& first = scene.shapes[from.shapes[0]];
    auto work = std::make_unique<VertexWork>(mesh, std::move(made.groups),
                                             vertex_uses(scene, from.surfaces[0], mesh));
    if (once) {
        VertexState state(*work);
        work->run(scene, scene.start, state,
                  {.node = first.node,
                   .object_from_mesh = first.conversion,
                   .anchor = mesh.anchor,
                   .positions = mesh.positions,
                   .normals = mesh.normals});
        work->report(scene.description->meshes[mesh.definition], state, diagnostics);
        include_moved(mesh);
    } else {
        number_outputs(scene, mesh);
    }
    uint32_t index = uint32_t(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    for (uint32_t h : from.shapes) {
        Shape& shape = scene.shapes[h];
        shape.mesh = index;
        if (watched && from.deforms) deform_watched(scene, shape, use, *watched);
        if (!once)
            make_deforming(scene, shape, use, made);
        else if (instanced)
            shape.kind = raytrace::GeometryKind::Instanced;
        if (shape.kind == raytrace::GeometryKind::Instanced) {
            shape.positions.clear();
            shape.normals.clear();
        }
    }
    if (!once) {
        work->each_frame = from.each_frame;
        first.vertex_work = std::move(work);
    }
    for (uint32_t h : from.shapes)
        size_shape(scene, scene.meshes[index], scene.shapes[h], scene.start.shapes[h]);
}

}  // namespace kinora
