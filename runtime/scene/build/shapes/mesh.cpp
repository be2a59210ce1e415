// runtime/scene/build/shapes/mesh.cpp: anchors, and normals with a position of their own.
#include "runtime/scene/build/shapes/mesh.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/scene/description/pair_numbers.h"
#include "runtime/scene/description/picture_rules.h"

namespace kinora {

namespace {

vec4 entry(const VertexAttribute& a, uint32_t index) {
    const float* v = &a.values[size_t(index) * a.stride];
    return {v[0], v[1], v[2], 0.0f};
}

// As baking leaves them: an instanced mesh is shaded like a still one.
vec4 unit_entry(const VertexAttribute& a, uint32_t index) {
    dvec3 n(entry(a, index));
    double length = glm::length(n);
    return vec4(length > 0 ? vec3(n / length) : vec3(0.0f), 0.0f);
}

void add_given_normals(const PrimitiveGroup& group, const VertexAttribute& normals, bool deforms,
                       Mesh& mesh, MeshGroup& out) {
    out.normal_corners.resize(group.triangles.size());
    uint32_t first = uint32_t(mesh.normals.size());
    if (!deforms) {
        mesh.normals.reserve(first + normals.values.size() / normals.stride);
        for (size_t i = 0; i < normals.values.size() / normals.stride; ++i)
            mesh.normals.push_back(unit_entry(normals, uint32_t(i)));
        for (size_t c = 0; c < normals.corners.size(); ++c)
            out.normal_corners[c] = first + normals.corners[c];
        mesh.normal_positions.resize(mesh.normals.size(), 0);
        return;
    }
    PairNumbers numbers(group.triangles.size());
    for (size_t c = 0; c < group.triangles.size(); ++c) {
        uint32_t next = uint32_t(mesh.normals.size());
        uint32_t number = numbers.number(group.triangles[c], normals.corners[c], next);
        if (number == next) {
            mesh.normals.push_back(entry(normals, normals.corners[c]));
            mesh.normal_positions.push_back(group.triangles[c]);
        }
        out.normal_corners[c] = number;
    }
}

// Of the triangles: what none of them has may lie anywhere. Nothing: low > high.
void set_bounds_of_triangles(const MeshDefinition& definition, Mesh& mesh) {
    mesh.low = dvec3(1e300);
    mesh.high = dvec3(-1e300);
    for (const PrimitiveGroup& group : definition.groups)
        for (uint32_t i : group.triangles) {
            const dvec3& p = definition.positions[i];
            if (!std::isfinite(p.x + p.y + p.z)) continue;
            mesh.low = glm::min(mesh.low, p);
            mesh.high = glm::max(mesh.high, p);
        }
}

}  // namespace

Mesh build_mesh(const MeshDefinition& definition, bool deforms) {
    Mesh mesh;
    mesh.double_sided = definition.double_sided;
    set_bounds_of_triangles(definition, mesh);
    if (mesh.low.x <= mesh.high.x) mesh.anchor = 0.5 * (mesh.low + mesh.high);
    mesh.positions.reserve(definition.positions.size());
    for (const dvec3& p : definition.positions)
        mesh.positions.push_back(vec4(vec3(p - mesh.anchor), 0.0f));
    for (const PrimitiveGroup& group : definition.groups) {
        MeshGroup& out = mesh.groups.emplace_back();
        out.symbol = group.symbol;
        out.triangles = group.triangles;
        out.definition = &group;
        if (const VertexAttribute* normals = normals_of(group))
            add_given_normals(group, *normals, deforms, mesh, out);
    }
    return mesh;
}

}  // namespace kinora
