// runtime/scene/build/rows.cpp: the ray tracer's rows.
#include "runtime/scene/build/rows.h"

#include <map>

#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

void set_rows(SceneShapes& scene, const SceneShaders& shaders) {
    scene.rows.resize(scene.surfaces.size());
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> numbers;  // of instanced mesh groups
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        const ShaderInstance& instance = *shaders.shader_instances[surface.look];
        const Shape& shape = scene.shapes[surface.shape];
        const Mesh& mesh = scene.meshes[shape.mesh];
        bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
        raytrace::Geometry& row = scene.rows[s];
        row.id = uint32_t(s);
        row.body = surface.shape;
        row.kind = shape.kind;
        row.seen_by = surface.seen_by;
        row.opaque = instance.opaque();
        const MeshGroup& group = mesh.groups[surface.group];
        row.hide_backfaces =
            !mesh.double_sided || instance.hide_backfaces || group.definition->one_sided;
        const bool deforms = shape.kind == raytrace::GeometryKind::Deforming;
        if (deforms && !shape.vertex_work) row.built_from = mesh.positions;
        row.triangles = group.triangles;
        if (instanced)
            row.shape = numbers.try_emplace({shape.mesh, surface.group}, uint32_t(numbers.size()))
                            .first->second;
    }
}

}  // namespace kinora
