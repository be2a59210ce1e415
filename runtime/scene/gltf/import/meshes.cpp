// runtime/scene/gltf/import/meshes.cpp: glTF's meshes: each primitive a group with its own
// vertices.
#include "runtime/scene/gltf/import/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/import/attribute_name.h"
#include "runtime/scene/gltf/import/tangents.h"

namespace kinora {

namespace {

constexpr uint32_t kPoint[] = {3}, kTangent[] = {4}, kTexcoord[] = {2}, kColor[] = {3, 4},
                   kAny[] = {1, 2, 3, 4};

constexpr std::string_view kPacking[] = {"KHR_draco_mesh_compression"};

constexpr const char* kModes[] = {"points",    "lines",           "line loops",   "line strips",
                                  "triangles", "triangle strips", "triangle fans"};

// The corners of all triangles, three each, as positions in the list of vertices
// (glTF 2.0, 3.7.2.1).
std::array<size_t, 3> corners_of(int mode, size_t triangle) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        return {triangle, triangle + 1 + triangle % 2, triangle + 2 - triangle % 2};
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {triangle + 1, triangle + 2, 0};
    return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
}

}  // namespace

MeshImporter::MeshImporter(const tinygltf::Model& model, AccessorReader& accessors,
                           GltfReport& report, ByteBudget& budget,
                           std::vector<MeshDefinition>& meshes)
    : model_(model),
      accessors_(accessors),
      report_(report),
      budget_(budget),
      meshes_(meshes),
      vertices_(model.meshes.size()) {
    meshes_.resize(model.meshes.size());
}

void MeshImporter::import_meshes(const std::vector<bool>& used, UniqueIds& ids) {
    std::vector<Location> places = report_.locations("/meshes", model_.meshes.size());
    for (uint32_t m = 0; m < model_.meshes.size(); ++m) {
        const tinygltf::Mesh& from = model_.meshes[m];
        MeshDefinition& to = meshes_[m];
        to.name = from.name;
        to.id = ids.id(from.name, "mesh", m);
        to.where = places[m];
        vertices_[m].resize(from.primitives.size());
        if (!used[m]) continue;
        for (uint32_t p = 0; p < from.primitives.size(); ++p) import_primitive(m, p);
    }
}

namespace {

// Accessors of all that moves vertices.
std::vector<int> moving_accessors(const tinygltf::Primitive& primitive) {
    std::vector<int> accessors;
    for (const auto& [name, accessor] : primitive.attributes)
        if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))
            accessors.push_back(accessor);
    for (const auto& target : primitive.targets)
        for (const auto& [name, accessor] : target) accessors.push_back(accessor);
    return accessors;
}

}  // namespace

// Primitives that share all that moves vertices share their positions.
bool MeshImporter::find_vertices(uint32_t mesh, uint32_t primitive, const std::string& pointer) {
    const std::vector<tinygltf::Primitive>& from = model_.meshes[mesh].primitives;
    PrimitiveVertices& vertices = vertices_[mesh][primitive];
    for (uint32_t other = 0; other < primitive; ++other) {
        const PrimitiveVertices& known = vertices_[mesh][other];
        if (!known.usable || moving_accessors(from[other]) != moving_accessors(from[primitive]))
            continue;
        vertices.first = known.first;
        vertices.count = known.count;
        return true;
    }
    const auto& attributes = from[primitive].attributes;
    auto position = attributes.find("POSITION");
    if (position != attributes.end())
        return read_positions(position->second, pointer + "/attributes/POSITION", vertices,
                              meshes_[mesh].positions);
    report_.add(Code::GLTF_PRIMITIVE, pointer, "it has no POSITION");
    return false;
}

// Appends them.
bool MeshImporter::read_positions(int accessor, const std::string& pointer,
                                  PrimitiveVertices& vertices, std::vector<dvec3>& positions) {
    AccessorNumbers numbers;
    if (!accessors_.read(accessor, numbers)) return false;
    if (numbers.width != 3) {
        report_.add(Code::GLTF_PRIMITIVE, pointer, "positions have three numbers");
        return false;
    }
    size_t count = numbers.count();
    if (positions.size() + count > kNone || !budget_.charge(count * sizeof(dvec3), pointer))
        return false;
    vertices.first = uint32_t(positions.size());
    vertices.count = uint32_t(count);
    for (size_t i = 0; i < count; ++i)
        positions.emplace_back(numbers.values[3 * i], numbers.values[3 * i + 1],
                               numbers.values[3 * i + 2]);
    return true;
}

// Corners that count from the primitive's first vertex.
std::vector<uint32_t> MeshImporter::triangles_of(const tinygltf::Primitive& primitive,
                                                 uint32_t vertices, const std::string& pointer) {
    std::vector<uint32_t> indices;
    bool indexed = primitive.indices >= 0;
    if (indexed && !accessors_.read_indices(primitive.indices, indices)) return {};
    size_t listed = indexed ? indices.size() : vertices;
    bool apart = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    size_t count = apart ? listed / 3 : listed < 3 ? 0 : listed - 2;
    std::vector<uint32_t> triangles;
    if (!budget_.charge(count * 3 * sizeof(uint32_t), pointer)) return {};
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
        report_.add(Code::GLTF_TRIANGLES, pointer + "/indices", beyond,
                    fmt::format("they name vertices beyond the {} there are", vertices));
    if (apart && listed % 3)
        report_.add(Code::GLTF_VALUE, pointer + "/indices",
                    fmt::format("{} corners make no whole triangles; the last {} are left out",
                                listed, listed % 3));
    return triangles;
}

// Returns the primitive's tangents, four numbers a vertex, where its material wants them.
std::vector<float> MeshImporter::add_attributes(const tinygltf::Primitive& primitive,
                                                const PrimitiveVertices& vertices,
                                                const std::string& pointer, PrimitiveGroup& group) {
    std::vector<uint32_t> corners = group.triangles;
    for (uint32_t& c : corners) c -= vertices.first;
    auto add = [&](std::string semantic, uint32_t set, uint32_t stride, std::vector<float> values) {
        if (!budget_.charge(corners.size() * sizeof(uint32_t), pointer)) return;
        group.attributes.push_back({std::move(semantic), set, stride, std::move(values), corners});
    };
    AccessorNumbers numbers;
    std::vector<float> tangents;
    for (const auto& [name, accessor] : primitive.attributes) {
        std::string own_pointer = pointer + "/attributes/" + name;
        AttributeName of_set = numbered_attribute(name);
        auto read = [&](std::span<const uint32_t> widths) {
            return accessors_.read_vertices(accessor, widths, vertices.count, own_pointer, numbers);
        };
        if (name == "NORMAL") {
            if (read(kPoint)) add("NORMAL", 0, 3, std::move(numbers.values));
        } else if (name == "TANGENT") {
            // Only a map of normals asks for them.
            int m = primitive.material;
            bool bent = m >= 0 && size_t(m) < model_.materials.size() &&
                        model_.materials[size_t(m)].normalTexture.index >= 0;
            // Without normals they are ignored (glTF 2.0, 3.7.2.1). NORMAL was read before.
            bool smooth = std::any_of(group.attributes.begin(), group.attributes.end(),
                                      [](const auto& a) { return a.semantic == "NORMAL"; });
            if (!bent || !smooth || !read(kTangent)) continue;
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
            AttributeName own = own_attribute(name);
            add(std::move(own.name), own.set, numbers.width, std::move(numbers.values));
        }
    }
    return tangents;
}

// Those whose corners are all finite, counted from the mesh's first vertex.
std::vector<uint32_t> MeshImporter::finite_triangles(const std::vector<uint32_t>& triangles,
                                                     uint32_t first,
                                                     const std::vector<dvec3>& positions,
                                                     const std::string& pointer) {
    auto not_finite = [&](const uint32_t* corner) {
        for (int k = 0; k < 3; ++k) {
            const dvec3& p = positions[first + corner[k]];
            if (!std::isfinite(p.x + p.y + p.z)) return true;
        }
        return false;
    };
    std::vector<uint32_t> finite;
    size_t bad = 0;
    for (size_t c = 0; c + 2 < triangles.size(); c += 3) {
        if (not_finite(&triangles[c])) {
            ++bad;
            continue;
        }
        for (size_t k = 0; k < 3; ++k) finite.push_back(first + triangles[c + k]);
    }
    if (bad)
        report_.add(Code::GLTF_TRIANGLES, pointer + "/attributes/POSITION", bad,
                    "some of their vertices are not finite");
    return finite;
}

// The extension that holds a primitive's numbers in place of its accessors: one that stands beside
// them leaves them whole.
std::string_view MeshImporter::packed_by(const tinygltf::Primitive& primitive) const {
    auto position = primitive.attributes.find("POSITION");
    bool whole = position != primitive.attributes.end() && position->second >= 0 &&
                 size_t(position->second) < model_.accessors.size() &&
                 model_.accessors[size_t(position->second)].bufferView >= 0;
    for (std::string_view extension : kPacking)
        if (!whole && primitive.extensions.contains(std::string(extension))) return extension;
    return "";
}

void MeshImporter::import_primitive(uint32_t mesh, uint32_t index) {
    const tinygltf::Primitive& from = model_.meshes[mesh].primitives[index];
    PrimitiveVertices& vertices = vertices_[mesh][index];
    std::string pointer = fmt::format("/meshes/{}/primitives/{}", mesh, index);
    int mode = from.mode < 0 ? TINYGLTF_MODE_TRIANGLES : from.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        report_.add(Code::GLTF_NOT_SHADED, pointer, kModes[mode]);
        return;
    }
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        report_.add(Code::GLTF_PRIMITIVE, pointer + "/mode", fmt::format("{} is no mode", mode));
        return;
    }
    if (std::string_view extension = packed_by(from); !extension.empty()) {
        report_.add(Code::GLTF_PRIMITIVE, pointer,
                    fmt::format("{} packs it, which is not supported", extension));
        return;
    }
    if (!find_vertices(mesh, index, pointer)) return;
    MeshDefinition& definition = meshes_[mesh];
    tinygltf::Primitive sound = from;
    sound.mode = mode;
    std::vector<uint32_t> triangles = triangles_of(sound, vertices.count, pointer);
    PrimitiveGroup group;
    group.triangles = finite_triangles(triangles, vertices.first, definition.positions, pointer);
    vertices.usable = true;
    if (group.triangles.empty()) return;
    std::vector<float> tangents = add_attributes(from, vertices, pointer, group);
    if (!tangents.empty() && budget_.charge(group.triangles.size() * 24, pointer))
        add_tangents(definition.positions, vertices.first, tangents, group);
    int material = from.material;
    if (!has_index(material, model_.materials.size())) material = -1;
    group.symbol = std::to_string(material >= 0 ? size_t(material) : model_.materials.size());
    vertices.group = uint32_t(definition.groups.size());
    definition.groups.push_back(std::move(group));
}

}  // namespace kinora
