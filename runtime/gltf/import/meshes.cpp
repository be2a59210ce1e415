// runtime/gltf/import/meshes.cpp: glTF's meshes: each primitive a group with its own vertices.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/description/findings.h"
#include "runtime/gltf/import/import_p.h"

namespace kinora {

namespace {

constexpr uint32_t kPoint[] = {3}, kTangent[] = {4}, kTexcoord[] = {2}, kColor[] = {3, 4},
                   kAny[] = {1, 2, 3, 4};

constexpr const char* kModes[] = {"points",    "lines",           "line loops",   "line strips",
                                  "triangles", "triangle strips", "triangle fans"};

// The corners of all triangles, three each, as places in the list of vertices (glTF 2.0, 3.7.2.1).
std::array<size_t, 3> corners_of(int mode, size_t triangle) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        return {triangle, triangle + 1 + triangle % 2, triangle + 2 - triangle % 2};
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {triangle + 1, triangle + 2, 0};
    return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
}

// One entry a triangle (glTF 2.0, 3.7.2.1: flat where none are given).
VertexAttribute flat_normals(const std::vector<dvec3>& positions,
                             const std::vector<uint32_t>& triangles) {
    VertexAttribute normals{"NORMAL", 0, 3, {}, {}};
    for (size_t c = 0; c + 2 < triangles.size(); c += 3) {
        dvec3 a = positions[triangles[c]];
        dvec3 n = glm::cross(positions[triangles[c + 1]] - a, positions[triangles[c + 2]] - a);
        double length = glm::length(n);
        if (length > 0) n /= length;
        for (int k = 0; k < 3; ++k) {
            normals.values.push_back(float(n[k]));
            normals.corners.push_back(uint32_t(c / 3));
        }
    }
    return normals;
}

}  // namespace

GltfImport::Numbered GltfImport::numbered(const std::string& semantic) {
    size_t bar = semantic.rfind('_');
    bool short_enough = bar != std::string::npos && bar > 0 && semantic.size() - bar <= 4 &&
                        bar + 1 < semantic.size();
    if (!short_enough) return {};
    uint32_t set = 0;
    for (char c : semantic.substr(bar + 1)) {
        if (c < '0' || c > '9') return {};
        set = set * 10 + uint32_t(c - '0');
    }
    return {semantic.substr(0, bar), set};
}

GltfImport::Numbered GltfImport::own_attribute(const std::string& name) {
    Numbered own = numbered(name.substr(1));
    bool has_set = own.name == "COLOR" || own.name == "TEXCOORD";
    return has_set ? own : Numbered{name.substr(1), 0};
}

void GltfImport::import_meshes() {
    out_.meshes.resize(model_.meshes.size());
    plans_.resize(model_.meshes.size());
    target_meshes_.resize(model_.meshes.size());
    std::vector<bool> used(model_.meshes.size(), false);
    for (size_t n = 0; n < model_.nodes.size(); ++n) {
        int mesh = model_.nodes[n].mesh;
        if (shown_[n] && mesh >= 0 && size_t(mesh) < used.size()) used[size_t(mesh)] = true;
    }
    for (uint32_t m = 0; m < model_.meshes.size(); ++m) {
        const tinygltf::Mesh& from = model_.meshes[m];
        MeshDefinition& to = out_.meshes[m];
        to.name = from.name;
        to.id = unique_id(from.name, "mesh", m);
        plans_[m].primitives.resize(from.primitives.size());
        if (!used[m]) continue;
        for (uint32_t p = 0; p < from.primitives.size(); ++p) import_primitive(m, p);
    }
    for (uint32_t m = 0; m < model_.meshes.size(); ++m)
        if (used[m]) import_targets(m);
}

// Primitives that share all that moves vertices share their positions.
bool GltfImport::place_vertices(uint32_t mesh, uint32_t primitive, const std::string& pointer) {
    const tinygltf::Mesh& from = model_.meshes[mesh];
    PlacedPrimitive& placed = plans_[mesh].primitives[primitive];
    auto key = [](const tinygltf::Primitive& p) {
        std::vector<int> accessors;
        for (const auto& [name, accessor] : p.attributes)
            if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))
                accessors.push_back(accessor);
        for (const auto& target : p.targets)
            for (const auto& [name, accessor] : target) accessors.push_back(accessor);
        return accessors;
    };
    for (uint32_t other = 0; other < primitive; ++other) {
        const PlacedPrimitive& known = plans_[mesh].primitives[other];
        if (!known.usable || key(from.primitives[other]) != key(from.primitives[primitive]))
            continue;
        placed.first = known.first;
        placed.count = known.count;
        return true;
    }
    const auto& attributes = from.primitives[primitive].attributes;
    auto position = attributes.find("POSITION");
    if (position == attributes.end()) {
        report(Code::GLTF_PRIMITIVE, pointer, "it has no POSITION");
        return false;
    }
    Numbers numbers;
    std::string place = pointer + "/attributes/POSITION";
    if (!read_accessor(position->second, place, numbers)) return false;
    if (numbers.width != 3) {
        report(Code::GLTF_PRIMITIVE, place, "positions have three numbers");
        return false;
    }
    std::vector<dvec3>& positions = out_.meshes[mesh].positions;
    size_t count = numbers.count();
    if (positions.size() + count > kNone || !charge(count * sizeof(dvec3), place)) return false;
    placed.first = uint32_t(positions.size());
    placed.count = uint32_t(count);
    for (size_t i = 0; i < count; ++i)
        positions.emplace_back(numbers.values[3 * i], numbers.values[3 * i + 1],
                               numbers.values[3 * i + 2]);
    return true;
}

// Corners that count from the primitive's first vertex.
std::vector<uint32_t> GltfImport::triangles_of(const tinygltf::Primitive& primitive,
                                               uint32_t vertices, const std::string& pointer) {
    std::vector<uint32_t> indices;
    bool indexed = primitive.indices >= 0;
    if (indexed && !read_indices(primitive.indices, pointer + "/indices", indices)) return {};
    size_t listed = indexed ? indices.size() : vertices;
    bool apart = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    size_t count = apart ? listed / 3 : listed < 3 ? 0 : listed - 2;
    std::vector<uint32_t> triangles;
    if (!charge(count * 3 * sizeof(uint32_t), pointer)) return {};
    triangles.reserve(count * 3);
    size_t beyond = 0;
    for (size_t t = 0; t < count; ++t) {
        std::array<size_t, 3> corners = corners_of(primitive.mode, t);
        bool sound = true;
        for (size_t& c : corners) {
            if (indexed) c = indices[c];
            sound &= c < vertices;
        }
        beyond += !sound;
        if (!sound) continue;
        for (size_t c : corners) triangles.push_back(uint32_t(c));
    }
    if (beyond)
        report(Code::GLTF_TRIANGLES, pointer + "/indices", beyond,
               fmt::format("they name vertices beyond the {} there are", vertices));
    if (apart && listed % 3)
        report(Code::GLTF_VALUE, pointer + "/indices",
               fmt::format("{} corners make no whole triangles; the last {} are left out", listed,
                           listed % 3));
    return triangles;
}

// Returns the primitive's tangents, four numbers a vertex, where its material wants them.
std::vector<float> GltfImport::add_attributes(const tinygltf::Primitive& primitive,
                                              const PlacedPrimitive& placed,
                                              const std::string& pointer, PrimitiveGroup& group) {
    std::vector<uint32_t> corners = group.triangles;
    for (uint32_t& c : corners) c -= placed.first;
    auto add = [&](std::string semantic, uint32_t set, uint32_t stride, std::vector<float> values) {
        if (!charge(corners.size() * sizeof(uint32_t), pointer)) return;
        group.attributes.push_back({std::move(semantic), set, stride, std::move(values), corners});
    };
    Numbers numbers;
    std::vector<float> tangents;
    for (const auto& [name, accessor] : primitive.attributes) {
        std::string place = pointer + "/attributes/" + name;
        Numbered of_set = numbered(name);
        auto read = [&](std::span<const uint32_t> widths) {
            return read_vertices(accessor, widths, placed.count, place, numbers);
        };
        if (name == "NORMAL") {
            if (read(kPoint)) add("NORMAL", 0, 3, std::move(numbers.values));
        } else if (name == "TANGENT") {
            // Only a map of normals asks for them.
            int m = primitive.material;
            bool bent = m >= 0 && size_t(m) < model_.materials.size() &&
                        model_.materials[size_t(m)].normalTexture.index >= 0;
            if (!bent || !read(kTangent)) continue;
            tangents = numbers.values;
            add("TANGENT", 0, 4, std::move(numbers.values));
        } else if (of_set.name == "TEXCOORD") {
            if (!read(kTexcoord)) continue;
            for (size_t i = 1; i < numbers.values.size(); i += 2)
                numbers.values[i] = 1.0f - numbers.values[i];
            add("TEXCOORD", of_set.set, 2, std::move(numbers.values));
        } else if (of_set.name == "COLOR") {
            if (!read(kColor)) continue;
            if (of_set.set == 0 && numbers.width == 4) {
                std::vector<float> alpha;
                for (size_t i = 3; i < numbers.values.size(); i += 4)
                    alpha.push_back(numbers.values[i]);
                add("vertex_alpha", 0, 1, std::move(alpha));
            }
            add("COLOR", of_set.set, numbers.width, std::move(numbers.values));
        } else if (name.starts_with('_') && name.size() > 1) {  // the application's own
            if (!read(kAny)) continue;
            Numbered own = own_attribute(name);
            add(std::move(own.name), own.set, numbers.width, std::move(numbers.values));
        }
    }
    return tangents;
}

void GltfImport::import_primitive(uint32_t mesh, uint32_t index) {
    const tinygltf::Primitive& from = model_.meshes[mesh].primitives[index];
    PlacedPrimitive& placed = plans_[mesh].primitives[index];
    std::string pointer = fmt::format("/meshes/{}/primitives/{}", mesh, index);
    int mode = from.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        report(Code::GLTF_NOT_SHADED, pointer, kModes[mode]);
        return;
    }
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        report(Code::GLTF_PRIMITIVE, pointer + "/mode", fmt::format("{} is no mode", mode));
        return;
    }
    if (!place_vertices(mesh, index, pointer)) return;
    MeshDefinition& definition = out_.meshes[mesh];
    tinygltf::Primitive sound = from;
    sound.mode = mode;
    std::vector<uint32_t> triangles = triangles_of(sound, placed.count, pointer);
    auto not_finite = [&](const uint32_t* corner) {
        for (int k = 0; k < 3; ++k) {
            const dvec3& p = definition.positions[placed.first + corner[k]];
            if (!std::isfinite(p.x + p.y + p.z)) return true;
        }
        return false;
    };
    PrimitiveGroup group;
    size_t bad = 0;
    for (size_t c = 0; c + 2 < triangles.size(); c += 3) {
        if (not_finite(&triangles[c])) {
            ++bad;
            continue;
        }
        for (size_t k = 0; k < 3; ++k) group.triangles.push_back(placed.first + triangles[c + k]);
    }
    if (bad)
        report(Code::GLTF_TRIANGLES, pointer + "/attributes/POSITION", bad,
               "some of their vertices are not finite");
    placed.usable = true;
    if (group.triangles.empty()) return;
    std::vector<float> tangents = add_attributes(from, placed, pointer, group);
    bool has_normals = std::any_of(group.attributes.begin(), group.attributes.end(),
                                   [](const VertexAttribute& a) { return a.semantic == "NORMAL"; });
    if (!has_normals && charge(group.triangles.size() * 8, pointer))
        group.attributes.push_back(flat_normals(definition.positions, group.triangles));
    if (!tangents.empty() && charge(group.triangles.size() * 24, pointer))
        add_tangents(definition.positions, placed.first, tangents, group);
    int material = from.material;
    if (material >= 0 &&
        !exists(material, model_.materials.size(), "material", pointer + "/material"))
        material = -1;
    group.symbol = std::to_string(material >= 0 ? size_t(material) : model_.materials.size());
    placed.group = uint32_t(definition.groups.size());
    definition.groups.push_back(std::move(group));
}

// What a node wears: its mesh, the materials of all its groups, skin and morph.
MeshUse GltfImport::mesh_use(uint32_t node) {
    const tinygltf::Node& from = model_.nodes[node];
    MeshUse use;
    use.mesh = uint32_t(from.mesh);
    for (const PrimitiveGroup& group : out_.meshes[use.mesh].groups) {
        bool known = std::any_of(use.materials.begin(), use.materials.end(),
                                 [&](const MaterialUse& m) { return m.symbol == group.symbol; });
        if (known) continue;
        MaterialUse& material = use.materials.emplace_back();
        material.symbol = group.symbol;
        material.material = uint32_t(std::stoul(group.symbol));
        for (uint32_t set = 0; set < 8; ++set)
            material.vertex_bindings.push_back({fmt::format("TEXCOORD_{}", set), "TEXCOORD", set});
        if (auto inputs = inputs_.find(material.material); inputs != inputs_.end())
            material.vertex_bindings.insert(material.vertex_bindings.end(), inputs->second.begin(),
                                            inputs->second.end());
    }
    if (plans_[use.mesh].targets) use.morph = node_morphs_[node] = morph_of(use.mesh, node);
    if (from.skin < 0) return use;
    std::string pointer = fmt::format("/nodes/{}/skin", node);
    if (!exists(from.skin, model_.skins.size(), "skin", pointer)) return use;
    use.skin = skin_of(use.mesh, uint32_t(from.skin));
    for (int joint : model_.skins[size_t(from.skin)].joints) {
        bool there = joint >= 0 && size_t(joint) < model_.nodes.size() && shown_[size_t(joint)];
        use.joint_nodes.push_back(there ? uint32_t(joint) : kNone);
    }
    return use;
}

}  // namespace kinora
