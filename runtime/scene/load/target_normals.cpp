// runtime/scene/load/target_normals.cpp: corners of a morph's base that its targets tell apart.
#include "runtime/scene/load/target_normals.h"

#include <array>
#include <map>
#include <set>

#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/description/pair_numbers.h"
#include "runtime/scene/description/picture_rules.h"

namespace kinora {

namespace {

// A number for each corner's normal: equal ones have the same.
std::vector<uint32_t> numbered(const VertexAttribute& normals) {
    std::map<std::array<float, 3>, uint32_t> numbers;
    std::vector<uint32_t> of_entry;
    for (size_t at = 0; at + normals.stride <= normals.values.size(); at += normals.stride) {
        const float* v = &normals.values[at];
        of_entry.push_back(
            numbers.try_emplace({v[0], v[1], v[2]}, uint32_t(numbers.size())).first->second);
    }
    std::vector<uint32_t> of_corner;
    for (uint32_t entry : normals.corners) of_corner.push_back(of_entry[entry]);
    return of_corner;
}

// The classes of corners, from 0 on in order of first sight, parted by a number of each corner.
void part(std::vector<uint32_t>& classes, const std::vector<uint32_t>& by) {
    PairNumbers numbers(classes.size());
    uint32_t next = 0;
    for (size_t c = 0; c < classes.size(); ++c) {
        classes[c] = numbers.number(classes[c], by[c], next);
        next += classes[c] == next;
    }
}

// The first class of corners with one position and normal keeps the entry; others get a copy.
void give_entries(const PrimitiveGroup& group, const std::vector<uint32_t>& classes,
                  VertexAttribute& normals) {
    const std::vector<uint32_t> before = normals.corners;
    PairNumbers kept(classes.size());
    std::vector<uint32_t> entry_of_class;
    for (size_t c = 0; c < classes.size(); ++c) {
        if (classes[c] == entry_of_class.size()) {
            const bool first = kept.number(group.triangles[c], before[c], classes[c]) == classes[c];
            entry_of_class.push_back(first ? before[c]
                                           : uint32_t(normals.values.size() / normals.stride));
            for (uint32_t k = 0; k < normals.stride && !first; ++k)
                normals.values.push_back(normals.values[size_t(before[c]) * normals.stride + k]);
        }
        normals.corners[c] = entry_of_class[classes[c]];
    }
}

void part_group(MeshDefinition& mesh, size_t g, const std::vector<const MeshDefinition*>& targets) {
    PrimitiveGroup& group = mesh.groups[g];
    const VertexAttribute* normals = normals_of(group);
    if (!normals) return;
    std::vector<uint32_t> classes;
    for (const MeshDefinition* target : targets) {
        const VertexAttribute* theirs =
            target->groups.size() == mesh.groups.size() ? normals_of(target->groups[g]) : nullptr;
        const bool parts = theirs && theirs->corners.size() == normals->corners.size() &&
                           theirs->corners != normals->corners;
        if (!parts) continue;
        if (classes.empty()) {
            classes = group.triangles;
            part(classes, normals->corners);
        }
        part(classes, numbered(*theirs));
    }
    if (classes.empty()) return;
    give_entries(group, classes, group.attributes[size_t(normals - group.attributes.data())]);
}

}  // namespace

void part_normals_by_targets(SceneDescription& description) {
    std::map<uint32_t, std::set<uint32_t>> targets;  // of a mesh
    for (const NodeDefinition& node : description.nodes)
        for (const MeshUse& use : node.meshes)
            for (uint32_t m : morph_chain(description, use.morph))
                targets[use.mesh].insert(description.morphs[m].targets.begin(),
                                         description.morphs[m].targets.end());
    for (const auto& [mesh, numbers] : targets) {
        std::vector<const MeshDefinition*> found;
        for (uint32_t t : numbers) found.push_back(&description.meshes[t]);
        for (size_t g = 0; g < description.meshes[mesh].groups.size(); ++g)
            part_group(description.meshes[mesh], g, found);
    }
}

}  // namespace kinora
