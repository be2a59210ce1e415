// runtime/scene/build/displacement/diced_attributes.cpp: vertex inputs of surfaces whose mesh was
// diced.
#include "runtime/scene/build/displacement/diced_attributes.h"

#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

const VertexAttribute* find_own(const PrimitiveGroup& group, std::string_view semantic) {
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == semantic) return &a;
    return nullptr;
}

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

std::vector<float> rest_positions(const Mesh& mesh, const DicedGroup& group) {
    std::vector<float> values(3 * group.position.size());
    for (size_t w = 0; w < group.position.size(); ++w)
        for (int k = 0; k < 3; ++k)
            values[3 * w + size_t(k)] =
                mesh.positions[group.position[w]][k] + float(mesh.anchor[k]);
    return values;
}

void add_attributes(std::span<const VaryingParam> varying, const Mesh& mesh,
                    const DicedGroup& group, PrimitiveGroup& made) {
    for (const VaryingParam& param : varying) {
        bool rest = param.semantic == "Pref";
        bool wanted = rest || param.semantic.starts_with("vertex:");
        if (!wanted || find_own(made, param.semantic)) continue;
        VertexAttribute a;
        a.semantic = param.semantic;
        a.stride = param.components;
        a.corners = group.corners;
        if (rest)
            a.values = rest_positions(mesh, group);
        else
            a.values.resize(group.position.size() * a.stride);
        made.attributes.push_back(std::move(a));
    }
}

void rebind(std::span<const VaryingParam> params, const PrimitiveGroup& old,
            const PrimitiveGroup& made, std::vector<const VertexAttribute*>& varying) {
    for (size_t k = 0; k < varying.size(); ++k)
        varying[k] = diced_attribute(varying[k], params[k].semantic, old, made);
}

// Calls f(surface, group) for each surface of each shape of the mesh.
template <class F>
void for_each_surface(SceneShapes& scene, const DisplacedMesh& mesh, F&& f) {
    for (const auto& surfaces : mesh.surfaces)
        for (size_t g = 0; g < surfaces.size(); ++g) f(scene.surfaces[surfaces[g]], g);
}

}  // namespace

void bind_diced_attributes(SceneShapes& shapes, const SceneShaders& shaders,
                           const DisplacedMesh& mesh, DicedMesh& made) {
    // All are added before any is pointed at.
    for_each_surface(shapes, mesh, [&](Surface& surface, size_t g) {
        PrimitiveGroup& group = *made.mesh.own_groups[g];
        add_attributes(shaders.shader_instances[surface.look]->varying, made.mesh, made.groups[g],
                       group);
        for (const VertexUse* use : {&surface.transformation, &surface.displacement})
            if (use->instance != kNone)
                add_attributes(shaders.vertex_instances[use->instance]->varying, made.mesh,
                               made.groups[g], group);
    });
    for_each_surface(shapes, mesh, [&](Surface& surface, size_t g) {
        const PrimitiveGroup& old = *mesh.base.groups[g].definition;
        const PrimitiveGroup& group = *made.mesh.own_groups[g];
        surface.st = diced_attribute(surface.st, "TEXCOORD", old, group);
        surface.uv = diced_attribute(surface.uv, kSurfaceParameters, old, group);
        rebind(shaders.shader_instances[surface.look]->varying, old, group, surface.varying);
        for (VertexUse* use : {&surface.transformation, &surface.displacement})
            if (use->instance != kNone)
                rebind(shaders.vertex_instances[use->instance]->varying, old, group, use->varying);
    });
}

}  // namespace kinora
