// runtime/scene/load/twin_faces.cpp: faces that lie on others and are turned the other way.
#include "runtime/scene/load/twin_faces.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "runtime/scene/load/weld.h"

namespace kinora {

namespace {

// A triangle with its corners from the lowest on.
struct Face {
    std::array<uint32_t, 3> corners;
    uint32_t group = 0, triangle = 0;

    std::array<uint32_t, 3> turned() const { return {corners[0], corners[2], corners[1]}; }
    bool has_area() const {
        return corners[0] != corners[1] && corners[1] != corners[2] && corners[0] != corners[2];
    }
    bool operator<(const Face& o) const { return corners < o.corners; }
};

std::vector<Face> faces_of(const MeshDefinition& mesh) {
    const std::vector<uint32_t> weld = welded(mesh.positions);
    std::vector<Face> faces;
    for (uint32_t g = 0; g < mesh.groups.size(); ++g) {
        const std::vector<uint32_t>& t = mesh.groups[g].triangles;
        for (size_t i = 0; i + 2 < t.size(); i += 3) {
            Face face{{weld[t[i]], weld[t[i + 1]], weld[t[i + 2]]}, g, uint32_t(i / 3)};
            std::rotate(face.corners.begin(),
                        std::min_element(face.corners.begin(), face.corners.end()),
                        face.corners.end());
            if (face.has_area()) faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

// Of each group's triangles: those that one of another material lies on, the other way round.
std::vector<std::vector<bool>> find_twins(const MeshDefinition& mesh) {
    std::vector<std::vector<bool>> twins;
    for (const PrimitiveGroup& group : mesh.groups) twins.emplace_back(group.triangles.size() / 3);
    const std::vector<Face> faces = faces_of(mesh);
    for (const Face& face : faces) {
        auto [first, last] = std::equal_range(faces.begin(), faces.end(), Face{face.turned()});
        twins[face.group][face.triangle] = std::any_of(first, last, [&](const Face& other) {
            return mesh.groups[other.group].symbol != mesh.groups[face.group].symbol;
        });
    }
    return twins;
}

// The triangles for which `kept` is `wanted`.
std::vector<uint32_t> triangles_where(const std::vector<uint32_t>& corners,
                                      const std::vector<bool>& kept, bool wanted) {
    std::vector<uint32_t> result;
    for (size_t c = 0; c < corners.size(); ++c)
        if (kept[c / 3] == wanted) result.push_back(corners[c]);
    return result;
}

PrimitiveGroup part_of(const PrimitiveGroup& group, const std::vector<bool>& twins, bool wanted) {
    PrimitiveGroup part = group;
    part.triangles = triangles_where(group.triangles, twins, wanted);
    for (size_t a = 0; a < part.attributes.size(); ++a)
        part.attributes[a].corners = triangles_where(group.attributes[a].corners, twins, wanted);
    return part;
}

void part_mesh(MeshDefinition& mesh) {
    const std::vector<std::vector<bool>> twins = find_twins(mesh);
    for (size_t g = 0, count = mesh.groups.size(); g < count; ++g) {
        const auto twin_count = std::count(twins[g].begin(), twins[g].end(), true);
        if (twin_count == 0) continue;
        if (size_t(twin_count) < twins[g].size()) {
            mesh.groups.push_back(part_of(mesh.groups[g], twins[g], false));
            mesh.groups[g] = part_of(mesh.groups[g], twins[g], true);
        }
        mesh.groups[g].one_sided = true;
    }
}

bool may_have_twins(const MeshDefinition& mesh) {
    size_t triangles = 0;
    std::set<std::string_view> symbols;
    for (const PrimitiveGroup& group : mesh.groups) {
        triangles += group.triangles.size() / 3;
        if (!group.triangles.empty()) symbols.insert(group.symbol);
    }
    return symbols.size() > 1 && triangles <= kMostTwins;
}

}  // namespace

void part_twin_faces(SceneDescription& description) {
    std::vector<bool> of_morphs(description.meshes.size(), false);
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            if (use.mesh != kNone && use.morph != kNone) of_morphs[use.mesh] = true;
    for (size_t m = 0; m < description.meshes.size(); ++m)
        if (!of_morphs[m] && may_have_twins(description.meshes[m]))
            part_mesh(description.meshes[m]);
}

}  // namespace kinora
