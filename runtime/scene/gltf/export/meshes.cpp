// runtime/scene/gltf/export/meshes.cpp: meshes: one vertex for each tuple of indices, influences,
// targets.
#include "runtime/scene/gltf/export/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/description/pair_numbers.h"
#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/gltf/export/influences.h"

namespace kinora {

namespace {

constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr size_t kMostShortIndices = 65535;  // the index 65535 itself restarts a primitive

// import_scene left none that are no directions.
vec3 unit_normal(const dvec3& n) {
    double length = glm::length(n);
    return length > 0 && std::isfinite(length) ? vec3(n / length) : vec3(0, 0, 1);
}

void push(std::vector<float>& numbers, vec3 v) {
    numbers.insert(numbers.end(), {v.x, v.y, v.z});
}

// The numbers as glTF has them: t grows upwards, v downwards; tangents have length 1, their last
// number is a sign.
void push(std::vector<float>& numbers, const GltfAttribute& a, uint32_t corner) {
    const float* v = &a.values->values[size_t(a.values->corners[corner]) * a.values->stride];
    if (a.name == "TANGENT") {
        push(numbers, unit_normal(dvec3(v[0], v[1], v[2])));
        numbers.push_back(v[3] < 0 ? -1.0f : 1.0f);
        return;
    }
    for (uint32_t i = 0; i < a.width; ++i) numbers.push_back(std::isfinite(v[i]) ? v[i] : 0.0f);
    if (a.name.starts_with("TEXCOORD_")) numbers.back() = 1.0f - numbers.back();
}

}  // namespace

const WrittenMesh& MeshWriter::written(uint32_t mesh) {
    auto found = written_.find(mesh);
    if (found == written_.end())
        found = written_.emplace(mesh, written_mesh(description_.meshes[mesh], losses_)).first;
    return found->second;
}

uint32_t MeshWriter::write(const MeshUse& use) {
    const MeshDefinition& definition = *written(use.mesh).definition;
    std::string key = fmt::format("{} {} {}", use.mesh, use.morph, use.skin);
    for (const PrimitiveGroup& group : definition.groups)
        key += fmt::format(" {}", materials_.write(use, group));
    auto [found, fresh] = meshes_.try_emplace(key, kNone);
    if (!fresh) return found->second;
    Json primitives = Json::array();
    for (uint32_t g = 0; g < definition.groups.size(); ++g)
        if (!definition.groups[g].triangles.empty())
            primitives.push_back(primitive(use, g, written(use.mesh)));
    if (primitives.empty()) return kNone;
    Json result = {{"primitives", primitives}};
    if (!definition.id.empty()) result["name"] = definition.id;
    return found->second = document_.add("meshes", std::move(result));
}

Json MeshWriter::primitive(const MeshUse& use, uint32_t group_index, const WrittenMesh& mesh) {
    const MeshDefinition& definition = *mesh.definition;
    const Mesh& built = mesh.built;
    const PrimitiveGroup& group = definition.groups[group_index];
    std::vector<GltfAttribute> others = attributes_of(looks_.look_of(use, group), group, losses_);
    // A normal's number names its position too (build_mesh); each further attribute splits on.
    const MeshGroup& rest = built.groups[group_index];
    std::vector<uint32_t> vertex = rest.flat() ? group.triangles : rest.normal_corners;
    auto renumber = [&](const std::vector<uint32_t>& entries) {
        PairNumbers pairs(vertex.size());
        uint32_t next = 0;
        for (size_t c = 0; c < vertex.size(); ++c) {
            vertex[c] = pairs.number(vertex[c], entries[c], next);
            next += vertex[c] == next;
        }
        return next;
    };
    uint32_t count = renumber(group.triangles);
    for (const GltfAttribute& a : others) count = renumber(a.attribute->corners);
    std::vector<uint32_t> corners(count);  // the first corner of each vertex
    for (size_t c = vertex.size(); c-- > 0;) corners[vertex[c]] = uint32_t(c);

    std::vector<float> positions, normals;
    std::vector<uint32_t> position_index;
    for (uint32_t c : corners) {
        position_index.push_back(group.triangles[c]);
        push(positions, vec3(definition.positions[group.triangles[c]] - mesh.origin));
        if (!rest.flat()) push(normals, unit_normal(dvec3(built.normals[rest.normal_corners[c]])));
    }
    Json attributes = {{"POSITION", buffer_.accessor(positions, 3, kVertexTarget, true)}};
    // Without them faces are flat in glTF, too (glTF 2.0, 3.7.2.1).
    if (!rest.flat()) attributes["NORMAL"] = buffer_.accessor(normals, 3, kVertexTarget, false);
    for (const GltfAttribute& a : others) {
        std::vector<float> numbers;
        for (uint32_t c : corners) push(numbers, a, c);
        attributes[a.name] = buffer_.accessor(numbers, a.width, kVertexTarget, false);
    }
    if (use.skin != kNone) add_influences(use, position_index, attributes);
    Json result = {{"attributes", attributes}};
    result["indices"] = count <= kMostShortIndices
                            ? buffer_.accessor(std::vector<uint16_t>(vertex.begin(), vertex.end()),
                                               1, kIndexTarget, false)
                            : buffer_.accessor(vertex, 1, kIndexTarget, false);
    if (uint32_t m = materials_.write(use, group); m != kNone) result["material"] = m;
    if (use.morph != kNone) add_targets(use, mesh, group_index, corners, result);
    return result;
}

// Four influences a set.
void MeshWriter::add_influences(const MeshUse& use, const std::vector<uint32_t>& positions,
                                Json& attributes) {
    std::vector<std::vector<JointInfluence>> all =
        vertex_influences(description_.skins[use.skin], positions);
    size_t most = 1;
    for (const std::vector<JointInfluence>& list : all) most = std::max(most, list.size());
    for (size_t set = 0; set < (most + 3) / 4; ++set) {
        std::vector<uint16_t> joints;
        std::vector<float> weights;
        for (const std::vector<JointInfluence>& list : all)
            for (size_t i = 4 * set; i < 4 * set + 4; ++i) {
                joints.push_back(i < list.size() ? uint16_t(list[i].joint) : 0);
                weights.push_back(i < list.size() ? list[i].weight : 0.0f);
            }
        attributes[fmt::format("JOINTS_{}", set)] =
            buffer_.accessor(joints, 4, kVertexTarget, false);
        attributes[fmt::format("WEIGHTS_{}", set)] =
            buffer_.accessor(weights, 4, kVertexTarget, false);
    }
}

// Differences from the base, whatever the method: (1 - sum of w) base + sum of w target is base +
// sum of w (target - base). Normals of a target: the file's where its corners are the base's, else
// they stay.
void MeshWriter::add_targets(const MeshUse& use, const WrittenMesh& mesh, uint32_t group_index,
                             const std::vector<uint32_t>& corners, Json& primitive) {
    const MeshDefinition& base = *mesh.definition;
    const Mesh& built = mesh.built;
    const PrimitiveGroup& group = base.groups[group_index];
    const MeshGroup& rest = built.groups[group_index];
    std::vector<std::pair<uint32_t, bool>> targets;  // of all morphs, and whether RELATIVE
    for (uint32_t m : morph_chain(description_, use.morph))
        for (uint32_t t : description_.morphs[m].targets)
            targets.emplace_back(t, description_.morphs[m].relative);
    for (auto [t, relative] : targets) {
        const MeshDefinition& target = description_.meshes[t];
        auto moved = [&, relative = relative](uint32_t p) {
            if (p >= target.positions.size()) return base.positions[p];
            return relative ? base.positions[p] + target.positions[p] : target.positions[p];
        };
        std::vector<float> positions, normals;
        for (uint32_t c : corners)
            push(positions, vec3(moved(group.triangles[c]) - base.positions[group.triangles[c]]));
        const VertexAttribute* given =
            group_index < target.groups.size() ? normals_of(target.groups[group_index]) : nullptr;
        bool fits = given && given->corners.size() == group.triangles.size();
        for (uint32_t c : corners) {
            if (rest.flat()) break;
            vec3 from = unit_normal(dvec3(built.normals[rest.normal_corners[c]]));
            vec3 to = from;
            if (fits) {
                const float* v = &given->values[size_t(given->corners[c]) * given->stride];
                to = vec3(v[0], v[1], v[2]) + (relative ? from : vec3(0));
            }
            push(normals, to - from);
        }
        Json written = {{"POSITION", buffer_.accessor(positions, 3, kVertexTarget, true)}};
        if (!rest.flat()) written["NORMAL"] = buffer_.accessor(normals, 3, kVertexTarget, false);
        primitive["targets"].push_back(std::move(written));
    }
}

}  // namespace kinora
