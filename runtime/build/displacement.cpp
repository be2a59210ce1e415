// runtime/build/displacement.cpp: meshes whose shaders move vertices: found, diced, and moved, once
// or ready to be at each frame.
#include <algorithm>
#include <array>
#include <map>

#include "runtime/base/stats.h"
#include "runtime/build/displacement_p.h"
#include "runtime/build/mesh.h"
#include "runtime/vertices/deform.h"
#include "runtime/vertices/vertex_work.h"

namespace kinora {

namespace {

const VertexAttribute* find_own(const PrimitiveGroup& group, std::string_view semantic) {
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == semantic) return &a;
    return nullptr;
}

}  // namespace

void SceneBuilder::displace() {
    std::vector<Displaced> all = find_displaced();
    if (all.empty()) return;
    Stopwatch watch;
    Scene& scene = *scene_;
    bool any = std::any_of(all.begin(), all.end(), [](const auto& d) { return d.any_diced(); });
    if (any) find_views(all);
    dice(all);
    watch_edges(all);
    if (any && refine_views(all)) {
        dice(all);
        watch_edges(all);
    }
    report_dice_limit();
    for (Displaced& displaced : all) wear(displaced);
    bake_static(scene);
    deform_now();
    scene.dice.ms = watch.ms();
}

std::vector<SceneBuilder::Displaced> SceneBuilder::find_displaced() {
    Scene& scene = *scene_;
    std::vector<std::vector<uint32_t>> surfaces(scene.shapes.size());
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
        surfaces[scene.surfaces[s].shape].push_back(s);
    std::vector<Displaced> result;
    std::map<std::vector<uintptr_t>, size_t> known;  // all that makes results differ
    for (uint32_t h = 0; h < scene.shapes.size(); ++h) {
        const Shape& shape = scene.shapes[h];
        Displaced found;
        bool any = false, by_node = false;
        std::vector<uintptr_t> key = {shape.mesh};
        for (uint32_t s : surfaces[h]) {
            const Surface& surface = scene.surfaces[s];
            found.diced.push_back(surface.displacement.look != kNone);
            key.push_back(uintptr_t(surface.st));
            for (const VertexUse* use : {&surface.transformation, &surface.displacement}) {
                key.push_back(use->look);
                for (const VertexAttribute* a : use->varying) key.push_back(uintptr_t(a));
                if (use->look == kNone) continue;
                const ShaderInstance& look = *scene.vertex_looks[use->look];
                any = true;
                found.each_frame |= runs_each_frame(look, scene, shape.node);
                by_node |= depends_on_node(look);
            }
        }
        if (!any) continue;
        found.deforms = shape.kind == raytrace::GeometryKind::Deforming;
        bool own = found.deforms || found.each_frame || by_node;
        if (!own) {
            auto [place, is_new] = known.try_emplace(key, result.size());
            if (!is_new) {
                Displaced& first = result[place->second];
                if (scene.shapes[first.shapes[0]].conversion == shape.conversion) {
                    first.shapes.push_back(h);
                    first.surfaces.push_back(surfaces[h]);
                    continue;
                }
            }
        }
        found.shapes = {h};
        found.surfaces = {surfaces[h]};
        found.base = build_mesh(description_.meshes[scene.meshes[shape.mesh].definition], true);
        found.base.definition = scene.meshes[shape.mesh].definition;
        result.push_back(std::move(found));
    }
    return result;
}

namespace {

// Where an attribute of the mesh as read is in its diced group. What was null is what dicing made:
// texture coordinates, the rest position or an output of the displacement.
const VertexAttribute* diced_attribute(const VertexAttribute* from, std::string_view semantic,
                                       const PrimitiveGroup& old, const PrimitiveGroup& made) {
    if (!from) return find_own(made, semantic);
    size_t index = 0;
    for (const VertexAttribute& a : old.attributes) {
        if (&a == from) return &made.attributes[index];
        index += a.semantic != "NORMAL";
    }
    return find_own(made, semantic);
}

// Attributes that the looks want beyond those of the file.
void add_attributes(std::span<const VaryingParam> varying, const Mesh& mesh,
                    const DicedGroup& group, PrimitiveGroup& made) {
    for (const VaryingParam& param : varying) {
        bool wanted = param.semantic == "Pref" || param.semantic.starts_with("vertex:");
        if (!wanted || find_own(made, param.semantic)) continue;
        VertexAttribute a;
        a.semantic = param.semantic;
        a.stride = param.components;
        a.corners = group.corners;
        a.values.resize(group.position.size() * a.stride);
        if (param.semantic == "Pref")
            for (size_t w = 0; w < group.position.size(); ++w)
                for (int k = 0; k < 3; ++k)
                    a.values[3 * w + size_t(k)] =
                        mesh.positions[group.position[w]][k] + float(mesh.anchor[k]);
        made.attributes.push_back(std::move(a));
    }
}

void find_attributes(std::span<const VaryingParam> params, const PrimitiveGroup& old,
                     const PrimitiveGroup& made, std::vector<const VertexAttribute*>& varying) {
    for (size_t k = 0; k < varying.size(); ++k)
        varying[k] = diced_attribute(varying[k], params[k].semantic, old, made);
}

// Vertex looks of the surface, transformation first.
std::array<const VertexUse*, VertexWork::kStages> vertex_stages(const Surface& surface) {
    return {&surface.transformation, &surface.displacement};
}

using SurfaceLists = std::span<const std::vector<uint32_t>>;  // by shape, by group

void add_wanted_attributes(const Scene& scene, SurfaceLists surfaces_of_shapes, DicedMesh& made) {
    for (const auto& surfaces : surfaces_of_shapes)
        for (size_t g = 0; g < surfaces.size(); ++g) {
            const Surface& surface = scene.surfaces[surfaces[g]];
            PrimitiveGroup& group = *made.mesh.own_groups[g];
            add_attributes(scene.looks[surface.look]->varying, made.mesh, made.groups[g], group);
            for (const VertexUse* use : vertex_stages(surface))
                if (use->look != kNone)
                    add_attributes(scene.vertex_looks[use->look]->varying, made.mesh,
                                   made.groups[g], group);
        }
}

// Vertex inputs of the surfaces are those of the diced mesh from now on.
void take_diced_attributes(Scene& scene, SurfaceLists surfaces_of_shapes, const Mesh& base,
                           const Mesh& mesh) {
    for (const auto& surfaces : surfaces_of_shapes)
        for (size_t g = 0; g < surfaces.size(); ++g) {
            Surface& surface = scene.surfaces[surfaces[g]];
            const PrimitiveGroup &old = *base.groups[g].definition, &group = *mesh.own_groups[g];
            surface.st = diced_attribute(surface.st, "TEXCOORD", old, group);
            find_attributes(scene.looks[surface.look]->varying, old, group, surface.varying);
            for (VertexUse* use : {&surface.transformation, &surface.displacement})
                if (use->look != kNone)
                    find_attributes(scene.vertex_looks[use->look]->varying, old, group,
                                    use->varying);
        }
}

// What moves the vertices of each group.
std::vector<VertexWork::Use> vertex_uses(const Scene& scene, std::span<const uint32_t> surfaces,
                                         const Mesh& mesh) {
    std::vector<VertexWork::Use> uses;
    for (size_t g = 0; g < surfaces.size(); ++g) {
        const Surface& surface = scene.surfaces[surfaces[g]];
        VertexWork::Use& use = uses.emplace_back();
        use.st = surface.st;
        use.attributes = mesh.own_groups[g].get();
        auto stages = vertex_stages(surface);
        for (size_t s = 0; s < stages.size(); ++s) {
            if (stages[s]->look == kNone) continue;
            use.looks[s] = scene.vertex_looks[stages[s]->look].get();
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

}  // namespace

// Puts the diced mesh on its shapes and moves its vertices, or readies them to be moved.
void SceneBuilder::wear(Displaced& from) {
    Scene& scene = *scene_;
    DicedMesh& made = *from.made;
    Mesh& mesh = made.mesh;
    uint32_t index = uint32_t(scene.meshes.size());
    add_wanted_attributes(scene, from.surfaces, made);
    take_diced_attributes(scene, from.surfaces, from.base, mesh);
    std::vector<VertexWork::Use> uses = vertex_uses(scene, from.surfaces[0], mesh);
    bool instanced = from.shapes.size() > 1 && made.triangles() > kBakedTriangles;
    bool once = !from.deforms && !from.each_frame;
    Shape& first = scene.shapes[from.shapes[0]];
    auto work = std::make_unique<VertexWork>(mesh, std::move(made.groups), std::move(uses));
    if (once) {
        work->run(scene, first.node, first.conversion, mesh.anchor, mesh.positions, mesh.normals);
        work->report(description_.meshes[mesh.definition].id, diagnostics_);
        include_moved(mesh);
    }
    scene.meshes.push_back(std::move(mesh));
    for (uint32_t h : from.shapes) {
        Shape& shape = scene.shapes[h];
        shape.mesh = index;
        if (!once)
            make_deforming(shape, *uses_[from.surfaces[0][0]], made, from.watched);
        else if (instanced)
            shape.kind = raytrace::GeometryKind::Instanced;
        bool own = shape.kind != raytrace::GeometryKind::Instanced;
        shape.positions.assign(own ? scene.meshes[index].positions.size() : 0, vec4(0.0f));
        shape.normals.assign(own ? scene.meshes[index].normals.size() : 0, vec4(0.0f));
    }
    if (once) return;
    work->each_frame = from.each_frame;
    first.vertex_work = std::move(work);
}

void SceneBuilder::make_deforming(Shape& shape, const MeshUse& use, const DicedMesh& diced,
                                  WatchedEdges* watched) {
    Scene& scene = *scene_;
    bool was_deforming = shape.kind == raytrace::GeometryKind::Deforming;
    shape.kind = raytrace::GeometryKind::Deforming;
    const Mesh& mesh = scene.meshes[shape.mesh];
    skin::SkinRepairs told;  // by the mesh as read
    if (watched && was_deforming) {
        const std::vector<Stencil>& vertices = watched->vertices;
        if (shape.morph != kNone)
            watched->morph = dice_morph(scene.morphs[shape.morph_data], vertices, {});
        watched->skin = skin_mesh_of(use, vertices.size(), {}, &vertices, told);
        watched->morphed.resize(vertices.size());
        watched->posed.resize(vertices.size());
    }
    if (shape.morph != kNone) {
        scene.morphs.push_back(dice_morph(scene.morphs[shape.morph_data], diced.position_stencils,
                                          diced.normal_stencils));
        shape.morph_data = uint32_t(scene.morphs.size() - 1);
        shape.morphed_positions.resize(mesh.positions.size());
        shape.morphed_normals.resize(mesh.normals.size());
    }
    shape.skin_mesh = skin_mesh_of(use, mesh.positions.size(), mesh.normal_positions,
                                   &diced.position_stencils, told);
    if (shape.skin == kNone) {
        shape.palette.resize(2);  // joint -1, and the node's matrix
        shape.displaced_positions.resize(mesh.positions.size());
        shape.displaced_normals.resize(mesh.normals.size());
    }
}

}  // namespace kinora
