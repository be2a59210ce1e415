// runtime/gltf/import/skins.cpp: glTF's skins with the influences of a mesh's vertices.
#include <fmt/format.h>

#include <cmath>

#include "runtime/description/findings.h"
#include "runtime/gltf/import/import_p.h"

namespace kinora {

namespace {

constexpr uint32_t kVec4[] = {4};
constexpr size_t kMaxJoints = 100'000;

}  // namespace

uint32_t GltfImport::skin_of(uint32_t mesh, uint32_t skin) {
    auto [place, is_new] = skins_.try_emplace({mesh, skin}, uint32_t(out_.skins.size()));
    if (!is_new) return place->second;
    const tinygltf::Skin& from = model_.skins[skin];
    std::string pointer = fmt::format("/skins/{}", skin);
    SkinDefinition to;
    to.id = from.name.empty() ? fmt::format("skin_{}", skin) : from.name;
    to.where = gltf_location(file_, pointer);
    to.in_world = true;  // glTF 2.0, 3.7.3.3: the node of a skinned mesh does not move it
    size_t joints = std::min(from.joints.size(), kMaxJoints);
    to.inverse_bind.assign(joints, dmat4(1.0));
    Numbers matrices;
    std::string place_of_matrices = pointer + "/inverseBindMatrices";
    if (from.inverseBindMatrices >= 0 &&
        read_accessor(from.inverseBindMatrices, place_of_matrices, matrices)) {
        if (matrices.width != 16 || matrices.count() < joints)
            report(Code::GLTF_SKIN, place_of_matrices, skin,
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
    for (size_t j = 0; j < joints; ++j) {
        int node = from.joints[j];
        exists(node, model_.nodes.size(), "node", fmt::format("{}/joints/{}", pointer, j));
        bool there = node >= 0 && size_t(node) < model_.nodes.size();
        to.joint_names.push_back(there ? model_.nodes[size_t(node)].name : "");
    }
    add_influences(mesh, fmt::format("/meshes/{}", mesh), to);
    out_.skins.push_back(std::move(to));
    return place->second;
}

// JOINTS_n and WEIGHTS_n of every primitive, for all positions of the mesh.
void GltfImport::add_influences(uint32_t mesh, const std::string& pointer, SkinDefinition& skin) {
    struct Influence {
        int32_t joint;
        float weight;
    };
    const tinygltf::Mesh& from = model_.meshes[mesh];
    std::vector<std::vector<Influence>> influences(out_.meshes[mesh].positions.size());
    size_t strange = 0;
    for (size_t p = 0; p < from.primitives.size(); ++p) {
        const PlacedPrimitive& placed = plans_[mesh].primitives[p];
        if (!placed.usable || placed.count == 0 || !influences[placed.first].empty()) continue;
        const auto& attributes = from.primitives[p].attributes;
        std::string place = fmt::format("{}/primitives/{}/attributes/", pointer, p);
        for (int set = 0; set < 16; ++set) {
            std::string joints_name = fmt::format("JOINTS_{}", set);
            std::string weights_name = fmt::format("WEIGHTS_{}", set);
            auto joints = attributes.find(joints_name), weights = attributes.find(weights_name);
            if (joints == attributes.end() || weights == attributes.end()) break;
            Numbers j, w;
            if (!read_vertices(joints->second, kVec4, placed.count, place + joints_name, j) ||
                !read_vertices(weights->second, kVec4, placed.count, place + weights_name, w))
                break;
            for (size_t i = 0; i < j.values.size(); ++i) {
                if (w.values[i] == 0.0f) continue;
                bool known = j.values[i] < float(skin.inverse_bind.size()) && w.values[i] > 0.0f;
                strange += !known;
                if (known)
                    influences[placed.first + i / 4].push_back({int32_t(j.values[i]), w.values[i]});
            }
        }
    }
    if (strange)
        report(Code::GLTF_SKIN, pointer, skin.id,
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
