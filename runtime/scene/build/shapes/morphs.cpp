// runtime/scene/build/shapes/morphs.cpp: morph targets of a shape.
#include "runtime/scene/build/shapes/morphs.h"

#include <algorithm>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/description/picture_rules.h"

namespace kinora {

namespace {

// A target's normals in the order of the base's entries: the file's, where target and base have the
// same corners; else none (the base's stay).
std::vector<vec3> target_normals(const MeshDefinition& target, const Mesh& base) {
    if (target.groups.size() != base.groups.size()) return {};
    std::vector<vec3> result(base.normals.size(), vec3(0.0f));
    for (size_t g = 0; g < target.groups.size(); ++g) {
        const std::vector<uint32_t>& entries = base.groups[g].normal_corners;
        if (base.groups[g].flat()) continue;
        const VertexAttribute* normals = normals_of(target.groups[g]);
        if (!normals || normals->corners.size() != entries.size()) return {};
        for (size_t c = 0; c < entries.size(); ++c) {
            const float* v = &normals->values[size_t(normals->corners[c]) * normals->stride];
            result[entries[c]] = vec3(v[0], v[1], v[2]);
        }
    }
    return result;
}

// One target of a NORMALIZED morph among others: what it differs from the base by.
void subtract_base(const MeshDefinition& base, const Mesh& mesh, const MeshDefinition& target,
                   std::vector<vec3>& positions, std::vector<vec3>& normals) {
    for (size_t i = 0; i < std::min(positions.size(), base.positions.size()); ++i)
        positions[i] = vec3(target.positions[i] - base.positions[i]);
    for (size_t i = 0; i < normals.size(); ++i) normals[i] -= vec3(mesh.normals[i]);
}

// The targets of a morph behind those of the morphs whose results it changes.
skin::Morph build_morph(const SceneDescription& description, uint32_t morph, const Mesh& mesh,
                        uint32_t* mismatched) {
    std::vector<vec3> base(mesh.positions.begin(), mesh.positions.end());
    std::vector<vec3> base_normals(mesh.normals.begin(), mesh.normals.end());
    std::vector<std::vector<vec3>> positions, normals;
    std::vector<uint32_t> chain = morph_chain(description, morph);
    bool relative = chain.size() > 1 || description.morphs[morph].relative;
    for (uint32_t m : chain)
        for (uint32_t t : description.morphs[m].targets) {
            const MeshDefinition& target = description.meshes[t];
            auto& p = positions.emplace_back();
            for (const dvec3& x : target.positions)
                p.push_back(vec3(x - (relative ? dvec3(0.0) : mesh.anchor)));
            normals.push_back(target_normals(target, mesh));
            if (relative && !description.morphs[m].relative)
                subtract_base(description.meshes[mesh.definition], mesh, target, p, normals.back());
        }
    std::vector<skin::MorphTargetSource> sources;
    for (size_t t = 0; t < positions.size(); ++t) sources.push_back({positions[t], normals[t]});
    return skin::build_morph(relative ? skin::MorphMethod::Relative : skin::MorphMethod::Normalized,
                             base, base_normals, sources, mismatched);
}

}  // namespace

void add_morph(const SceneDescription& description, SceneShapes& scene, uint32_t morph,
               Shape& shape, Diagnostics& diagnostics) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    scene.morphs.resize(description.morphs.size());
    shape.morph_data = morph;
    if (!scene.morphs[morph].base_positions.empty()) return;
    const MorphDefinition& definition = description.morphs[morph];
    uint32_t mismatched = 0;
    scene.morphs[morph] = build_morph(description, morph, mesh, &mismatched);
    if (mismatched)
        diagnostics.report(Code::MORPH_VERTEX_COUNT, definition.where, definition.id, mismatched);
}

}  // namespace kinora
