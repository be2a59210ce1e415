// runtime/build/shapes/morphs.cpp: morph targets of a shape.
#include "runtime/build/shapes/morphs.h"

#include "runtime/build/shapes/mesh.h"
#include "runtime/description/findings.h"

namespace kinora {

namespace {

const VertexAttribute* normals_of(const PrimitiveGroup& group) {
    const VertexAttribute* found = nullptr;
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == "NORMAL" && a.stride >= 3) found = &a;
    return found;
}

// Smooth ones, of a base without any and a target of as many positions.
std::vector<vec3> smooth_normals(const MeshDefinition& target, const Mesh& base,
                                 const MeshDefinition& base_definition, bool relative) {
    std::vector<vec3> result(base.normals.size(), vec3(0.0f));
    MeshDefinition moved = base_definition;
    for (size_t i = 0; i < moved.positions.size(); ++i)
        moved.positions[i] = target.positions[i] + (relative ? moved.positions[i] : dvec3(0.0));
    Mesh mesh = build_mesh(moved, true);
    for (size_t i = 0; i < result.size(); ++i)
        result[i] = vec3(mesh.normals[i]) - (relative ? vec3(base.normals[i]) : vec3(0.0f));
    return result;
}

// A target's normals in the order of the base's entries: the file's, where target and base have the
// same corners; smooth ones where neither has any; else none (the base's stay).
std::vector<vec3> target_normals(const MeshDefinition& target, const Mesh& base,
                                 const MeshDefinition& base_definition, bool relative) {
    bool smooth = true;
    for (const PrimitiveGroup& group : base_definition.groups) smooth &= !normals_of(group);
    if (smooth && target.positions.size() == base_definition.positions.size())
        return smooth_normals(target, base, base_definition, relative);
    if (target.groups.size() != base_definition.groups.size()) return {};
    std::vector<vec3> result(base.normals.size(), vec3(0.0f));
    for (size_t g = 0; g < target.groups.size(); ++g) {
        const VertexAttribute* normals = normals_of(target.groups[g]);
        const std::vector<uint32_t>& entries = base.groups[g].normal_corners;
        if (!normals || normals->corners.size() != entries.size()) return {};
        for (size_t c = 0; c < entries.size(); ++c) {
            const float* v = &normals->values[size_t(normals->corners[c]) * normals->stride];
            result[entries[c]] = vec3(v[0], v[1], v[2]);
        }
    }
    return result;
}

skin::Morph build_morph(const SceneDescription& description, const MorphDefinition& definition,
                        const Mesh& mesh, uint32_t* mismatched) {
    const MeshDefinition& base_definition = description.meshes[mesh.definition];
    std::vector<vec3> base(mesh.positions.begin(), mesh.positions.end());
    std::vector<vec3> base_normals(mesh.normals.begin(), mesh.normals.end());
    std::vector<std::vector<vec3>> positions, normals;
    for (uint32_t t : definition.targets) {
        const MeshDefinition& target = description.meshes[t];
        auto& p = positions.emplace_back();
        for (const dvec3& x : target.positions)
            p.push_back(vec3(x - (definition.relative ? dvec3(0.0) : mesh.anchor)));
        normals.push_back(target_normals(target, mesh, base_definition, definition.relative));
    }
    std::vector<skin::MorphTargetSource> sources;
    for (size_t t = 0; t < positions.size(); ++t) sources.push_back({positions[t], normals[t]});
    return skin::build_morph(
        definition.relative ? skin::MorphMethod::Relative : skin::MorphMethod::Normalized, base,
        base_normals, sources, mismatched);
}

}  // namespace

void add_morph(Scene& scene, uint32_t morph, Shape& shape, Diagnostics& diagnostics) {
    const SceneDescription& description = *scene.description;
    const Mesh& mesh = scene.meshes[shape.mesh];
    scene.morphs.resize(description.morphs.size());
    shape.morph_data = morph;
    shape.morphed_positions.resize(mesh.positions.size());
    shape.morphed_normals.resize(mesh.normals.size());
    if (!scene.morphs[morph].base_positions.empty()) return;
    const MorphDefinition& definition = description.morphs[morph];
    uint32_t mismatched = 0;
    scene.morphs[morph] = build_morph(description, definition, mesh, &mismatched);
    if (mismatched)
        diagnostics.report(Code::MORPH_VERTEX_COUNT, definition.where, definition.id, mismatched);
}

}  // namespace kinora
