// runtime/scene/build/displacement/displaced_mesh.cpp: meshes whose shaders move vertices.
#include "runtime/scene/build/displacement/displaced_mesh.h"

#include <algorithm>
#include <map>

#include "runtime/scene/build/shapes/mesh.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/vertices/vertex_work.h"

namespace kinora {

namespace {

using Key = std::vector<uintptr_t>;  // all that makes results differ between shapes

struct Found {
    DisplacedMesh mesh;
    Key key;
    bool any = false;      // some shader moves its vertices
    bool by_node = false;  // and its result depends on the shape's node
};

Found examine(const SceneNodes& nodes, const SceneShapes& shapes, const SceneShaders& shaders,
              uint32_t index, std::span<const uint32_t> surfaces) {
    const Shape& shape = shapes.shapes[index];
    Found found;
    found.key = {shape.mesh};
    for (uint32_t s : surfaces) {
        const Surface& surface = shapes.surfaces[s];
        found.mesh.diced.push_back(surface.displacement.instance != kNone);
        found.mesh.moved.push_back(surface.displacement.instance != kNone ||
                                   surface.transformation.instance != kNone);
        found.key.push_back(uintptr_t(surface.st));
        for (const VertexUse* use : {&surface.transformation, &surface.displacement}) {
            found.key.push_back(use->instance);
            for (const VertexAttribute* a : use->varying) found.key.push_back(uintptr_t(a));
            if (use->instance == kNone) continue;
            const ShaderInstance& instance = *shaders.vertex_instances[use->instance];
            found.any = true;
            found.mesh.each_frame |= runs_each_frame(instance, nodes, shape.node);
            found.by_node |= depends_on_node(instance);
        }
    }
    found.mesh.deforms = shape.kind == raytrace::GeometryKind::Deforming;
    found.mesh.shapes = {index};
    found.mesh.surfaces = {{surfaces.begin(), surfaces.end()}};
    return found;
}

}  // namespace

bool DisplacedMesh::any_diced() const {
    return std::find(diced.begin(), diced.end(), 1) != diced.end();
}

std::vector<DisplacedMesh> find_displaced(const SceneNodes& nodes, const SceneShapes& shapes,
                                          const SceneShaders& shaders) {
    std::vector<std::vector<uint32_t>> surfaces(shapes.shapes.size());
    for (uint32_t s = 0; s < shapes.surfaces.size(); ++s)
        surfaces[shapes.surfaces[s].shape].push_back(s);
    std::vector<DisplacedMesh> result;
    std::map<Key, size_t> known;
    for (uint32_t h = 0; h < shapes.shapes.size(); ++h) {
        Found found = examine(nodes, shapes, shaders, h, surfaces[h]);
        if (!found.any) continue;
        const Shape& shape = shapes.shapes[h];
        bool own = found.mesh.deforms || found.mesh.each_frame || found.by_node;
        if (!own) {
            auto [entry, is_new] = known.try_emplace(found.key, result.size());
            DisplacedMesh* first = is_new ? nullptr : &result[entry->second];
            if (first && shapes.shapes[first->shapes[0]].conversion == shape.conversion) {
                first->shapes.push_back(h);
                first->surfaces.push_back(surfaces[h]);
                continue;
            }
        }
        uint32_t definition = shapes.meshes[shape.mesh].definition;
        found.mesh.base = build_mesh(nodes.description->meshes[definition], true);
        found.mesh.base.definition = definition;
        result.push_back(std::move(found.mesh));
    }
    return result;
}

}  // namespace kinora
