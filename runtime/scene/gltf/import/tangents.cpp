// runtime/scene/gltf/import/tangents.cpp: TANGENT as numbers that stay right when the surface is
// moved.
#include "runtime/scene/gltf/import/tangents.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/scene/description/picture_rules.h"

namespace kinora {

namespace {

dvec3 entry(const VertexAttribute& attribute, size_t corner) {
    const float* v = &attribute.values[size_t(attribute.corners[corner]) * attribute.stride];
    return dvec3(double(v[0]), double(v[1]), attribute.stride > 2 ? double(v[2]) : 0.0);
}

// dPdu and dPdv of a triangle whose corners have these u and v; false where they have no area.
bool solve_affine(const dvec3 (&P)[3], const dvec3 (&uv)[3], dvec3& dPdu, dvec3& dPdv) {
    dvec3 a = uv[1] - uv[0], b = uv[2] - uv[0];
    double turn = a.x * b.y - a.y * b.x;
    if (turn == 0.0) return false;
    dPdu = ((P[1] - P[0]) * b.y - (P[2] - P[0]) * a.y) / turn;
    dPdv = ((P[2] - P[0]) * a.x - (P[1] - P[0]) * b.x) / turn;
    return true;
}

}  // namespace

// A tangent T is u dPdu + v dPdv + n N, with dPdu and dPdv of the triangle by its lowest set of
// texture coordinates (what u and v are to a shader). u and v hold whatever moves or mirrors the
// triangle, and n falls out where the shader makes T normal to N. `tangent_flip` is -1 where the
// file's bitangent (N x T) w points away from growing v.
void add_tangents(const std::vector<dvec3>& positions, uint32_t first_vertex,
                  std::span<const float> tangents, PrimitiveGroup& group) {
    const VertexAttribute* uv = find_attribute(group, "TEXCOORD");
    const VertexAttribute* normals = find_attribute(group, "NORMAL");
    if (!uv || !normals) return;
    constexpr const char* kNames[] = {"tangent_u", "tangent_v", "tangent_flip"};
    VertexAttribute columns[3];
    for (size_t k = 0; k < 3; ++k) columns[k] = {kNames[k], 0, 1, {}, {}};
    for (size_t c = 0; c < group.triangles.size(); ++c) {
        size_t first = c - c % 3;
        const dvec3 P[3] = {positions[group.triangles[first]],
                            positions[group.triangles[first + 1]],
                            positions[group.triangles[first + 2]]};
        const dvec3 at[3] = {entry(*uv, first), entry(*uv, first + 1), entry(*uv, first + 2)};
        dvec3 solved(0.0), dPdu, dPdv, N = entry(*normals, c);
        const float* t = &tangents[4 * size_t(group.triangles[c] - first_vertex)];
        dvec3 T{double(t[0]), double(t[1]), double(t[2])};
        double flip = 1;
        if (solve_affine(P, at, dPdu, dPdv)) {
            dmat3 frame(dPdu, dPdv, N);
            if (std::abs(glm::determinant(frame)) > 1e-12 * glm::length(dPdu) * glm::length(dPdv))
                solved = glm::inverse(frame) * T;
            if (double(t[3]) * glm::dot(glm::cross(N, T), dPdv) < 0) flip = -1;
        }
        const double numbers[3] = {solved.x, solved.y, flip};
        for (size_t k = 0; k < 3; ++k) {
            columns[k].values.push_back(std::isfinite(numbers[k]) ? float(numbers[k]) : 0.0f);
            columns[k].corners.push_back(uint32_t(c));
        }
    }
    for (VertexAttribute& column : columns) group.attributes.push_back(std::move(column));
}

}  // namespace kinora
