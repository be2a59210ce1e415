// runtime/dae/export_mesh.cpp: geometries and controllers.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/dae/export_p.h"
#include "runtime/description/display_color.h"

namespace kinora {

namespace {

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

std::string input(const char* semantic, const std::string& source, int offset = -1,
                  uint32_t set = kNone) {
    std::string attributes = attribute("semantic", semantic) + attribute("source", "#" + source);
    if (offset >= 0) attributes += attribute("offset", std::to_string(offset));
    if (set != kNone) attributes += attribute("set", std::to_string(set));
    return "<input" + attributes + "/>";
}

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
        dvec3 display = display_of_linear({v[0], v[1], v[2]});
        for (int k = 0; k < 3; ++k) v[k] = float(display[k]);
    }
    return numbers;
}

std::string ColladaExporter::geometry(uint32_t index) {
    const MeshDefinition& mesh = description_.meshes[index];
    const MeshDefinition& shape = with_triangles(index);
    const std::string& own = mesh_ids_[index];
    std::vector<double> positions;
    for (const dvec3& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    std::string sources = float_source(own + "-positions", number_text(positions),
                                       mesh.positions.size(), {"X", "Y", "Z"});
    std::string groups;
    for (size_t g = 0; g < mesh.groups.size(); ++g) {
        const PrimitiveGroup& group = mesh.groups[g];
        const PrimitiveGroup& whole =
            group.triangles.empty() && g < shape.groups.size() ? shape.groups[g] : group;
        if (whole.triangles.empty()) continue;
        std::vector<const std::vector<uint32_t>*> lists{&whole.triangles};
        std::string inputs = input("VERTEX", own + "-vertices", 0);
        for (size_t a = 0; a < group.attributes.size(); ++a) {
            const VertexAttribute& values = group.attributes[a];
            // glTF's TANGENT is there as the numbers that shaders read (import_gltf_tangent).
            if (values.stride == 0 || is_gltf_tangent(values) || values.semantic == kLinearColor)
                continue;
            std::string source = fmt::format("{}-{}-{}{}", own, g, values.semantic, a);
            bool by_rsl = rsl_groups_.contains({index, group.symbol});
            sources += float_source(source, number_text(numbers_of(values, by_rsl)),
                                    values.values.size() / values.stride,
                                    param_names(values.semantic, values.stride));
            auto same = std::find_if(lists.begin(), lists.end(),
                                     [&](auto* list) { return *list == values.corners; });
            int offset = int(same - lists.begin());
            if (same == lists.end()) lists.push_back(&values.corners);
            bool sets = values.semantic == "TEXCOORD" || values.semantic == "COLOR";
            inputs += input(values.semantic.c_str(), source, offset, sets ? values.set : kNone);
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
        targets_[morph.weights.offset + i] = {fmt::format("{}-weights({})", own, i)};
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
    for (size_t v = 0; v + 1 < skin.offsets.size(); ++v)
        counts += fmt::format("{} ", skin.offsets[v + 1] - skin.offsets[v]);
    for (size_t i = 0; i < skin.joints.size(); ++i)
        pairs += fmt::format("{} {} ", skin.joints[i], i);
    std::string content =
        xml("bind_shape_matrix", "", matrix_rows(skin.bind_shape)) +
        fmt::format(
            "<source id=\"{0}-joints\"><Name_array id=\"{0}-joints-array\" "
            "count=\"{1}\">{2}</Name_array><technique_common><accessor "
            "source=\"#{0}-joints-array\" count=\"{1}\" stride=\"1\"><param "
            "name=\"JOINT\" type=\"name\"/></accessor></technique_common></source>",
            own, count, names) +
        float_source(own + "-binds", number_text(matrices), count, {"TRANSFORM"}, "float4x4") +
        float_source(own + "-weights", number_text(skin.weights), skin.weights.size(), {"WEIGHT"}) +
        xml("joints", "",
            input("JOINT", own + "-joints") + input("INV_BIND_MATRIX", own + "-binds")) +
        xml("vertex_weights", attribute("count", std::to_string(skin.offsets.size() - 1)),
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
