// runtime/scene/gltf/export/written_mesh.cpp: a mesh as floats hold it.
#include "runtime/scene/gltf/export/written_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace kinora {

namespace {

// Relative to the size of a mesh: how far from its positions the nearest floats may lie.
constexpr double kMostRounding = 1e-5;

bool fits_floats(const dvec3& p) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return std::abs(p.x) <= kMost && std::abs(p.y) <= kMost && std::abs(p.z) <= kMost;
}

// Leaves out triangles whose corners no float holds; returns how many these are.
size_t keep_floats(MeshDefinition& mesh) {
    size_t dropped = 0;
    for (PrimitiveGroup& group : mesh.groups) {
        std::vector<bool> kept(group.triangles.size(), true);  // per corner
        for (size_t c = 0; c < kept.size(); ++c)
            if (!fits_floats(mesh.positions[group.triangles[c]]))
                for (size_t k = 0; k < 3; ++k) kept[c / 3 * 3 + k] = false;
        auto keep = [&](std::vector<uint32_t>& corners) {
            size_t c = 0;
            std::erase_if(corners, [&](uint32_t) { return !kept[c++]; });
        };
        dropped += size_t(std::ranges::count(kept, false)) / 3;
        keep(group.triangles);
        for (VertexAttribute& a : group.attributes)
            if (a.corners.size() == kept.size()) keep(a.corners);
    }
    return dropped;
}

double rounding(const MeshDefinition& mesh) {
    double most = 0;
    for (const PrimitiveGroup& group : mesh.groups)
        for (uint32_t i : group.triangles) {
            const dvec3& p = mesh.positions[i];
            most = std::max(most, glm::length(p - dvec3(vec3(p))));
        }
    return most;
}

}  // namespace

WrittenMesh written_mesh(const MeshDefinition& definition, LossReport& losses) {
    WrittenMesh written{&definition, nullptr, {}, dvec3(0.0)};
    if (!std::ranges::all_of(definition.positions, fits_floats)) {
        auto own = std::make_unique<MeshDefinition>(definition);
        if (size_t dropped = keep_floats(*own))
            losses.lost(fmt::format("mesh '{}'", definition.id),
                        fmt::format("{} triangles further away than floats reach", dropped),
                        definition.where);
        written.own = std::move(own);
        written.definition = written.own.get();
    }
    written.built = build_mesh(*written.definition, true);
    const Mesh& built = written.built;
    double radius = 0.5 * glm::length(built.high - built.low);
    bool is_empty = !(built.low.x <= built.high.x);
    if (!is_empty && rounding(*written.definition) > kMostRounding * radius)
        written.origin = built.anchor;
    return written;
}

}  // namespace kinora
