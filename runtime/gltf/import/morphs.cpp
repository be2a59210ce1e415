// runtime/gltf/import/morphs.cpp: glTF's morph targets as meshes of differences.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/description/findings.h"
#include "runtime/gltf/import/import_p.h"

namespace kinora {

namespace {

constexpr uint32_t kPoint[] = {3};

const VertexAttribute* normals_of(const PrimitiveGroup& group) {
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == "NORMAL") return &a;
    return nullptr;
}

// Flat normals of the moved triangles less those of the base.
VertexAttribute flat_differences(const std::vector<dvec3>& base, const std::vector<dvec3>& deltas,
                                 const PrimitiveGroup& group) {
    const VertexAttribute& rest = *normals_of(group);
    VertexAttribute out{"NORMAL", 0, 3, {}, rest.corners};
    for (size_t c = 0; c + 2 < group.triangles.size(); c += 3) {
        dvec3 p[3];
        for (size_t k = 0; k < 3; ++k)
            p[k] = base[group.triangles[c + k]] + deltas[group.triangles[c + k]];
        dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        double length = glm::length(n);
        for (int k = 0; k < 3; ++k)
            out.values.push_back(length > 0 ? float(n[k] / length) - rest.values[c + size_t(k)]
                                            : 0.0f);
    }
    return out;
}

}  // namespace

// Targets of all primitives of a mesh become meshes with its positions' count and groups.
void GltfImport::import_targets(uint32_t mesh) {
    const tinygltf::Mesh& from = model_.meshes[mesh];
    MeshPlan& plan = plans_[mesh];
    for (const tinygltf::Primitive& primitive : from.primitives)
        plan.targets = std::max(plan.targets, uint32_t(primitive.targets.size()));
    for (uint32_t t = 0; t < plan.targets; ++t) {
        // The definitions may move when one is added: the base is asked for anew.
        size_t count = out_.meshes[mesh].positions.size();
        std::string pointer = fmt::format("/meshes/{}", mesh);
        if (!charge(count * sizeof(dvec3), pointer)) {
            plan.targets = t;
            return;
        }
        MeshDefinition target;
        target.id = fmt::format("{}.target_{}", out_.meshes[mesh].id, t);
        target.positions.assign(count, dvec3(0.0));
        target.groups.resize(out_.meshes[mesh].groups.size());
        Numbers numbers;
        auto read = [&](uint32_t p, const char* name) {
            const auto& targets = from.primitives[p].targets;
            if (t >= targets.size()) return false;
            auto found = targets[t].find(name);
            if (found == targets[t].end()) return false;
            return read_vertices(found->second, kPoint, plan.primitives[p].count,
                                 fmt::format("{}/primitives/{}/targets/{}/{}", pointer, p, t, name),
                                 numbers);
        };
        for (uint32_t p = 0; p < from.primitives.size(); ++p) {
            const PlacedPrimitive& placed = plan.primitives[p];
            if (!placed.usable || !read(p, "POSITION")) continue;
            for (size_t i = 0; i < placed.count; ++i)
                target.positions[placed.first + i] = dvec3(
                    numbers.values[3 * i], numbers.values[3 * i + 1], numbers.values[3 * i + 2]);
        }
        for (uint32_t p = 0; p < from.primitives.size(); ++p) {
            const PlacedPrimitive& placed = plan.primitives[p];
            if (placed.group == kNone) continue;
            const PrimitiveGroup& base = out_.meshes[mesh].groups[placed.group];
            const VertexAttribute* rest = normals_of(base);
            if (!rest || !charge(rest->corners.size() * 4 + rest->values.size() * 4, pointer))
                continue;
            PrimitiveGroup& group = target.groups[placed.group];
            bool flat = !from.primitives[p].attributes.contains("NORMAL");
            if (flat)
                group.attributes.push_back(
                    flat_differences(out_.meshes[mesh].positions, target.positions, base));
            else if (read(p, "NORMAL"))
                group.attributes.push_back({"NORMAL", 0, 3, numbers.values, rest->corners});
            else
                group.attributes.push_back(
                    {"NORMAL", 0, 3, std::vector<float>(rest->values.size(), 0.0f), rest->corners});
        }
        target_meshes_[mesh].push_back(uint32_t(out_.meshes.size()));
        out_.meshes.push_back(std::move(target));
    }
}

// A node with weights of its own, or that a channel writes, has its own morph.
uint32_t GltfImport::morph_of(uint32_t mesh, uint32_t node) {
    const tinygltf::Node& from = model_.nodes[node];
    bool own = !from.weights.empty() || (moves_[node] & kMovesWeights);
    auto [place, is_new] =
        morphs_.try_emplace({mesh, own ? node : kNone}, uint32_t(out_.morphs.size()));
    if (!is_new) return place->second;
    MorphDefinition to;
    to.id = out_.meshes[mesh].id;
    to.relative = true;
    to.targets = target_meshes_[mesh];
    to.where = gltf_location(file_, fmt::format("/meshes/{}", mesh));
    std::vector<double> weights = from.weights.empty() ? model_.meshes[mesh].weights : from.weights;
    if (weights.size() > to.targets.size() && !to.targets.empty())
        report(Code::GLTF_MORPH, fmt::format("/meshes/{}", mesh), mesh,
               fmt::format("{} weights for {} targets", weights.size(), to.targets.size()));
    weights.resize(to.targets.size(), 0.0);
    for (double& weight : weights)
        if (!std::isfinite(weight)) weight = 0.0;
    to.weights = {append(weights, weights.size()), uint32_t(weights.size())};
    out_.morphs.push_back(std::move(to));
    return place->second;
}

}  // namespace kinora
