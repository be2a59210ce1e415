// runtime/scene/gltf/import/morphs.cpp: glTF's morph targets as meshes of differences.
#include "runtime/scene/gltf/import/morphs.h"
#include "runtime/scene/description/picture_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/import/values.h"

namespace kinora {

namespace {

constexpr uint32_t kMorphPoint[] = {3};

}  // namespace

MorphImporter::MorphImporter(const tinygltf::Model& model, const MeshImporter& meshes,
                             AccessorReader& accessors, GltfReport& report, ByteBudget& budget,
                             SceneDescription& out)
    : model_(model),
      meshes_(meshes),
      accessors_(accessors),
      report_(report),
      budget_(budget),
      out_(out),
      targets_(model.meshes.size()) {}

struct MorphImporter::Target {
    uint32_t mesh, index;
    std::string pointer;  // of the mesh
};

bool MorphImporter::read_differences(const Target& target, uint32_t primitive, const char* name,
                                     AccessorNumbers& out) {
    const auto& targets = model_.meshes[target.mesh].primitives[primitive].targets;
    if (target.index >= targets.size()) return false;
    auto found = targets[target.index].find(name);
    if (found == targets[target.index].end()) return false;
    return accessors_.read_vertices(found->second, kMorphPoint,
                                    meshes_.primitives(target.mesh)[primitive].count,
                                    fmt::format("{}/primitives/{}/targets/{}/{}", target.pointer,
                                                primitive, target.index, name),
                                    out);
}

void MorphImporter::add_positions(const Target& target, MeshDefinition& to) {
    std::span<const PrimitiveVertices> primitives = meshes_.primitives(target.mesh);
    AccessorNumbers numbers;
    for (uint32_t p = 0; p < primitives.size(); ++p) {
        const PrimitiveVertices& vertices = primitives[p];
        if (!vertices.usable || !read_differences(target, p, "POSITION", numbers)) continue;
        for (size_t i = 0; i < vertices.count; ++i)
            to.positions[vertices.first + i] =
                dvec3(numbers.values[3 * i], numbers.values[3 * i + 1], numbers.values[3 * i + 2]);
    }
}

void MorphImporter::add_normals(const Target& target, MeshDefinition& to) {
    const MeshDefinition& mesh = out_.meshes[target.mesh];
    std::span<const PrimitiveVertices> primitives = meshes_.primitives(target.mesh);
    AccessorNumbers numbers;
    for (uint32_t p = 0; p < primitives.size(); ++p) {
        if (primitives[p].group == kNone) continue;
        const PrimitiveGroup& base = mesh.groups[primitives[p].group];
        const VertexAttribute* rest = normals_of(base);
        if (!rest ||
            !budget_.charge(rest->corners.size() * 4 + rest->values.size() * 4, target.pointer))
            continue;
        PrimitiveGroup& group = to.groups[primitives[p].group];
        if (read_differences(target, p, "NORMAL", numbers))
            group.attributes.push_back({"NORMAL", 0, 3, numbers.values, rest->corners});
        else
            group.attributes.push_back(
                {"NORMAL", 0, 3, std::vector<float>(rest->values.size(), 0.0f), rest->corners});
    }
}

void MorphImporter::import_targets(uint32_t mesh) {
    size_t most = 0;
    for (const tinygltf::Primitive& primitive : model_.meshes[mesh].primitives)
        most = std::max(most, primitive.targets.size());
    for (uint32_t t = 0; t < most; ++t) {
        const MeshDefinition& base = out_.meshes[mesh];
        Target target{mesh, t, fmt::format("/meshes/{}", mesh)};
        if (!budget_.charge(base.positions.size() * sizeof(dvec3), target.pointer)) return;
        MeshDefinition to;
        to.id = fmt::format("{}.target_{}", base.id, t);
        to.positions.assign(base.positions.size(), dvec3(0.0));
        to.groups.resize(base.groups.size());
        add_positions(target, to);
        add_normals(target, to);
        targets_[mesh].push_back(uint32_t(out_.meshes.size()));
        out_.meshes.push_back(std::move(to));
    }
}

uint32_t MorphImporter::morph_of(uint32_t mesh, uint32_t node, bool weights_move) {
    const std::vector<uint32_t>& targets = targets_[mesh];
    if (targets.empty()) return kNone;
    const tinygltf::Node& from = model_.nodes[node];
    bool own = !from.weights.empty() || weights_move;
    auto [known, is_new] =
        morphs_.try_emplace({mesh, own ? node : kNone}, uint32_t(out_.morphs.size()));
    if (!is_new) return known->second;
    std::string pointer = fmt::format("/meshes/{}", mesh);
    MorphDefinition to;
    to.id = out_.meshes[mesh].id;
    to.relative = true;
    to.targets = targets;
    to.where = report_.location(pointer);
    std::vector<double> weights = from.weights.empty() ? model_.meshes[mesh].weights : from.weights;
    if (weights.size() > targets.size())
        report_.add(Code::GLTF_MORPH, pointer, mesh,
                    fmt::format("{} weights for {} targets", weights.size(), targets.size()));
    weights.resize(targets.size(), 0.0);
    for (double& weight : weights)
        if (!std::isfinite(weight)) weight = 0.0;
    to.weights = {append_values(out_.values, weights, weights.size()), uint32_t(weights.size())};
    out_.morphs.push_back(std::move(to));
    return known->second;
}

}  // namespace kinora
