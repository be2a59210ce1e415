// runtime/scene/vertices/diced_deform.cpp: skin weights and morph targets of diced meshes.
#include <algorithm>
#include <map>

#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

void dice_influences(std::span<const Stencil> stencils, std::vector<uint32_t>& first,
                     std::vector<int32_t>& joints, std::vector<double>& weights) {
    std::vector<uint32_t> new_first = {0};
    std::vector<int32_t> new_joints;
    std::vector<double> new_weights;
    size_t most = std::min(joints.size(), weights.size());
    std::map<int32_t, double> sum;  // by joint: in order, whatever the corner
    for (const Stencil& s : stencils) {
        sum.clear();
        for (int k = 0; k < 3; ++k) {
            if (s.weight[k] == 0 || size_t(s.entry[k]) + 1 >= first.size()) continue;
            size_t begin = std::min<size_t>(first[s.entry[k]], most);
            size_t end = std::clamp<size_t>(first[s.entry[k] + 1], begin, most);
            // Each corner counts by its position alone, whatever its weights sum to.
            double total = 0;
            for (size_t i = begin; i < end; ++i) total += weights[i];
            if (s.weight[k] == 1 || !(total > 0)) total = 1;
            for (size_t i = begin; i < end; ++i)
                sum[joints[i]] += double(s.weight[k]) * weights[i] / total;
        }
        for (const auto& [joint, weight] : sum) {
            new_joints.push_back(joint);
            new_weights.push_back(weight);
        }
        new_first.push_back(uint32_t(new_joints.size()));
    }
    first = std::move(new_first);
    joints = std::move(new_joints);
    weights = std::move(new_weights);
}

namespace {

std::vector<vec4> between(std::span<const Stencil> stencils, std::span<const vec4> entries) {
    std::vector<vec4> result;
    result.reserve(stencils.size());
    for (const Stencil& s : stencils) {
        dvec3 sum(0.0);
        for (int k = 0; k < 3; ++k)
            if (s.weight[k] != 0) sum += double(s.weight[k]) * dvec3(entries[s.entry[k]]);
        result.push_back(vec4(vec3(sum), 0.0f));
    }
    return result;
}

skin::MorphDeltas between(std::span<const Stencil> stencils, const skin::MorphDeltas& from,
                          size_t count) {
    skin::MorphDeltas result;
    if (from.deltas.empty()) return result;
    std::vector<vec4> dense = from.deltas;
    if (!from.entries.empty()) {
        dense.assign(count, vec4(0.0f));
        for (size_t i = 0; i < from.entries.size(); ++i) dense[from.entries[i]] = from.deltas[i];
    }
    dense.resize(count, vec4(0.0f));
    std::vector<vec4> all = between(stencils, dense);
    if (from.entries.empty()) {
        result.deltas = std::move(all);
        return result;
    }
    for (uint32_t i = 0; i < all.size(); ++i)
        if (all[i] != vec4(0.0f)) {
            result.entries.push_back(i);
            result.deltas.push_back(all[i]);
        }
    return result;
}

}  // namespace

skin::Morph dice_morph(const skin::Morph& from, std::span<const Stencil> positions,
                       std::span<const Stencil> normals) {
    skin::Morph result;
    result.base_positions = between(positions, from.base_positions);
    result.base_normals = between(normals, from.base_normals);
    for (const skin::MorphTarget& target : from.targets)
        result.targets.push_back({between(positions, target.positions, from.base_positions.size()),
                                  between(normals, target.normals, from.base_normals.size())});
    return result;
}

}  // namespace kinora
