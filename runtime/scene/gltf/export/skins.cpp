// runtime/scene/gltf/export/skins.cpp: skins with the nodes of their joints.
#include "runtime/scene/gltf/export/skins.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

namespace kinora {

namespace {

// The joints of a glTF skin with their matrices.
struct JointList {
    Json nodes = Json::array();
    std::vector<float> inverse_bind;

    void add(uint32_t node, const dmat4& matrix) {
        nodes.push_back(node);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                inverse_bind.push_back(c < 3 && r == 3    ? 0.0f
                                       : c == 3 && r == 3 ? 1.0f
                                                          : float(matrix[c][r]));
    }
};

}  // namespace

// Per joint of the use: the occurrence that it is; kNone: there is none.
std::vector<uint32_t> SkinWriter::joints_of(const MeshUse& use, uint32_t occurrence) const {
    std::vector<uint32_t> joints;
    for (uint32_t joint : use.joint_nodes)
        joints.push_back(joint == kNone ? kNone : occurrences_.nearest(joint, occurrence));
    return joints;
}

// The product of the changes of units and axes on the way to an occurrence.
dmat4 SkinWriter::path_conversion(uint32_t occurrence) const {
    dmat4 m(1.0);
    for (uint32_t o = occurrence; o != kNone; o = occurrences_[o].parent)
        m = occurrences_[o].conversion * m;
    return m;
}

// Of joint `j`, brought from the skin's units and axes (as `from_skin` takes them to the scene's)
// into those of the joint.
dmat4 SkinWriter::inverse_bind(const SkinDefinition& skin, size_t j, uint32_t joint,
                               const dmat4& from_skin) const {
    dmat4 from_joint = path_conversion(joint);
    if (from_joint == from_skin) return skin.inverse_bind[j];
    return glm::inverse(from_joint) * from_skin * skin.inverse_bind[j];
}

// `bound`: the joints that have inverse bind matrices; `shared`: their and the node's ancestor.
SkinPlacement SkinWriter::space_of(const MeshUse& use, uint32_t occurrence,
                                   std::span<const uint32_t> bound, uint32_t shared) const {
    const SkinDefinition& definition = description_.skins[use.skin];
    if (definition.in_world) return {};
    SkinPose rest, start;
    rest.node = occurrences_[occurrence].world * use.conversion;
    start.node = occurrences_[occurrence].start * use.conversion;
    dmat4 from_skin = path_conversion(occurrence) * use.conversion;
    for (size_t j = 0; j < bound.size(); ++j) {
        if (bound[j] == kNone) continue;
        dmat4 own = inverse_bind(definition, j, bound[j], from_skin);
        rest.joints.push_back({occurrences_[bound[j]].world, own});
        start.joints.push_back({occurrences_[bound[j]].start, own});
    }
    if (shared != kNone) rest.shared = occurrences_[shared].world;
    if (shared != kNone) start.shared = occurrences_[shared].start;
    return skin_placement(definition.bind_shape, rest, start);
}

// An occurrence and those above it once more below the glTF node `above`, which stands for `top`
// (kNone: for what is above all), without their content.
uint32_t SkinWriter::copy(uint32_t occurrence, uint32_t above, uint32_t top, Copies& copies) {
    auto found = copies.find(occurrence);
    if (found != copies.end()) return found->second;
    if (occurrence == top) return copies[occurrence] = above;
    const Occurrence& o = occurrences_[occurrence];
    uint32_t parent = o.parent == kNone ? above : copy(o.parent, above, top, copies);
    return copies[occurrence] =
               nodes_.write_stack(description_.nodes[o.definition], o.conversion, parent);
}

// COLLADA 1.4.1, skinning: a skin is in world space, joint * inverse bind * bind shape.
uint32_t SkinWriter::write(const MeshUse& use, const dmat4& about, uint32_t occurrence) {
    const SkinDefinition& definition = description_.skins[use.skin];
    std::vector<uint32_t> joints = joints_of(use, occurrence);
    std::span<const uint32_t> bound =
        std::span(joints).first(std::min(joints.size(), definition.inverse_bind.size()));
    uint32_t shared = shared_ancestor(occurrence, bound, kNone,
                                      [&](uint32_t n) { return occurrences_[n].parent; });
    SkinPlacement space = space_of(use, occurrence, bound, shared);
    bool binds_node = space.space == SkinSpace::BindsNode;
    dmat4 bind_shape = binds_node ? space.bind : definition.bind_shape;
    uint32_t above = root_;
    Copies copies;
    dmat4 from_skin = path_conversion(occurrence) * use.conversion;
    dmat4 still_shape = from_skin * bind_shape;  // of what follows no joint
    if (space.space == SkinSpace::Node || space.space == SkinSpace::NodeBelow) {
        // The joints stand below the node.
        uint32_t top = space.space == SkinSpace::Node ? kNone : shared;
        above = nodes_.write_still(use.conversion, occurrences_[occurrence].node);
        still_shape = bind_shape;
        document_.node(above)["name"] = definition.id + " space";
        for (uint32_t joint : joints)
            if (joint != kNone) copy(joint, above, top, copies);
    }
    JointList list;
    uint32_t still = kNone;  // a node that never moves, for what follows no joint
    auto add_still = [&] {
        if (still == kNone)
            still =
                document_.add_node(Json::object({{"name", definition.id + " bind shape"}}), above);
        list.add(still, still_shape * about);
    };
    for (size_t j = 0; j < definition.inverse_bind.size(); ++j) {
        uint32_t joint = j < joints.size() ? joints[j] : kNone;
        if (joint == kNone)
            add_still();
        else
            list.add(copies.empty() ? occurrences_[joint].node : copies.at(joint),
                     inverse_bind(definition, j, joint, from_skin) * bind_shape * about);
    }
    bool follows_none = std::any_of(definition.joints.begin(), definition.joints.end(),
                                    [](int32_t j) { return j < 0; });
    if (follows_none || list.nodes.empty()) add_still();
    Json result = {{"joints", list.nodes},
                   {"inverseBindMatrices", buffer_.accessor(list.inverse_bind, 16, 0, false)}};
    if (!definition.id.empty()) result["name"] = definition.id;
    return document_.add("skins", std::move(result));
}

void give_skins_a_root(GltfDocument& document) {
    if (!document.has("skins")) return;
    Json& nodes = document.list("nodes");
    std::vector<uint32_t> top(nodes.size());  // the scene's root above each; parents come first
    for (uint32_t n = 0; n < nodes.size(); ++n) top[n] = n;
    for (uint32_t n = 0; n < nodes.size(); ++n)
        if (nodes[n].contains("children"))
            for (uint32_t child : nodes[n]["children"]) top[child] = top[n];
    bool apart = false;
    for (const Json& skin : document.list("skins"))
        for (uint32_t joint : skin["joints"])
            apart |= top[joint] != top[skin["joints"][0].get<uint32_t>()];
    if (!apart) return;
    Json below = Json::array(), roots = Json::array();
    roots.push_back(nodes.size());
    for (const Json& root : document.scene()["nodes"])
        (nodes[root.get<uint32_t>()].contains("skin") ? roots : below).push_back(root);
    nodes.push_back({{"name", "root of the joints"}, {"children", below}});
    document.scene()["nodes"] = roots;
}

}  // namespace kinora
