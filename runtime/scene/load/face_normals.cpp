// runtime/scene/load/face_normals.cpp: what stands for normals that are no directions.
#include "runtime/scene/load/face_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

bool is_direction(const float* v) {
    dvec3 n(v[0], v[1], v[2]);
    double square = glm::dot(n, n);
    return square > 0 && std::isfinite(square);
}

double largest(const dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Edges are scaled first: their product then neither overflows nor vanishes.
dvec3 face_normal(const MeshDefinition& mesh, const uint32_t* triangle) {
    dvec3 a = mesh.positions[triangle[0]];
    dvec3 u = mesh.positions[triangle[1]] - a, v = mesh.positions[triangle[2]] - a;
    double size = std::max(largest(u), largest(v));
    dvec3 n = size > 0 ? glm::cross(u / size, v / size) : dvec3(0.0);
    double length = glm::length(n);
    return length > 0 && std::isfinite(length) ? n / length : dvec3(0, 0, 1);
}

void mend(const MeshDefinition& mesh, const PrimitiveGroup& group, VertexAttribute& normals) {
    std::vector<bool> sound(normals.values.size() / normals.stride);
    bool all = true;
    for (size_t e = 0; e < sound.size(); ++e)
        all &= sound[e] = is_direction(&normals.values[e * normals.stride]);
    for (size_t c = 0; !all && c < normals.corners.size(); ++c) {
        if (sound[normals.corners[c]]) continue;
        dvec3 n = face_normal(mesh, &group.triangles[c / 3 * 3]);
        size_t first = normals.values.size();
        normals.values.resize(first + normals.stride, 0.0f);
        for (int k = 0; k < 3; ++k) normals.values[first + size_t(k)] = float(n[k]);
        bool same = c % 3 > 0 && first / normals.stride > sound.size() &&
                    std::equal(normals.values.begin() + ptrdiff_t(first), normals.values.end(),
                               normals.values.begin() + ptrdiff_t(first - normals.stride));
        if (same) normals.values.resize(first);  // of the corner before it
        normals.corners[c] = uint32_t(normals.values.size() / normals.stride - 1);
    }
}

}  // namespace

void give_faces_their_normals(SceneDescription& description) {
    std::vector<bool> worn(description.meshes.size(), false);  // else it is a target
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            if (use.mesh < worn.size()) worn[use.mesh] = true;
    for (size_t m = 0; m < worn.size(); ++m)
        for (PrimitiveGroup& group : description.meshes[m].groups)
            for (VertexAttribute& a : group.attributes)
                if (worn[m] && a.semantic == "NORMAL" && a.stride >= 3)
                    mend(description.meshes[m], group, a);
}

}  // namespace kinora
