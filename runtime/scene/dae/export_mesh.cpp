// runtime/scene/dae/export_mesh.cpp: geometries and controllers.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <unordered_map>

#include "runtime/scene/dae/export_p.h"
#include "runtime/scene/description/display_color.h"

namespace kinora {

namespace {

constexpr double kHalfFloatStep = 3e-8;  // relative: a float that is read as itself

std::vector<std::string> param_names(const std::string& semantic, uint32_t stride) {
    static const std::vector<std::string> kSt = {"S", "T", "P", "Q"}, kRgb = {"R", "G", "B", "A"},
                                          kXyz = {"X", "Y", "Z", "W"};
    const std::vector<std::string>& all = semantic == "TEXCOORD" ? kSt
                                          : semantic == "COLOR"  ? kRgb
                                                                 : kXyz;
    std::vector<std::string> names;
    for (uint32_t i = 0; i < stride; ++i)
        names.push_back(i < all.size() ? all[i] : fmt::format("N{}", i));
    return names;
}

std::string index_text(const std::vector<const std::vector<uint32_t>*>& lists) {
    fmt::memory_buffer text;
    for (size_t c = 0; c < lists[0]->size(); ++c)
        for (const std::vector<uint32_t>* list : lists)
            fmt::format_to(std::back_inserter(text), "{} ", (*list)[c]);
    return fmt::to_string(text);
}

std::string matrix_rows(const dmat4& m) {
    std::vector<double> rows;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) rows.push_back(m[c][r]);
    return number_text(rows);
}

template <class T>
std::string bytes_of(const T* values, size_t count) {
    return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

// The values of one input of a mesh, of all its groups.
struct AttributeTable {
    std::string semantic, source;
    uint32_t set, stride;
    size_t group;
    bool by_rsl;
    std::vector<float> values;
    std::unordered_map<std::string, uint32_t> known;

    // Entries of the corners among the numbers; each different value stands once if `once`.
    std::vector<uint32_t> add(const VertexAttribute& a, const std::vector<float>& numbers,
                              bool once) {
        if (!once) {
            values = numbers;
            return a.corners;
        }
        std::vector<uint32_t> corners;
        for (uint32_t c : a.corners) {
            const float* v = &numbers[size_t(c) * stride];
            auto [entry, fresh] = known.try_emplace(bytes_of(v, stride), uint32_t(known.size()));
            if (fresh) values.insert(values.end(), v, v + stride);
            corners.push_back(entry->second);
        }
        return corners;
    }
};

AttributeTable& table_of(std::deque<AttributeTable>& tables, const VertexAttribute& a, size_t group,
                         bool by_rsl) {
    for (AttributeTable& t : tables)
        if (t.semantic == a.semantic && t.set == a.set && t.stride == a.stride &&
            t.group == group && t.by_rsl == by_rsl)
            return t;
    return tables.emplace_back(
        AttributeTable{a.semantic, "", a.set, a.stride, group, by_rsl, {}, {}});
}

struct GroupInput {
    const AttributeTable* table;
    std::vector<uint32_t> corners;
};

bool is_gltf_tangent(const VertexAttribute& a) {
    return a.semantic == "TANGENT" && a.stride == 4;
}

}  // namespace

// A morph target without triangles (glTF's) has those of the mesh it changes.
const MeshDefinition& ColladaExporter::with_triangles(uint32_t mesh) const {
    for (const NodeDefinition& node : description_.nodes)
        for (const MeshUse& use : node.meshes) {
            if (use.morph == kNone) continue;
            const std::vector<uint32_t>& targets = description_.morphs[use.morph].targets;
            if (std::find(targets.begin(), targets.end(), mesh) != targets.end())
                return description_.meshes[use.mesh];
        }
    return description_.meshes[mesh];
}

// The numbers of an attribute. What RSL reads stands as it is; other vertex colours are display
// colours, as those of profile_COMMON.
std::vector<float> ColladaExporter::numbers_of(const VertexAttribute& values, bool by_rsl) const {
    std::vector<float> numbers = values.values;
    if (by_rsl || values.semantic != "COLOR" || values.stride < 3) return numbers;
    for (size_t i = 0; i + values.stride <= numbers.size(); i += values.stride) {
        float* v = &numbers[i];
        dvec3 display = short_display_color({v[0], v[1], v[2]}, kHalfFloatStep);
        for (int k = 0; k < 3; ++k) v[k] = float(display[k]);
    }
    return numbers;
}

std::vector<uint32_t> MergedVertices::kept(size_t count) const {
    if (!first.empty()) return first;
    std::vector<uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

// Meshes whose geometry is shorter so. A morph's targets have the vertices of its base.
void ColladaExporter::merge_vertices() {
    size_t count = description_.meshes.size();
    merged_.assign(count, {});
    std::vector<std::set<uint32_t>> targets(count), skins(count), bases(count);
    for (const NodeDefinition& node : description_.nodes)
        for (const MeshUse& use : node.meshes) {
            if (use.skin != kNone) skins[use.mesh].insert(use.skin);
            if (use.morph == kNone) continue;
            for (uint32_t t : description_.morphs[use.morph].targets)
                targets[use.mesh].insert(t), bases[t].insert(use.mesh);
        }
    for (uint32_t m = 0; m < count; ++m) {
        const MeshDefinition& mesh = description_.meshes[m];
        size_t positions = mesh.positions.size();
        bool alone = bases[m].empty() && positions > 0;
        for (uint32_t t : targets[m])
            alone &= bases[t].size() == 1 && description_.meshes[t].positions.size() == positions;
        for (uint32_t s : skins[m]) alone &= description_.skins[s].offsets.size() == positions + 1;
        // Normals that would be made of the mesh are other ones.
        for (const PrimitiveGroup& group : mesh.groups)
            alone &= std::any_of(group.attributes.begin(), group.attributes.end(),
                                 [](const VertexAttribute& a) { return a.semantic == "NORMAL"; });
        if (!alone) continue;
        MergedVertices merged;
        std::unordered_map<std::string, uint32_t> known;
        for (uint32_t p = 0; p < positions; ++p) {
            std::string key = bytes_of(&mesh.positions[p], 1);
            for (uint32_t t : targets[m]) key += bytes_of(&description_.meshes[t].positions[p], 1);
            for (uint32_t s : skins[m]) {
                const SkinDefinition& skin = description_.skins[s];
                size_t begin = skin.offsets[p], n = skin.offsets[p + 1] - begin;
                key += bytes_of(&skin.joints[begin], n) + bytes_of(&skin.weights[begin], n);
                key += '|';
            }
            auto [vertex, fresh] = known.try_emplace(std::move(key), uint32_t(known.size()));
            if (fresh) merged.first.push_back(p);
            merged.vertex.push_back(vertex->second);
        }
        size_t together = geometry(m).size();
        merged_[m] = std::move(merged);
        if (geometry(m).size() >= together)
            merged_[m] = {};
        else
            for (uint32_t t : targets[m]) merged_[t] = merged_[m];
    }
}

std::string ColladaExporter::geometry(uint32_t index) {
    const MeshDefinition& mesh = description_.meshes[index];
    const MeshDefinition& shape = with_triangles(index);
    const std::string& own = mesh_ids_[index];
    const MergedVertices& merged = merged_[index];
    std::vector<double> positions;
    for (uint32_t p : merged.kept(mesh.positions.size())) {
        const dvec3& v = mesh.positions[p];
        positions.insert(positions.end(), {v.x, v.y, v.z});
    }
    std::string sources = float_source(own + "-positions", number_text(positions),
                                       positions.size() / 3, {"X", "Y", "Z"});
    std::deque<AttributeTable> tables;
    std::vector<std::vector<GroupInput>> inputs_of(mesh.groups.size());
    for (size_t g = 0; g < mesh.groups.size(); ++g)
        for (const VertexAttribute& a : mesh.groups[g].attributes) {
            // glTF's TANGENT is there as the numbers that shaders read (import_gltf_tangent).
            if (a.stride == 0 || is_gltf_tangent(a) || a.semantic == kLinearColor) continue;
            bool by_rsl = rsl_groups_.contains({index, mesh.groups[g].symbol});
            bool together = !merged.vertex.empty();
            AttributeTable& table = table_of(tables, a, together ? 0 : g, by_rsl);
            inputs_of[g].push_back({&table, table.add(a, numbers_of(a, by_rsl), together)});
        }
    // Equal arrays are one source.
    for (size_t t = 0; t < tables.size(); ++t) {
        for (size_t other = 0; other < t && tables[t].source.empty(); ++other)
            if (tables[other].semantic == tables[t].semantic &&
                tables[other].stride == tables[t].stride &&
                tables[other].values == tables[t].values)
                tables[t].source = tables[other].source;
        if (!tables[t].source.empty()) continue;
        tables[t].source = fmt::format("{}-{}{}", own, tables[t].semantic, t);
        sources += float_source(tables[t].source, number_text(tables[t].values),
                                tables[t].values.size() / tables[t].stride,
                                param_names(tables[t].semantic, tables[t].stride));
    }
    std::string groups;
    for (size_t g = 0; g < mesh.groups.size(); ++g) {
        const PrimitiveGroup& group = mesh.groups[g];
        const PrimitiveGroup& whole =
            group.triangles.empty() && g < shape.groups.size() ? shape.groups[g] : group;
        if (whole.triangles.empty()) continue;
        std::vector<uint32_t> corners;
        for (uint32_t p : whole.triangles) corners.push_back(merged.of(p));
        std::vector<const std::vector<uint32_t>*> lists{&corners};
        std::string inputs = input("VERTEX", own + "-vertices", 0);
        for (const GroupInput& i : inputs_of[g]) {
            auto same = std::find_if(lists.begin(), lists.end(),
                                     [&](auto* list) { return *list == i.corners; });
            int offset = int(same - lists.begin());
            if (same == lists.end()) lists.push_back(&i.corners);
            const std::string& semantic = i.table->semantic;
            bool sets = semantic == "TEXCOORD" || semantic == "COLOR";
            inputs += input(semantic.c_str(), i.table->source, offset, sets ? i.table->set : kNone);
        }
        groups += xml("triangles",
                      attribute("count", std::to_string(whole.triangles.size() / 3)) +
                          attribute("material", xml_name(whole.symbol)),
                      inputs + xml("p", "", index_text(lists)));
    }
    std::string vertices =
        xml("vertices", attribute("id", own + "-vertices"), input("POSITION", own + "-positions"));
    std::string attributes = attribute("id", own);
    if (!mesh.name.empty()) attributes += attribute("name", xml_name(mesh.name));
    std::string extra;
    if (!mesh.double_sided)
        extra =
            "<extra><technique profile=\"MAYA\"><double_sided>0</double_sided></technique>"
            "</extra>";
    return xml("geometry", attributes, xml("mesh", "", sources + vertices + groups) + extra);
}

std::string ColladaExporter::morph(uint32_t index, uint32_t mesh) {
    auto [found, fresh] = morph_ids_.try_emplace(index);
    if (!fresh) return found->second;
    const MorphDefinition& morph = description_.morphs[index];
    std::string own = found->second = id(morph.id, "morph");
    std::string targets;
    for (uint32_t t : morph.targets) targets += mesh_ids_[t] + " ";
    size_t count = morph.targets.size();
    std::string sources =
        fmt::format(
            "<source id=\"{0}-targets\"><IDREF_array id=\"{0}-targets-array\" "
            "count=\"{1}\">{2}</IDREF_array><technique_common><accessor "
            "source=\"#{0}-targets-array\" count=\"{1}\" stride=\"1\"><param "
            "name=\"IDREF\" type=\"IDREF\"/></accessor></technique_common></source>",
            own, count, targets) +
        float_source(own + "-weights", number_text(values(morph.weights)), count, {"WEIGHT"});
    for (uint32_t i = 0; i < count; ++i)
        animation_.name({morph.weights.offset + i, 1}, fmt::format("{}-weights({})", own, i),
                        nullptr);
    controllers_ += xml("controller", attribute("id", own),
                        xml("morph",
                            attribute("method", morph.relative ? "RELATIVE" : "NORMALIZED") +
                                attribute("source", "#" + mesh_ids_[mesh]),
                            sources + xml("targets", "",
                                          input("MORPH_TARGET", own + "-targets") +
                                              input("MORPH_WEIGHT", own + "-weights"))));
    return own;
}

std::string ColladaExporter::skin(const MeshUse& use, const std::string& source) {
    const SkinDefinition& skin = description_.skins[use.skin];
    std::string own = id(skin.id, "skin"), names, pairs, counts;
    std::vector<double> matrices;
    size_t count = skin.inverse_bind.size();
    for (size_t j = 0; j < count; ++j) {
        uint32_t joint = j < use.joint_nodes.size() ? use.joint_nodes[j] : kNone;
        names += (joint == kNone ? own + "-none" : node_ids_[joint]) + " ";
        for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 4; ++c) matrices.push_back(skin.inverse_bind[j][c][r]);
    }
    std::vector<uint32_t> vertices = merged_[use.mesh].kept(skin.offsets.size() - 1);
    std::vector<float> weights;  // each once
    std::unordered_map<float, uint32_t> known;
    for (uint32_t v : vertices) {
        counts += fmt::format("{} ", skin.offsets[v + 1] - skin.offsets[v]);
        for (uint32_t i = skin.offsets[v]; i < skin.offsets[v + 1]; ++i) {
            auto [entry, fresh] = known.try_emplace(skin.weights[i], uint32_t(known.size()));
            if (fresh) weights.push_back(skin.weights[i]);
            pairs += fmt::format("{} {} ", skin.joints[i], entry->second);
        }
    }
    std::string content =
        xml("bind_shape_matrix", "", matrix_rows(skin.bind_shape)) +
        fmt::format(
            "<source id=\"{0}-joints\"><Name_array id=\"{0}-joints-array\" "
            "count=\"{1}\">{2}</Name_array><technique_common><accessor "
            "source=\"#{0}-joints-array\" count=\"{1}\" stride=\"1\"><param "
            "name=\"JOINT\" type=\"name\"/></accessor></technique_common></source>",
            own, count, names) +
        float_source(own + "-binds", number_text(matrices), count, {"TRANSFORM"}, "float4x4") +
        float_source(own + "-weights", number_text(weights), weights.size(), {"WEIGHT"}) +
        xml("joints", "",
            input("JOINT", own + "-joints") + input("INV_BIND_MATRIX", own + "-binds")) +
        xml("vertex_weights", attribute("count", std::to_string(vertices.size())),
            input("JOINT", own + "-joints", 0) + input("WEIGHT", own + "-weights", 1) +
                xml("vcount", "", counts) + xml("v", "", pairs));
    controllers_ += xml("controller", attribute("id", own),
                        xml("skin", attribute("source", "#" + source), content));
    return own;
}

std::string ColladaExporter::controller(const MeshUse& use) {
    std::string key = fmt::format("{} {} {} ", use.mesh, use.morph, use.skin);
    for (uint32_t joint : use.joint_nodes) key += fmt::format("{} ", joint);
    auto [found, fresh] = controller_ids_.try_emplace(key);
    if (!fresh) return found->second;
    std::string source = mesh_ids_[use.mesh];
    if (use.morph != kNone) source = morph(use.morph, use.mesh);
    if (use.skin != kNone) source = skin(use, source);
    return found->second = source;
}

}  // namespace kinora
