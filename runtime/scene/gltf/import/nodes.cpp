// runtime/scene/gltf/import/nodes.cpp: glTF's nodes with what hangs on them.
#include "runtime/scene/gltf/import/nodes.h"
#include "runtime/base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/import/extras.h"
#include "runtime/scene/gltf/import/values.h"

namespace kinora {

namespace {

constexpr size_t kRoom = 16;  // values that a transform has to itself
constexpr uint8_t kMovesTransform = kMovesTranslation | kMovesRotation | kMovesScale;

bool all_finite(std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

NodeImporter::NodeImporter(const tinygltf::Model& model, const GltfNodeTree& tree,
                           const std::vector<uint8_t>& moving, int axes_node,
                           const MaterialImporter& materials, MorphImporter& morphs,
                           SkinImporter& skins, GltfReport& report, SceneDescription& out)
    : model_(model),
      tree_(tree),
      moving_(moving),
      axes_node_(axes_node),
      materials_(materials),
      morphs_(morphs),
      skins_(skins),
      report_(report),
      out_(out),
      slots_(model.nodes.size()) {}

bool NodeImporter::usable(const std::vector<double>& numbers, size_t count, uint32_t node,
                          const char* name) {
    if (numbers.empty()) return false;
    if (numbers.size() == count && all_finite(numbers)) return true;
    report_.add(Code::GLTF_VALUE, fmt::format("/nodes/{}/{}", node, name),
                fmt::format("'{}' is not {} finite numbers; it is left out", name, count));
    return false;
}

bool NodeImporter::usable_matrix(uint32_t node) {
    if (!usable(model_.nodes[node].matrix, 16, node, "matrix")) return false;
    if (std::ranges::all_of(model_.nodes[node].matrix, [](double n) { return n == 0; }))
        report_.add(Code::GLTF_NODE, fmt::format("/nodes/{}/matrix", node), node,
                    "its matrix is all zeros; everything below it lies in one point");
    if (!(moving_[node] & kMovesTransform)) return true;
    report_.add(Code::GLTF_NODE, fmt::format("/nodes/{}/matrix", node), node,
                "it is animated; only translation, rotation and scale can be, its matrix is left "
                "out");
    return false;
}

void NodeImporter::import_transforms(uint32_t node) {
    if (int(node) == axes_node_) return;
    const tinygltf::Node& from = model_.nodes[node];
    NodeDefinition& to = out_.nodes[node];
    if (usable_matrix(node)) {
        double rows[16];  // columns there, rows in our documents' order
        for (size_t k = 0; k < 16; ++k) rows[k % 4 * 4 + k / 4] = from.matrix[k];
        to.transforms.push_back({TransformKind::Matrix, append_values(out_.values, rows, kRoom)});
        return;
    }
    auto add = [&](TransformKind kind, const std::vector<double>& numbers, const char* name,
                   std::span<const double> rest, bool moves, uint32_t& slot) {
        bool given = usable(numbers, rest.size(), node, name);
        if (!given && !moves) return;
        slot = append_values(out_.values, given ? std::span<const double>(numbers) : rest, kRoom);
        to.transforms.push_back({kind, slot});
    };
    constexpr double kNoTranslation[] = {0, 0, 0}, kNoRotation[] = {0, 0, 0, 1},
                     kNoScale[] = {1, 1, 1};
    NodeSlots& slots = slots_[node];
    add(TransformKind::Translate, from.translation, "translation", kNoTranslation,
        moving_[node] & kMovesTranslation, slots.translation);
    add(TransformKind::Quaternion, from.rotation, "rotation", kNoRotation,
        moving_[node] & kMovesRotation, slots.rotation);
    add(TransformKind::Scale, from.scale, "scale", kNoScale, moving_[node] & kMovesScale,
        slots.scale);
}

void NodeImporter::import_nodes(UniqueIds& ids) {
    out_.nodes.resize(model_.nodes.size());
    std::vector<Location> places = report_.locations("/nodes", model_.nodes.size());
    for (uint32_t n = 0; n < model_.nodes.size(); ++n) {
        if (!tree_.shown[n]) continue;
        const tinygltf::Node& from = model_.nodes[n];
        NodeDefinition& to = out_.nodes[n];
        to.name = from.name;
        to.id = ids.id(from.name, "node", n);
        to.where = places[n];
        import_transforms(n);
        import_attributes(from.extras, to);
        import_visibility(n);
        for (uint32_t child : tree_.children[n]) to.children.push_back({child, dmat4(1.0)});
        import_content(n);
    }
    for (int root : tree_.roots) {
        if (root < 0) continue;
        NodeDefinition& node = out_.nodes[uint32_t(root)];
        bool bare = node.meshes.empty() && node.lights.empty() && node.cameras.empty() &&
                    node.attributes.empty();
        // The node that kinora-convert put around the scene for other readers is not there.
        if (root == axes_node_ && bare) {
            out_.roots.insert(out_.roots.end(), node.children.begin(), node.children.end());
            node = {};
        } else {
            out_.roots.push_back({uint32_t(root), dmat4(1.0)});
        }
    }
    // A file in which all is hidden is looked at nevertheless, as in COLLADA.
    if (!shows_a_mesh(out_))
        for (NodeDefinition& node : out_.nodes) node.invisible = false;
}

// KHR_node_visibility: a node that is not visible is hidden with all below it.
void NodeImporter::import_visibility(uint32_t node) {
    const auto& extensions = model_.nodes[node].extensions;
    auto found = extensions.find("KHR_node_visibility");
    if (found == extensions.end()) return;
    const tinygltf::Value* visible = member(found->second, "visible");
    if (!visible || !visible->IsBool() || visible->Get<bool>()) return;
    out_.nodes[node].invisible = true;
    report_.add(Code::GLTF_HIDDEN, fmt::format("/nodes/{}/extensions/KHR_node_visibility", node),
                node);
}

// Its camera, light and mesh.
void NodeImporter::import_content(uint32_t node) {
    const tinygltf::Node& from = model_.nodes[node];
    NodeDefinition& to = out_.nodes[node];
    std::string pointer = fmt::format("/nodes/{}", node);
    if (has_index(from.camera, model_.cameras.size())) to.cameras.push_back(uint32_t(from.camera));
    if (auto light = from.extensions.find("KHR_lights_punctual");
        light != from.extensions.end() && light->second.Has("light")) {
        int index = light->second.Get("light").GetNumberAsInt();
        if (has_index(index, model_.lights.size())) to.lights.push_back(uint32_t(index));
    }
    if (has_index(from.mesh, model_.meshes.size())) to.meshes.push_back(mesh_use(node));
}

// Maps on coordinates that a group lacks take those of its lowest set (texture_coordinates()).
void NodeImporter::report_missing_sets(uint32_t mesh, const PrimitiveGroup& from,
                                       const MaterialUse& use) {
    const VertexAttribute* lowest = find_attribute(from, "TEXCOORD");
    if (!lowest) return;
    for (const ShaderUse& shader : out_.materials[use.material].surfaces)
        for (const ParamSource& source : shader.params) {
            if (source.texcoord.empty()) continue;
            const VertexBinding* bound = find_binding(&use, source.texcoord);
            if (!bound || find_attribute(from, bound->semantic, bound->set)) continue;
            if (told_sets_.insert({mesh, use.material}).second)
                report_.add(Code::GLTF_VALUE, fmt::format("/meshes/{}", mesh),
                            fmt::format("mesh {} has no {} for material {}; TEXCOORD_{} is taken",
                                        mesh, source.texcoord, use.material, lowest->set));
            return;
        }
}

// What a node wears: its mesh, the materials of all its groups, skin and morph.
MeshUse NodeImporter::mesh_use(uint32_t node) {
    const tinygltf::Node& from = model_.nodes[node];
    MeshUse use;
    use.mesh = uint32_t(from.mesh);
    for (const PrimitiveGroup& group : out_.meshes[use.mesh].groups) {
        bool known = std::any_of(use.materials.begin(), use.materials.end(),
                                 [&](const MaterialUse& m) { return m.symbol == group.symbol; });
        if (known) continue;
        MaterialUse& material = use.materials.emplace_back();
        material.symbol = group.symbol;
        material.material = number_of<uint32_t>(group.symbol).value_or(kNone);
        for (uint32_t set = 0; set < 8; ++set)
            material.vertex_bindings.push_back({fmt::format("TEXCOORD_{}", set), "TEXCOORD", set});
        std::span<const VertexBinding> inputs = materials_.vertex_inputs(material.material);
        material.vertex_bindings.insert(material.vertex_bindings.end(), inputs.begin(),
                                        inputs.end());
        report_missing_sets(use.mesh, group, material);
    }
    use.morph = slots_[node].morph =
        morphs_.morph_of(use.mesh, node, moving_[node] & kMovesWeights);
    if (from.skin < 0) return use;
    std::string pointer = fmt::format("/nodes/{}/skin", node);
    if (!has_index(from.skin, model_.skins.size())) return use;
    use.skin = skins_.skin_of(use.mesh, uint32_t(from.skin));
    for (int joint : model_.skins[size_t(from.skin)].joints) {
        bool there =
            joint >= 0 && size_t(joint) < model_.nodes.size() && tree_.shown[size_t(joint)];
        use.joint_nodes.push_back(there ? uint32_t(joint) : kNone);
    }
    return use;
}

}  // namespace kinora
