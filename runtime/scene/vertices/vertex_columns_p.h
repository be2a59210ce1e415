// runtime/scene/vertices/vertex_columns_p.h: kernel inputs at the wedges of a mesh; for
// vertex_*.cpp only.
#pragma once

#include <glm/geometric.hpp>
#include <span>

#include "runtime/base/arena.h"
#include "runtime/scene/extent.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

// Between a mesh (minus its anchor) and the space of the node it is displaced in.
struct VertexSpace {
    VertexSpace(const SceneExtent& scene, const Pose& pose, uint32_t node,
                const dmat4& object_from_mesh, dvec3 anchor);

    dmat4 object{1.0};   // object_from_mesh for positions minus the anchor
    mat3 linear{1.0f};   // its linear part
    mat3 normals{1.0f};  // takes normals to object space, up to their length
    mat3 mesh_linear{1.0f}, mesh_normals{1.0f};  // and back
    dvec3 eye_object{0.0};
    // Width of a pixel at distance 1 of the eye, or everywhere (orthographic), object space.
    float pixel = 0;
    bool orthographic = false;
    // Orthographic: along the view, and what the depth of a point from the eye is by its position.
    vec3 axis{0.0f}, depth{0.0f};
    // I of a point that lies so from the eye; it is linear.
    vec3 seen_along(vec3 from_eye) const {
        return orthographic ? axis * glm::dot(depth, from_eye) : from_eye;
    }
};

// What the columns of one group are made of.
struct VertexSource {
    const DicedGroup& group;
    const struct Lists& corners;  // of each wedge
    std::span<const vec4> positions, normals;
    std::span<const vec3> faces;
    const VertexAttribute* st;
    std::span<const VertexAttribute* const> varying;
    std::span<const uint32_t> welds;  // of each position: seeds random()
};

// The look's columns for wedges [begin, end), by Column; kColP is always there. Partial derivatives
// are means over the triangles around a wedge; dPdu and dPdv are then laid into the plane of N, so
// that calculatenormal(P) of what is not displaced is N and facets do not show.
std::span<float*> fill_vertex_columns(const ShaderInstance& look, const VertexSource& source,
                                      const Pose& pose, const VertexSpace& space, size_t begin,
                                      size_t end, Arena& arena);

}  // namespace kinora
