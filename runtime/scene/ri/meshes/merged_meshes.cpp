// runtime/scene/ri/meshes/merged_meshes.cpp: meshes moved into one space and joined.
#include "runtime/scene/ri/meshes/merged_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace kinora::ri {
namespace {

constexpr size_t kSmallTriangles = 256;
constexpr size_t kMostCorners = 3'000'000;  // of a mesh that others join

bool has_color(const PrimitiveGroup& group) {
    return std::ranges::any_of(group.attributes,
                               [](const VertexAttribute& a) { return a.semantic == "Cs"; });
}

std::string variables_of(const PrimitiveGroup& group) {
    std::string made;
    for (const VertexAttribute& a : group.attributes)
        made += fmt::format("{} {} {};", a.semantic, a.set, a.stride);
    return made + (has_color(group) ? "" : "Cs 0 3;");
}

// The corner of a triangle that stands at `corner`: a mirror turns triangles round.
size_t turned(size_t corner, bool mirrored) {
    const size_t k = corner % 3;
    return mirrored && k ? corner - k + (3 - k) : corner;
}

void append_indices(std::vector<uint32_t>& to, const std::vector<uint32_t>& from, size_t first,
                    bool mirrored) {
    for (size_t c = 0; c < from.size(); ++c)
        to.push_back(uint32_t(from[turned(c, mirrored)] + first));
}

void append_normals(std::vector<float>& to, const std::vector<float>& from, const dmat3& matrix) {
    for (size_t i = 0; i + 2 < from.size(); i += 3) {
        const dvec3 n = matrix * dvec3(from[i], from[i + 1], from[i + 2]);
        const double length = glm::length(n);
        for (int k = 0; k < 3; ++k) to.push_back(length > 0 ? float(n[k] / length) : 0.0f);
    }
}

void append_attribute(VertexAttribute& to, const VertexAttribute& from, const dmat4& matrix,
                      bool mirrored) {
    append_indices(to.corners, from.corners, to.values.size() / to.stride, mirrored);
    if (from.semantic == "NORMAL")
        append_normals(to.values, from.values, glm::transpose(glm::inverse(dmat3(matrix))));
    else
        to.values.insert(to.values.end(), from.values.begin(), from.values.end());
}

void append_color(VertexAttribute& to, const dvec3& color, size_t corners) {
    to.corners.insert(to.corners.end(), corners, uint32_t(to.values.size() / 3));
    for (int k = 0; k < 3; ++k) to.values.push_back(float(color[k]));
}

// One without triangles that has these variables.
MeshDefinition empty_mesh(const MeshDefinition& like) {
    MeshDefinition made;
    made.name = like.name;
    made.where = like.where;
    made.double_sided = like.double_sided;
    PrimitiveGroup& group = made.groups.emplace_back();
    for (const VertexAttribute& a : like.groups[0].attributes) {
        VertexAttribute& variable = group.attributes.emplace_back();
        variable.semantic = a.semantic;
        variable.set = a.set;
        variable.stride = a.stride;
    }
    if (has_color(like.groups[0])) return made;
    VertexAttribute& color = group.attributes.emplace_back();
    color.semantic = "Cs";
    color.stride = 3;
    return made;
}

// Of a mesh that nothing joins any more: room that was doubled for more is a quarter of it.
void give_back_room(MeshDefinition& mesh) {
    mesh.positions.shrink_to_fit();
    PrimitiveGroup& group = mesh.groups[0];
    group.triangles.shrink_to_fit();
    for (VertexAttribute& a : group.attributes) a.values.shrink_to_fit(), a.corners.shrink_to_fit();
}

// The same for things of which none is more than some thousand times as large as another.
int class_of_size(const std::vector<dvec3>& positions) {
    constexpr double kOctaves = 12;
    dvec3 low(1e300), high(-1e300);
    for (const dvec3& p : positions) low = glm::min(low, p), high = glm::max(high, p);
    const double size = glm::length(high - low);
    return std::isfinite(size) && size > 0 ? int(std::floor(std::log2(size) / kOctaves)) : 0;
}

bool is_color(const std::string& semantic) {
    return semantic == "Cs" || semantic == "Os";
}

}  // namespace

bool MergedMeshes::takes(const MeshDefinition& mesh) {
    if (mesh.groups.size() != 1 || mesh.groups[0].triangles.size() > 3 * kSmallTriangles)
        return false;
    return std::ranges::all_of(mesh.groups[0].attributes, [](const VertexAttribute& a) {
        return a.stride > 0 && (a.stride < 3 || a.semantic == "NORMAL" || is_color(a.semantic));
    });
}

uint32_t MergedMeshes::add(std::vector<MeshDefinition>& meshes, const MeshDefinition& mesh,
                           const Look& look, const dmat4& matrix, const dvec3& color) {
    const PrimitiveGroup& group = mesh.groups[0];
    positions_.clear();
    for (const dvec3& p : mesh.positions) positions_.emplace_back(matrix * dvec4(p, 1));
    auto [entry, is_new] =
        open_.try_emplace({look, {variables_of(group), class_of_size(positions_)}}, kNone);
    uint32_t& open = entry->second;
    if (!is_new && meshes[open].groups[0].triangles.size() > kMostCorners) {
        give_back_room(meshes[open]);
        is_new = true;
    }
    if (is_new) {
        open = uint32_t(meshes.size());
        meshes.push_back(empty_mesh(mesh));
    }
    MeshDefinition& whole = meshes[open];
    PrimitiveGroup& all = whole.groups[0];
    const bool mirrored = glm::determinant(dmat3(matrix)) < 0;
    append_indices(all.triangles, group.triangles, whole.positions.size(), mirrored);
    whole.positions.insert(whole.positions.end(), positions_.begin(), positions_.end());
    for (size_t a = 0; a < group.attributes.size(); ++a)
        append_attribute(all.attributes[a], group.attributes[a], matrix, mirrored);
    if (!has_color(group)) append_color(all.attributes.back(), color, group.triangles.size());
    return is_new ? open : kNone;
}

}  // namespace kinora::ri
