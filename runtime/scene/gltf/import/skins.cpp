// runtime/scene/gltf/import/skins.cpp: glTF's skins with the influences of a mesh's vertices.
#include "runtime/scene/gltf/import/skins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

constexpr uint32_t kVec4[] = {4};
constexpr size_t kMaxJoints = 100'000;

}  // namespace

// Those that the file does not have are the identity.
void SkinImporter::read_inverse_bind(uint32_t skin, SkinDefinition& to) {
    const tinygltf::Skin& from = model_.skins[skin];
    AccessorNumbers matrices;
    std::string pointer = fmt::format("/skins/{}/inverseBindMatrices", skin);
    if (from.inverseBindMatrices < 0 || !accessors_.read(from.inverseBindMatrices, matrices))
        return;
    size_t joints = to.inverse_bind.size();
    if (matrices.width != 16 || matrices.count() < joints)
        report_.add(Code::GLTF_SKIN, pointer, skin,
                    fmt::format("its {} joints have {} inverse bind matrices; those missing are "
                                "the identity",
                                joints, matrices.width == 16 ? matrices.count() : 0));
    for (size_t j = 0; j < joints && matrices.width == 16 && j < matrices.count(); ++j) {
        dmat4 m;
        bool finite = true;
        for (int k = 0; k < 16; ++k) {
            m[k / 4][k % 4] = double(matrices.values[j * 16 + size_t(k)]);
            finite &= std::isfinite(m[k / 4][k % 4]);
        }
        for (int column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1.0 : 0.0;
        if (finite) to.inverse_bind[j] = m;
    }
}

uint32_t SkinImporter::skin_of(uint32_t mesh, uint32_t skin) {
    auto [known, is_new] = skins_.try_emplace({mesh, skin}, uint32_t(out_.skins.size()));
    if (!is_new) return known->second;
    const tinygltf::Skin& from = model_.skins[skin];
    std::string pointer = fmt::format("/skins/{}", skin);
    SkinDefinition to;
    to.id = from.name.empty() ? fmt::format("skin_{}", skin) : from.name;
    to.where = report_.location(pointer);
    to.in_world = true;  // glTF 2.0, 3.7.3.3: the node of a skinned mesh does not move it
    size_t joints = std::min(from.joints.size(), kMaxJoints);
    to.inverse_bind.assign(joints, dmat4(1.0));
    read_inverse_bind(skin, to);
    for (size_t j = 0; j < joints; ++j) {
        int node = from.joints[j];
        bool there = has_index(node, model_.nodes.size());
        to.joint_names.push_back(there ? model_.nodes[size_t(node)].name : "");
    }
    add_influences(mesh, to);
    out_.skins.push_back(std::move(to));
    return known->second;
}

// JOINTS_n and WEIGHTS_n of every primitive, for all positions of the mesh.
void SkinImporter::add_influences(uint32_t mesh, SkinDefinition& skin) {
    std::string pointer = fmt::format("/meshes/{}", mesh);
    struct Influence {
        int32_t joint;
        float weight;
    };
    const tinygltf::Mesh& from = model_.meshes[mesh];
    std::vector<std::vector<Influence>> influences(out_.meshes[mesh].positions.size());
    size_t strange = 0;
    for (size_t p = 0; p < from.primitives.size(); ++p) {
        const PrimitiveVertices& span = meshes_.primitives(mesh)[p];
        if (!span.usable || span.count == 0 || !influences[span.first].empty()) continue;
        const auto& attributes = from.primitives[p].attributes;
        std::string own = fmt::format("{}/primitives/{}/attributes/", pointer, p);
        for (int set = 0; set < 16; ++set) {
            std::string joints_name = fmt::format("JOINTS_{}", set);
            std::string weights_name = fmt::format("WEIGHTS_{}", set);
            auto joints = attributes.find(joints_name), weights = attributes.find(weights_name);
            if (joints == attributes.end() || weights == attributes.end()) break;
            AccessorNumbers j, w;
            if (!accessors_.read_vertices(joints->second, kVec4, span.count, own + joints_name,
                                          j) ||
                !accessors_.read_vertices(weights->second, kVec4, span.count, own + weights_name,
                                          w))
                break;
            for (size_t i = 0; i < j.values.size(); ++i) {
                if (w.values[i] == 0.0f) continue;
                bool known = j.values[i] < float(skin.inverse_bind.size()) && w.values[i] > 0.0f;
                strange += !known;
                if (known)
                    influences[span.first + i / 4].push_back({int32_t(j.values[i]), w.values[i]});
            }
        }
    }
    if (strange)
        report_.add(
            Code::GLTF_SKIN, pointer, skin.id,
            fmt::format("{} influences have no joint or a negative weight; left out", strange));
    skin.offsets.push_back(0);
    for (const auto& vertex : influences) {
        for (const Influence& influence : vertex) {
            skin.joints.push_back(influence.joint);
            skin.weights.push_back(influence.weight);
        }
        skin.offsets.push_back(uint32_t(skin.joints.size()));
    }
}

}  // namespace kinora
