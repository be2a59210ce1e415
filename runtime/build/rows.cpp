// runtime/build/rows.cpp: the ray tracer's rows.
#include "runtime/build/rows.h"

#include <map>

#include "runtime/shading/shader_instance.h"

namespace kinora {

void set_rows(Scene& scene) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> numbers;  // of instanced mesh groups
    for (size_t s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        const ShaderInstance& instance = *scene.shader_instances[surface.look];
        Shape& shape = scene.shapes[surface.shape];
        const Mesh& mesh = scene.meshes[shape.mesh];
        bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
        shape.rest_positions = instanced ? mesh.positions : shape.positions;
        shape.rest_normals = instanced ? mesh.normals : shape.normals;
        raytrace::Geometry& row = scene.geometry[s];
        row.id = uint32_t(s);
        row.body = surface.shape;
        row.kind = shape.kind;
        row.opaque = instance.opaque();
        row.hide_backfaces = !mesh.double_sided || instance.hide_backfaces;
        row.positions = shape.rest_positions;
        const bool deforms = shape.kind == raytrace::GeometryKind::Deforming;
        if (deforms && !shape.vertex_work) row.built_from = mesh.positions;
        row.triangles = mesh.groups[surface.group].triangles;
        if (instanced)
            row.shape = numbers.try_emplace({shape.mesh, surface.group}, uint32_t(numbers.size()))
                            .first->second;
    }
    scene.first_frame = true;
}

}  // namespace kinora
